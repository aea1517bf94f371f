#include "plume/lib/lazy_hierarchy.h"

#include <tbb/task_arena.h>

#include "plume/mesh/cell_hierarchy.h"

namespace plume {

LazyHierarchy::LazyHierarchy() : once_(std::make_unique<std::once_flag>()) {}
LazyHierarchy::~LazyHierarchy() = default;

const CellHierarchy& LazyHierarchy::of(const WalkableTets& mesh) const {
  std::call_once(*once_, [&] {
    // Who makes it helps with no other task meanwhile: that could ask for it, too.
    tbb::this_task_arena::isolate(
        [&] { hierarchy_ = std::make_unique<const CellHierarchy>(make_cell_hierarchy(mesh)); });
    made_ = true;
  });
  return *hierarchy_;
}

void LazyHierarchy::reset() {
  once_ = std::make_unique<std::once_flag>();
  hierarchy_.reset();
  made_ = false;
}

}  // namespace plume
