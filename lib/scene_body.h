/// What is inside of a Scene: for scene.cpp and render.cpp.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "plume/lib/gradient_field.h"
#include "plume/lib/lazy_hierarchy.h"
#include "plume/lib/scene.h"
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

struct Scene::Body {
  std::variant<std::unique_ptr<Walkable<TetWalker>>, std::unique_ptr<Walkable<GridWalker>>,
               std::unique_ptr<Walkable<CellWalker>>, std::unique_ptr<Walkable<RectilinearWalker>>>
      walkable;
  Bounds bounds;
  ScalarField field;
  bool cell_data_averaged = false;
  std::vector<Finding> findings;
  ColorMap default_map;
  double unit_distance = 1;
  TransferFunction transfer_function;
  Classification classification;
  std::optional<GradientField> gradients;
  /// Of tetrahedra, where a picture needs it.
  LazyHierarchy hierarchy;
};

}  // namespace plume
