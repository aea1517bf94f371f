/// What is inside of a Scene: for scene.cpp and render.cpp.
#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "plume/lib/gradient_field.h"
#include "plume/lib/scene.h"
#include "plume/mesh/cell_hierarchy.h"
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

/// A hierarchy of cells, made when it is first asked for, by whichever thread asks.
class LazyHierarchy {
 public:
  const CellHierarchy& of(const WalkableTets& mesh) const {
    // Who makes it helps with no other task meanwhile: that could ask for it, too.
    std::call_once(once_, [&] {
      tbb::this_task_arena::isolate([&] { hierarchy_ = make_cell_hierarchy(mesh); });
      made_ = true;
    });
    return hierarchy_;
  }
  bool made() const { return made_; }

 private:
  mutable std::once_flag once_;
  mutable CellHierarchy hierarchy_;
  mutable std::atomic<bool> made_ = false;
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
