/// What is looked at: a mesh made walkable, one of its fields, and what the values look like.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/color_map.h"
#include "plume/lib/opaque_surface.h"
#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"
#include "plume/preint/classification.h"
#include "plume/preint/transfer_function.h"
#include "plume/traverse/ray.h"
#include "plume/traverse/segment.h"

namespace plume {

/// The least bounds around two.
Bounds united(const Bounds& a, const Bounds& b);

/// What a cell-centred field is between the centres of cells.
enum class CellData : std::uint8_t {
  constant,  ///< what it says: one value in all of each cell, with jumps between them
  averaged,  ///< made point data, weighted by 1 / distance; see mesh/cell_to_point.h
};

/// Which field a scene shows, and what it keeps besides what every picture needs.
struct SceneOptions {
  /// Which field; by default the mesh's active one, else its first.
  FieldRequest field{};
  /// Keep the numbers of the user's cells, 4 bytes each; needed for the channel "cell_id".
  bool keep_cell_numbers = false;
  /// Read where the field is cell-centred.
  CellData cell_data = CellData::constant;
  /// Compute and keep the field's gradients at the points, 12 bytes each; needed for light and for
  /// the channel "normal". The field must be on points, or averaged to them.
  bool keep_gradients = false;
  /// Keep what set_field() needs: where the user's points have gone, 4 bytes each, or, where the
  /// field is constant in cells, where the cells have, 4 bytes each. Of grids, nothing.
  bool keep_field_order = false;
  /// Tetrahedra alone: keep 16 bytes a cell instead of 32. The same pictures; walked faster beyond
  /// some 10 million cells and slower below. Without a hierarchy of cells, isosurfaces, maxima and
  /// minima are walked to.
  bool compact_tetrahedra = false;
  /// What the default colour map runs over, low below high, where the field's own values at this
  /// time are not all that is going to be shown. By default their 1st to 99th percentile.
  std::optional<std::array<double, 2>> color_range{};
  /// What messages call the mesh, such as its file; by default its place among those of a picture.
  std::string name{};
  /// Bounds of all meshes that are going to be shown together, this one's included (united()).
  /// Coordinates are then rounded alike in all of them, so that where they share faces a ray sees
  /// one of the two, with neither a gap nor an overlap. Rectilinear grids need none.
  std::optional<Bounds> frame_bounds{};
};

/// Immutable but for the classification, opaque surfaces and, where the options say so, the field;
/// safe to render from several threads.
class Scene {
 public:
  /// Checks the mesh, makes it walkable (in parallel) and chooses a transfer function that shows
  /// something of the field's range. The mesh itself is needed no more once this has returned.
  /// Throws Error where the mesh or the field request is wrong.
  explicit Scene(const Mesh& mesh, const SceneOptions& options = {});
  ~Scene();
  /// What was moved from can be assigned to and destroyed, no more.
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;  ///< likewise

  /// Of all points, in world coordinates.
  const Bounds& bounds() const;
  /// The chosen field: name, association, range, count of values that are not finite. Its values
  /// are empty: they live in the walkable form. Cell data that was averaged is point data here.
  const ScalarField& field() const;
  /// Whether the field was cell data and is averaged to the points.
  bool cell_data_averaged() const;
  /// What was found on the way, in words for users.
  const std::vector<Finding>& findings() const;
  /// "tetrahedra", "grid", "cells" or "rectilinear grid": the form in which the mesh is walked.
  const char* form() const;
  std::size_t cell_count() const;           ///< cells that are walked
  std::size_t point_count() const;          ///< points that they use
  std::size_t boundary_face_count() const;  ///< faces with one cell
  /// Parts that hang together by faces, counted at each call.
  std::size_t connected_part_count() const;
  /// Bytes of the walkable form, the boundary's hierarchy not included.
  std::size_t bytes() const;
  /// Whether keep_gradients was set.
  bool has_gradients() const;
  /// SceneOptions::name.
  const std::string& name() const;

  /// Shows another field, or new values of the same: for a solver whose mesh stays. Nothing is
  /// rebuilt but what depends on the field: the scalars in the walkable mesh, gradients where they
  /// are kept, findings, and, once they are asked for, default colour map and unit distance. The
  /// classification stays, so that pictures before and after can be compared; to fit it anew,
  /// `set_transfer_function(to_transfer_function(default_color_map(), default_unit_distance()))`.
  /// Then all is bit for bit as in a scene made anew.
  ///
  /// `mesh` must be the one that the scene was made of (the same arrays, or copies of them); only
  /// its fields are read, and its points and cells where values are averaged or gradients kept.
  /// Not to be called while others render the scene. Throws Error, and leaves the scene as it is,
  /// where keep_field_order was not set, where the mesh has another number of points or cells,
  /// where the request is wrong, or where the field is constant in cells and the first was on
  /// points, or the other way round.
  void set_field(const Mesh& mesh, const FieldRequest& request = {});

  /// The colour map fitted to the field's values: "turbo" from the 1st to the 99th percentile,
  /// the more opaque the rarer a value is.
  const ColorMap& default_color_map() const;
  /// The default distance over which a colour map's opacity applies, in world units: such that with
  /// the default map, of a few hundred rays through the mesh, one in five has an optical depth of
  /// more than 4. A tenth of the diagonal of the bounds where nothing is opaque.
  double default_unit_distance() const;

  /// What values look like: a volume by default. Intervals and isosurfaces are seen in the modes
  /// volume and depth.
  const Classification& classification() const;
  /// Throws Error where the classification has a problem (see Classification::problem). Where it
  /// has no volume, transfer_function() stays what it was.
  void set_classification(Classification classification);

  /// The volume's, or the last one that it had: the colours of the mode maximum.
  const TransferFunction& transfer_function() const;
  /// Sets the volume of the classification and leaves its intervals and isosurfaces. Throws Error
  /// where the transfer function has a problem (see TransferFunction::problem).
  void set_transfer_function(TransferFunction transfer_function);

  /// Adds an opaque thing to the scene: in front of the mesh, inside of it or behind it, it hides
  /// what is behind it, correct within each cell. It is seen in the modes volume and depth; in the
  /// others it ends rays. Throws Error where it has a problem (see OpaqueSurface::problem).
  void add_surface(OpaqueSurface surface);
  /// Takes all of them out again.
  void remove_surfaces();
  /// Of all surfaces.
  std::size_t surface_triangle_count() const;
  /// Of the mesh and of the surfaces: what a camera should see.
  Bounds visible_bounds() const;

  /// Follows a ray and calls `visit` for each segment, front to back, until that returns false.
  /// `Segment::cell` is a number of the user's mesh where keep_cell_numbers was set or the mesh is
  /// a grid. Above `linear`, segments have inner values where their cells are not linear
  /// (scalar_at() gives the scalar anywhere along one). `adaptive` may make several segments of a
  /// cell. For programs with an optics of their own;
  /// see traverse/trace.h for the guarantees.
  TraceResult trace(const Ray& ray, const std::function<bool(const Segment&)>& visit,
                    const ScalarRequest& request = {}) const;

  struct Body;
  /// For render().
  const Body& body() const { return *body_; }

 private:
  std::unique_ptr<Body> body_;
};

}  // namespace plume
