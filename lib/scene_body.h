/// What is inside of a Scene: for scene.cpp and render.cpp.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

#include "plume/lib/gradient_field.h"
#include "plume/lib/kept_plans.h"
#include "plume/lib/made_once.h"
#include "plume/lib/scene.h"
#include "plume/mesh/cell_clusters.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/range_tree.h"
#include "plume/preint/integrator_cache.h"
#include "plume/traverse/opaque_triangles.h"
#include "plume/traverse/trace.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume {

/// A walkable mesh with the hierarchy over its boundary, which refers to it.
template <class W>
struct Walkable {
  using Walker = W;
  typename W::Mesh mesh;
  BoundaryIndex<W> boundary;

  explicit Walkable(typename W::Mesh walkable_mesh)
      : mesh(std::move(walkable_mesh)), boundary(mesh) {}
  Walkable(const Walkable&) = delete;
  Walkable& operator=(const Walkable&) = delete;
};

/// An opaque surface, ready to be met.
struct SceneSurface {
  OpaqueTriangles index;
  std::array<float, 3> color;
  std::vector<std::array<float, 3>> point_colors, point_normals;
};

struct Scene::Body {
  SceneOptions options;
  std::size_t user_points = 0, user_cells = 0;  // of the user's mesh
  std::variant<std::unique_ptr<Walkable<TetWalker>>, std::unique_ptr<Walkable<GridWalker>>,
               std::unique_ptr<Walkable<CellWalker>>, std::unique_ptr<Walkable<RectilinearWalker>>>
      walkable;
  Bounds bounds;
  ScalarField field;
  bool cell_data_averaged = false;
  std::vector<Finding> findings;      // of the field, then of the mesh
  std::size_t findings_of_field = 0;  // how many of them
  // Fitted to the field when they are asked for: a solver with colours of its own never does.
  mutable std::mutex fitting;
  mutable std::vector<float> sample;  // of the field's values, until the map is fitted
  mutable std::optional<ColorMap> default_map;
  mutable std::optional<double> unit_distance;
  TransferFunction transfer_function;
  Classification classification;
  std::optional<GradientField> gradients;
  mutable IntegratorCache integrators;  // a frame without a new transfer function builds no table
  mutable KeptPlans plans;              // of tolerances
  std::vector<SceneSurface> surfaces;
  /// Where a picture needs them: of tetrahedra, of a grid or of cells of any kind, and of a
  /// rectilinear grid.
  MadeOnce<CellHierarchy> hierarchy;
  MadeOnce<CellClusters> clusters;
  MadeOnce<RangeTree> ranges;
};

}  // namespace plume
