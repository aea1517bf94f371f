#include "plume/mesh/connected_parts.h"

#include <vector>

namespace plume {
namespace {

// Union-find with path halving.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size), count_(size) {
    for (std::size_t i = 0; i < size; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent_[b] = a;
    --count_;
  }
  std::size_t count() const { return count_; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::uint32_t> parent_;
  std::size_t count_;
};

// A grid of either kind: visible cells are joined with their neighbours in positive direction.
template <class Grid>
std::size_t parts_of_grid(const Grid& mesh) {
  const auto cells = static_cast<std::uint32_t>(mesh.cell_count());
  Sets sets(cells);
  std::size_t hidden = 0;
  for (std::uint32_t c = 0; c < cells; ++c) {
    if (!mesh.hidden.empty() && mesh.hidden[c]) {
      ++hidden;
      continue;
    }
    for (std::uint32_t face = 1; face < 6; face += 2)
      if (const std::uint32_t neighbor = mesh.neighbor(c, face); neighbor != kNone)
        sets.join(c, neighbor);
  }
  return sets.count() - hidden;
}

}  // namespace

std::size_t connected_parts(const WalkableTets& mesh) {
  Sets sets(mesh.cells.size());
  for (std::uint32_t c = 0; c < mesh.cells.size(); ++c)
    for (const WalkableTets::Link& link : mesh.cells[c])
      if (link.cell != kNone) sets.join(c, link.cell);
  return sets.count();
}

std::size_t connected_parts(const WalkableGrid& mesh) { return parts_of_grid(mesh); }

std::size_t connected_parts(const WalkableRectilinear& mesh) {
  return mesh.hidden.empty() ? 1 : parts_of_grid(mesh);
}

std::size_t connected_parts(const WalkableCells& mesh) {
  Sets sets(mesh.cell_count());
  for (const auto& sides : mesh.face_sides)
    if (sides.neighbor != kNone) sets.join(sides.owner, sides.neighbor);
  return sets.count();
}

}  // namespace plume
