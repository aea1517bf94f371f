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

// Compact cells are known from outside alone: a flood from the boundary, which every part has.
std::size_t parts_of_compact(const WalkableTets& mesh) {
  struct Place {
    std::uint32_t cell, from;
    std::array<std::uint32_t, 4> ids;  // that of the point across from where we came in last
  };
  std::vector<bool> seen(mesh.cell_count());
  std::vector<Place> open;
  std::size_t parts = 0;
  for (const WalkableTets::Boundary& face : mesh.boundary) {
    if (seen[face.cell]) continue;
    ++parts;
    seen[face.cell] = true;
    open.push_back({face.cell, kNone, {face.loop[0], face.loop[1], face.loop[2], face.apex}});
    while (!open.empty()) {
      const Place at = open.back();
      open.pop_back();
      auto rank = [&](std::uint32_t id) {
        return static_cast<std::size_t>(
            std::count_if(at.ids.begin(), at.ids.end(), [&](auto other) { return other < id; }));
      };
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t next =
            mesh.compact_cells[at.cell].neighbor(rank(at.ids[i]), rank(at.ids[3]), at.from);
        if (next == kNone || seen[next]) continue;
        seen[next] = true;
        const std::array<std::uint32_t, 3> common{at.ids[(i + 1) % 3], at.ids[(i + 2) % 3],
                                                  at.ids[3]};
        const std::uint32_t apex = mesh.compact_cells[next].apex(common[0] ^ common[1] ^ common[2]);
        open.push_back({next, at.cell, {common[0], common[1], common[2], apex}});
      }
    }
  }
  return parts;
}

}  // namespace

std::size_t connected_parts(const WalkableTets& mesh) {
  if (mesh.is_compact()) return parts_of_compact(mesh);
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
