/**
 * @file
 * The C interface of Plume: a mesh that a program has in memory becomes a picture in memory.
 *
 * What is promised: functions and enumerators of this header keep their meaning and their binary
 * form; later versions only add some. plume_camera and plume_array, the structures that are passed,
 * do not change. The shared library exports nothing else.
 *
 * Errors: a function that can fail returns a plume_status, PLUME_OK where it did what it says.
 * plume_last_error() then says in one line what was wrong, and what to do about it. What a function
 * gives through a pointer is left as it was where it fails. No exception leaves the library.
 *
 * Memory: arrays are borrowed and never written to. Those of points and cells must stay where they
 * are until plume_scene_create() has returned; all arrays of a mesh, for as long as
 * plume_scene_set_field() is called with it. A handle that a function creates belongs to the
 * caller, who gives it back by the function whose name ends in `_free`; NULL is then allowed.
 *
 * Threads: any number may use different handles, and render one scene; nobody may do anything else
 * with a handle while another thread changes it. Rendering uses all cores.
 */
#ifndef PLUME_C_H
#define PLUME_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define PLUME_C_EXPORT __attribute__((visibility("default"))) /**< Seen from outside. */
#else
#define PLUME_C_EXPORT /**< Seen from outside. */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a call. */
typedef enum plume_status {
  PLUME_OK = 0,            /**< Done. */
  PLUME_BAD_INPUT = 1,     /**< A mesh, a field, a name or a value is wrong. */
  PLUME_OUT_OF_MEMORY = 2, /**< There was not enough memory. */
  PLUME_CANCELLED = 3,     /**< The progress function asked to stop; the picture is incomplete. */
  PLUME_INTERNAL = 4       /**< Something that should not have happened. Please report it. */
} plume_status;

/** The version of the library that the program runs with, such as "0.1.0". */
PLUME_C_EXPORT const char* plume_version(void);

/** What was wrong with the last call of this thread that failed; "" where none has. Valid until the
 * next call that fails. */
PLUME_C_EXPORT const char* plume_last_error(void);

/** The type of an array's numbers. */
typedef enum plume_type {
  PLUME_UINT8 = 0,   /**< uint8_t */
  PLUME_INT32 = 1,   /**< int32_t */
  PLUME_INT64 = 2,   /**< int64_t */
  PLUME_FLOAT32 = 3, /**< float */
  PLUME_FLOAT64 = 4  /**< double */
} plume_type;

/** Numbers in the caller's memory, one after the other. */
typedef struct plume_array {
  const void* data; /**< The first; may be NULL where count is 0. */
  size_t count;     /**< How many numbers (not bytes, not points). */
  plume_type type;  /**< Of each. */
} plume_array;

/** Where a field's values are. */
typedef enum plume_association {
  PLUME_POINT = 0, /**< One for each point. */
  PLUME_CELL = 1   /**< One for each cell. */
} plume_association;

/** Points and cells, with fields: the caller's arrays. */
typedef struct plume_mesh plume_mesh;

/** A mesh of explicit cells, as in vtkUnstructuredGrid.
 *
 * @param points        x, y and z of each point; PLUME_FLOAT32 or PLUME_FLOAT64.
 * @param types         VTK's number of each cell's type (10 tetrahedron, 11 voxel, 12 hexahedron,
 *                      13 wedge, 14 pyramid, 15 and 16 prisms, 42 polyhedron), PLUME_UINT8; one
 *                      alone where all cells are of that type.
 * @param offsets       where each cell begins in connectivity, and one more: where the last one
 *                      ends. Of count 0 where all cells are of one type but polyhedra.
 * @param connectivity  numbers of points, from 0, in VTK's order.
 * @param mesh          receives the handle.
 *
 * Nothing but types is checked here; plume_scene_create() does. */
PLUME_C_EXPORT plume_status plume_mesh_of_cells(plume_array points, plume_array types,
                                                plume_array offsets, plume_array connectivity,
                                                plume_mesh** mesh);

/** The faces of the polyhedra of a mesh of cells, in VTK's layout: `faces` holds, for each
 * polyhedron, the number of its faces, then for each face the number of its points and these;
 * `locations` where each cell begins in there, -1 for one that is no polyhedron. */
PLUME_C_EXPORT plume_status plume_mesh_set_polyhedra(plume_mesh* mesh, plume_array faces,
                                                     plume_array locations);

/** A curvilinear grid of hexahedra: point (i, j, k) is number i + ni * (j + nj * k) of points. */
PLUME_C_EXPORT plume_status plume_mesh_of_grid(int64_t ni, int64_t nj, int64_t nk,
                                               plume_array points, plume_mesh** mesh);

/** A rectilinear grid: coordinates along x, y and z, each strictly ascending or descending. */
PLUME_C_EXPORT plume_status plume_mesh_of_axes(plume_array x, plume_array y, plume_array z,
                                               plume_mesh** mesh);

/** Adds a field of `components` interleaved numbers a point or cell. To show new values of it,
 * write them into the same array and call plume_scene_set_field(). */
PLUME_C_EXPORT plume_status plume_mesh_add_field(plume_mesh* mesh, const char* name,
                                                 plume_association association, int components,
                                                 plume_array values);

/** Gives a mesh back; its arrays stay. */
PLUME_C_EXPORT void plume_mesh_free(plume_mesh* mesh);

/** What is looked at: a mesh ready to be traced, one of its fields, and what the values look like.
 */
typedef struct plume_scene plume_scene;

/** Options of a scene, to be added up. */
typedef enum plume_scene_flag {
  PLUME_DEFAULT = 0,
  PLUME_KEEP_FIELD_ORDER = 1, /**< For plume_scene_set_field(): 4 bytes a point (or cell). */
  PLUME_KEEP_GRADIENTS = 2,   /**< For light: 12 bytes a point. */
  PLUME_AVERAGE_CELLS = 4     /**< Average values of cells to the points; else they are constant. */
} plume_scene_flag;

/** Checks a mesh and makes it ready to be traced, in parallel. The mesh is needed no more
 * afterwards, but for plume_scene_set_field().
 *
 * @param mesh   points, cells and at least one field.
 * @param field  "NAME", "NAME:0" (a component) or "NAME:magnitude"; NULL for the first field.
 * @param flags  a sum of plume_scene_flag.
 * @param scene  receives the handle. */
PLUME_C_EXPORT plume_status plume_scene_create(const plume_mesh* mesh, const char* field,
                                               unsigned flags, plume_scene** scene);

/** Gives a scene back. */
PLUME_C_EXPORT void plume_scene_free(plume_scene* scene);

/** Shows another field, or new values of the same, on a mesh that has not changed: nothing is
 * rebuilt but what depends on the field. What values look like stays, too. Needs
 * PLUME_KEEP_FIELD_ORDER. */
PLUME_C_EXPORT plume_status plume_scene_set_field(plume_scene* scene, const plume_mesh* mesh,
                                                  const char* field);

/** Least and greatest x, y and z: x0, x1, y0, y1, z0, z1. */
PLUME_C_EXPORT plume_status plume_scene_bounds(const plume_scene* scene, double bounds[6]);

/** Least and greatest finite value of the field. */
PLUME_C_EXPORT plume_status plume_scene_range(const plume_scene* scene, float range[2]);

/** A colour map by name: "cool-warm", "viridis", "inferno", "turbo", "gray", "rainbow".
 *
 * @param scene          the scene.
 * @param name           of the colour map; opacity rises over it from 0 to 1. NULL for the map
 *                       that is fitted to the field, whatever low and high are.
 * @param low,high       the values of its ends, low < high.
 * @param unit_distance  over which opacity applies, in world units, > 0; 0 for a default that
 *                       is fitted to the mesh.
 * @param opacity_scale  a factor, >= 0. */
PLUME_C_EXPORT plume_status plume_scene_set_color_map(plume_scene* scene, const char* name,
                                                      double low, double high, double unit_distance,
                                                      double opacity_scale);

/** Extinction and colour, piecewise linear over the scalar: `count` knots of 5 numbers each, scalar
 * (ascending; two equal ones make a step), extinction per world unit (>= 0), linear r, g, b. */
PLUME_C_EXPORT plume_status plume_scene_set_transfer_function(plume_scene* scene, size_t count,
                                                              const float* knots);

/** Isosurfaces instead of those that there are: 5 numbers each, value, opacity (0 to 1), linear r,
 * g, b. `show_volume` is 0 to see them without the volume. */
PLUME_C_EXPORT plume_status plume_scene_set_isosurfaces(plume_scene* scene, size_t count,
                                                        const float* isosurfaces, int show_volume);

/** One piece of a ray inside one cell, along which the scalar is linear (see plume_trace()). */
typedef struct plume_segment {
  double t_in;  /**< Where the ray comes in, in lengths of its direction from its origin. */
  double t_out; /**< Where it goes out, >= t_in. */
  float s_in;   /**< The scalar at t_in. */
  float s_out;  /**< The scalar at t_out. */
} plume_segment;

/** Sees a segment; returns 0 to stop, anything else to go on. */
typedef int (*plume_visit)(void* user, const plume_segment* segment);

/** Calls `visit` for each segment of a ray from `origin` along `direction`, front to back. Within
 * the mesh they join without a gap. From any number of threads. Distances are world units where the
 * direction has length one. */
PLUME_C_EXPORT plume_status plume_trace(const plume_scene* scene, const double origin[3],
                                        const double direction[3], plume_visit visit, void* user);

/** Where a picture is taken from, in VTK's terms. */
typedef struct plume_camera {
  double position[3];    /**< Of the eye. */
  double focal_point[3]; /**< What it looks at. */
  double view_up[3];     /**< What is up; not along the line of sight. */
  double view_angle;     /**< Degrees from bottom to top, in (0, 180); perspective only. */
  double parallel_scale; /**< Half of the height in world units, > 0; parallel only. */
  int parallel;          /**< 0 for perspective, anything else for parallel projection. */
} plume_camera;

/** A camera that sees all of the scene: "+x" looks along +x, likewise "-x", "+y", "-y", "+z", "-z";
 * "iso" looks along (-1, -1, -1). `aspect_ratio` is that of the picture, width / height. */
PLUME_C_EXPORT plume_status plume_camera_view(const plume_scene* scene, const char* view,
                                              double aspect_ratio, plume_camera* camera);

/** How a picture is made; every setting has a default. */
typedef struct plume_settings plume_settings;

/** What a pixel shows. */
typedef enum plume_mode {
  PLUME_VOLUME = 0,        /**< Emission and absorption, with isosurfaces. The default. */
  PLUME_MAXIMUM = 1,       /**< The greatest value along the ray, in its colour. */
  PLUME_INTEGRAL = 2,      /**< The integral of the field along the ray, as a shade of gray. */
  PLUME_DEPTH = 3,         /**< The distance to what is seen first, as a shade of gray. */
  PLUME_MINIMUM = 4,       /**< The least value along the ray, in its colour. */
  PLUME_AVERAGE = 5,       /**< The integral by the length of the ray in the mesh, in its colour. */
  PLUME_OPTICAL_DEPTH = 6, /**< The volume's optical depth, as a shade of gray. */
  PLUME_CELL_COUNT = 7     /**< How many cells the ray goes through, as a shade of gray. */
} plume_mode;

/** Settings with their defaults. */
PLUME_C_EXPORT plume_status plume_settings_create(plume_settings** settings);
/** Gives settings back. */
PLUME_C_EXPORT void plume_settings_free(plume_settings* settings);
/** What a pixel shows. */
PLUME_C_EXPORT plume_status plume_settings_set_mode(plume_settings* settings, plume_mode mode);
/** The scalar inside of cells that are no tetrahedra: 1 linear (the default), 2 quadratic, 3 cubic
 * along a ray. */
PLUME_C_EXPORT plume_status plume_settings_set_order(plume_settings* settings, int order);
/** Threads to use; 0, the default, for all. The picture does not depend on it. */
PLUME_C_EXPORT plume_status plume_settings_set_threads(plume_settings* settings, int threads);
/** The transmittance below which a ray ends, in [0, 1); 1e-4 by default. */
PLUME_C_EXPORT plume_status plume_settings_set_early_termination(plume_settings* settings,
                                                                 double transmittance);
/** The greatest error of a linear RGBA channel, in [0, 1), in the place of an order and an early
 * termination: both are then chosen for each picture. */
PLUME_C_EXPORT plume_status plume_settings_set_tolerance(plume_settings* settings,
                                                         double max_error);
/** Light on isosurfaces from the viewer (1) or none (0, the default); needs
 * PLUME_KEEP_GRADIENTS. */
PLUME_C_EXPORT plume_status plume_settings_set_headlight(plume_settings* settings, int on);
/** Shows only the side of a plane that its normal points to; as often as wanted. */
PLUME_C_EXPORT plume_status plume_settings_add_clip_plane(plume_settings* settings,
                                                          const double point[3],
                                                          const double normal[3]);
/** Has another channel of the picture written to `values`, width * height floats, the first row at
 * the top: "depth" (distance to what is seen first, infinity where nothing is), "optical_depth",
 * "cell_count", or the numbers of a mode under its name: "maximum", "integral", ... */
PLUME_C_EXPORT plume_status plume_settings_add_channel(plume_settings* settings, const char* name,
                                                       float* values);
/** A function that is called with the share done, 0 to 1, by any thread but never by two at once;
 * it returns 0 to cancel. */
PLUME_C_EXPORT plume_status plume_settings_set_progress(plume_settings* settings,
                                                        int (*progress)(void* user, double share),
                                                        void* user);

/** Renders a picture into the caller's memory. It is made beside it and copied when it is done, so
 * that nothing is half-written: for as long, it takes the same memory again.
 *
 * @param scene     what is seen.
 * @param camera    from where.
 * @param settings  how; NULL for the defaults.
 * @param width     pixels, 1 to 65536.
 * @param height    pixels, 1 to 65536.
 * @param rgba      receives 4 * width * height floats: linear RGBA, premultiplied by alpha, the
 *                  first row at the top. Untouched where the call fails, incomplete where it is
 *                  cancelled. */
PLUME_C_EXPORT plume_status plume_render(const plume_scene* scene, const plume_camera* camera,
                                         const plume_settings* settings, int width, int height,
                                         float* rgba);

#ifdef __cplusplus
}
#endif

#endif
