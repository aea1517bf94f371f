/// From a scene to a picture.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/camera.h"
#include "plume/lib/clip.h"
#include "plume/lib/image.h"
#include "plume/lib/scene.h"
#include "plume/lib/shading.h"
#include "plume/preint/integrator.h"
#include "plume/preint/interval_optics.h"
#include "plume/preint/interval_way.h"

namespace plume {

/// What a pixel shows.
enum class Mode : std::uint8_t {
  /// Emission and absorption by the scene's classification: volume, intervals and isosurfaces.
  volume,
  /// The greatest scalar along the ray, in the transfer function's colour for it; opaque where the
  /// ray meets the mesh. Channel "maximum".
  maximum,
  /// The least, likewise. Channel "minimum".
  minimum,
  /// The integral of the scalar divided by the length of the ray in the mesh, likewise. Channel
  /// "average".
  average,
  /// The integral of the scalar along the ray, in field units times world length units, as a shade
  /// of gray from the picture's least (or 0) to its greatest. Channel "integral".
  integral,
  /// The optical depth of the volume, which has no unit, as a shade of gray from 0 to the picture's
  /// greatest. Channel "optical_depth".
  optical_depth,
  /// The distance to the first segment that is not transparent, or, in a scene with intervals or
  /// isosurfaces, to the first of these that is not, as a shade of gray: the nearest is white, the
  /// farthest black. Channel "depth".
  depth,
  /// How many cells the ray goes through, as a shade of gray from 0 to the picture's greatest.
  /// Channel "cell_count".
  cell_count,
};

/// What is seen where several meshes of a picture are in one place.
enum class Overlap : std::uint8_t {
  /// Both: their extinction and their emission add up, as those of two fluids that mix. The order
  /// of the meshes does not matter.
  add,
  /// That of the scene named first, as in a mesh whose own parts overlap: for meshes that describe
  /// one fluid twice, such as overset grids, where no length is to count twice.
  first,
  /// Nothing: render() throws Error, which names the meshes, a pixel and the distances between
  /// which
  /// both are. What rounding does where meshes touch, up to 1e-6 of the diagonal, is no overlap.
  refuse,
};

/// A part of a picture, in pixels from its top left corner.
struct PixelWindow {
  int x = 0;       ///< of its first column
  int y = 0;       ///< of its first row
  int width = 1;   ///< columns, >= 1
  int height = 1;  ///< rows, >= 1

  /// The same in every number.
  bool operator==(const PixelWindow&) const = default;
};

/// An error to ask for, in the place of a method.
struct Tolerance {
  /// The greatest difference of a linear RGBA channel from the reference: the cells' own
  /// interpolation along whole rays, followed and integrated closely. In the modes that show one
  /// number a ray as a shade of gray, of the shade. In [0, 1); 0 is the reference.
  double max_error = 1e-3;
  /// What of RenderSettings is chosen; the others stay what they are there.
  bool choose_order = true;
  bool choose_integrator = true;         ///< likewise
  bool choose_early_termination = true;  ///< likewise
  /// Take the plan of an earlier picture of the scene: as it is where nothing has changed that it
  /// was made from; after a short look at this picture where only the camera, the size, what is
  /// opaque, the shades of gray or the field's values have (lib/kept_plans.h). False: what was
  /// rendered before has no part in this picture.
  bool keep_plans = true;

  /// The same in every number.
  bool operator==(const Tolerance&) const = default;
};

/// What a picture shows, by which methods, and how large it is.
struct RenderSettings {
  int width = 1024;  ///< pixels, 1 to 65536
  int height = 768;  ///< pixels, 1 to 65536
  /// Renders this part of the picture alone: the image has its size.
  std::optional<PixelWindow> window;
  /// The cheapest plan that keeps to this error is made and taken (lib/planner.h says how, and what
  /// of it is a bound and what is measured). The statistics' plan says which and why.
  std::optional<Tolerance> tolerance;
  Mode mode = Mode::volume;  ///< what a pixel shows
  /// Of the volume.
  IntegratorSettings integrator;
  /// Of interval volumes; `linear` is there to compare.
  IntervalForm interval_form = IntervalForm::exponential;
  /// Where rays are cut at the ends of intervals and at isovalues; `table` is there to compare, in
  /// the mode volume, without light and further channels, always of the exponential form.
  IntervalWay interval_way = IntervalWay::split;
  IntervalTableSettings interval_table;  ///< read by `table` alone
  /// Light on isosurfaces and, where it says so, intervals; none by default. Needs a scene that
  /// keeps gradients (SceneOptions::keep_gradients).
  std::optional<Lighting> lighting;
  /// Of the mesh, only what all of these keep is seen, in every mode. A box is planes_of_box().
  std::vector<ClipPlane> clip_planes;
  /// Rays end at these distances (in world units along rays of length one, as the channel "depth"
  /// has them): what a host program has drawn hides what is behind it. One for each pixel of the
  /// picture, infinite where nothing is, or none. With the scene's surfaces, the nearer counts.
  std::vector<float> depth_limit;
  /// The polynomial that the scalar is taken for inside of cells that are not tetrahedra; see
  /// traverse/inner_scalar.h. Maxima and integrals are those of the polynomial. Above `linear`, the
  /// whole of a cell with a NaN value is transparent; a linear segment is where one of the two
  /// faces has such a value.
  ScalarOrder order = ScalarOrder::linear;
  /// Above order 1, optics see the scalar in linear parts that differ from it by at most this share
  /// of the field's range (see ScalarPolynomial for cells across which it bends too much for that);
  /// `adaptive` follows the cells' interpolation to the same. In (0, 1).
  double scalar_tolerance = 1e-4;
  /// A ray ends once it is seen through by no more than this share: a colour channel is off by at
  /// most this times the transfer function's largest value in it. In [0, 1).
  double early_termination = 1e-4;
  /// Threads to use, at most those there are; 0 for all. The picture is the same for any number.
  int threads = 0;
  /// Plain scalar code, ray by ray, where packets or a hierarchy of cells would do: to compare.
  /// Packets take the same way through the mesh; pictures differ by less than 1e-5, above order 1
  /// also by what scalar_tolerance makes of the scalar; those by the hierarchy not at all.
  bool scalar_twin = false;
  /// Read where several scenes are rendered.
  Overlap overlap = Overlap::add;
  /// Modes in shades of gray: the numbers that run from one end of the shades to the other, low
  /// below high; numbers beyond are as bright as the nearer end. By default what the mode says, of
  /// this picture: to fix it is for pictures that are compared, or shown one after the other.
  std::optional<std::array<float, 2>> gray_range{};
  /// Further channels: "depth", "optical_depth", "cell_id", "cell_count". Optical depth and cell
  /// count need whole rays, so early termination is off where one of them is asked for.
  ///
  /// With intervals or isosurfaces, depth and cell are those of the first hit: the first of these
  /// that is not transparent. "isovalue" is the scalar there, and "normal" (three channels,
  /// "normal.x" and so on) the direction in which it rises, of length one, in a scene that keeps
  /// gradients; NaN where there is no hit.
  std::vector<std::string> channels;

  /// The same in every number.
  bool operator==(const RenderSettings&) const = default;
};

/// Counts over all rays of a picture, and the plan.
struct RenderStatistics {
  std::uint64_t rays = 0;             ///< one a pixel
  std::uint64_t rays_hit = 0;         ///< rays that came into the mesh
  std::uint64_t entries = 0;          ///< times that a ray came in through the boundary
  std::uint64_t cells_visited = 0;    ///< cells walked through by all rays
  std::uint64_t lost_rays = 0;        ///< rays that found no way out: 0
  std::uint64_t rays_in_packets = 0;  ///< rays walked by packets; the others one by one
  /// Rays that found what there is to see through the hierarchy of cells, without a walk; their
  /// `cells_visited` are those looked at.
  std::uint64_t rays_searched = 0;
  /// Whether that hierarchy, or a rectilinear grid's tree of ranges, was made for this picture:
  /// once for each scene that needs it.
  bool hierarchy_made = false;
  std::uint64_t surfaces = 0;  ///< isosurfaces crossed, before rays ended
  std::uint64_t visits = 0;    ///< to interval volumes, before rays ended
  /// Of several scenes: rays that met places in more than one mesh, before they ended.
  std::uint64_t rays_overlapping = 0;
  double seconds_planning = 0;  ///< spent on finding a plan for a tolerance
  /// Where a tolerance is asked for: what the plan's greatest error is estimated at, bounds added
  /// (see lib/planner.h for what is a bound and what is measured).
  std::optional<double> error_estimate;
  /// Whether that is within the tolerance, or none is asked for. False only where an order, an
  /// integrator or early termination is forced that does not keep to it.
  bool keeps_tolerance = true;
  /// The order that was taken: the settings', or the plan's.
  ScalarOrder order = ScalarOrder::linear;
  /// What a mode's numbers run from and to, in its channel's unit; nothing in the mode volume and
  /// where no ray has one.
  std::optional<std::array<float, 2>> values;
  /// What the shades of gray run over; nothing in modes without them, or where `values` is nothing.
  std::optional<std::array<float, 2>> gray_range;
  /// What was chosen for this scene and why, one choice a line.
  std::vector<std::string> plan;
};

/// A picture and what it took.
struct RenderResult {
  Image image;                  ///< see Image
  RenderStatistics statistics;  ///< see RenderStatistics
  /// True where the progress callback asked to stop; the image is then incomplete.
  bool cancelled = false;
};

/// Called with the share done, from 0 to 1, never by two threads at once; false cancels.
using Progress = std::function<bool(double)>;

/// Renders a picture, in parallel. Throws Error where the settings or the camera are wrong, naming
/// the value.
RenderResult render(const Scene& scene, const Camera& camera, const RenderSettings& settings = {},
                    const Progress& progress = {});

/// Renders several scenes in one picture: meshes of any kinds, each with its own field and
/// classification, and the opaque surfaces of all. Along each ray, what it meets of all meshes is
/// composited in one order, cut where one begins or ends in another; in what several meshes share,
/// `settings.overlap` decides. Without overlap the order of the scenes does not matter, and a mesh
/// cut in two by cells is the whole mesh to rounding (see SceneOptions::frame_bounds).
///
/// Optics are integrated in closed form, sums to 1e-13. The modes maximum, minimum, average and
/// integral need the same field in all scenes, those with colours the same transfer function; in
/// `average` a place in two meshes counts twice. Optical depth and cells are those of all meshes.
///
/// Throws Error as above, and where several scenes have no answer: a tolerance, other integrators
/// than the closed form, the linear form of intervals, intervals from tables, the channel
/// "cell_id". Requires that no pointer is null.
RenderResult render(const std::vector<const Scene*>& scenes, const Camera& camera,
                    const RenderSettings& settings = {}, const Progress& progress = {});

/// Of all meshes and surfaces of several scenes, at least one: what a camera should see.
Bounds visible_bounds(const std::vector<const Scene*>& scenes);

}  // namespace plume
