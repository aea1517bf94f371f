#include "plume/mesh/edge_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <span>

#include "plume/mesh/walkable_cells.h"

namespace plume {
namespace {

constexpr std::size_t kMostEdges = 255;
// As many as the widest vector has.
constexpr std::size_t kWordsBehind = 16;

// A cell's record while it is made.
class Record {
 public:
  // False where the cell is too large to have one.
  bool read(const WalkableCells& mesh, std::uint32_t cell) {
    corners_.clear();
    edges_.clear();
    faces_.clear();
    open_.clear();
    const auto faces = mesh.faces_of(cell);
    if (faces.size() > kMostEdgeCellCorners) return false;
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
      const auto loop = mesh.loop(faces[face]);
      const bool from_outside = mesh.face_sides[faces[face]].owner == cell;
      std::uint32_t mask = 0, from = number_of(loop.back());
      for (const std::uint32_t point : loop) {
        const std::uint32_t to = number_of(point);
        if (corners_.size() > kMostEdgeCellCorners) return false;
        mask |= 1u << to;
        add_edge(from_outside ? from : to, from_outside ? to : from, face);
        from = to;
      }
      faces_.push_back(loop.size() > 3 ? mask : 0);
    }
    // The faces of a cell close, so each edge is gone along as often one way as the other.
    return open_.empty() && edges_.size() <= kMostEdges;
  }

  std::size_t size() const { return 1 + padded() + edges_.size() + faces_.size(); }

  void write(std::uint32_t* to) const {
    *to++ = static_cast<std::uint32_t>(padded() | edges_.size() << 8 | faces_.size() << 16);
    for (std::size_t i = 0; i < padded(); ++i)
      *to++ = 2 * corners_[std::min(i, corners_.size() - 1)];
    to = std::copy(edges_.begin(), edges_.end(), to);
    std::copy(faces_.begin(), faces_.end(), to);
  }

 private:
  std::size_t padded() const { return (corners_.size() + 3) / 4 * 4; }

  struct Open {
    std::uint32_t from, to, face;
  };

  std::uint32_t number_of(std::uint32_t point) {
    const auto found = std::find(corners_.begin(), corners_.end(), point);
    const auto number = static_cast<std::uint32_t>(found - corners_.begin());
    if (found == corners_.end()) corners_.push_back(point);
    return number;
  }

  void add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t face) {
    const auto same = std::find_if(open_.begin(), open_.end(), [&](const Open& open) {
      return open.from == to && open.to == from;
    });
    if (same == open_.end()) {
      open_.push_back({from, to, face});
      return;
    }
    edges_.push_back(from | to << 8 | face << 16 | same->face << 24);
    open_.erase(same);
  }

  std::vector<std::uint32_t> corners_, edges_, faces_;
  std::vector<Open> open_;
};

}  // namespace

EdgeCells make_edge_cells(const WalkableCells& mesh) {
  const std::size_t count = mesh.cell_count();
  auto for_each = [&](const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
      Record record;
      for (std::size_t c = range.begin(); c != range.end(); ++c)
        body(static_cast<std::uint32_t>(c), record);
    });
  };
  EdgeCells cells;
  cells.begin.assign(count, 0);
  for_each([&](std::uint32_t c, Record& record) {
    const bool has_corners = !mesh.corner_cells.empty() && mesh.corner_cells[c].other == 0;
    if (!has_corners && record.read(mesh, c))
      cells.begin[c] = static_cast<std::uint32_t>(record.size());
  });
  std::size_t end = 0;
  for (std::uint32_t& begin : cells.begin) {
    const std::size_t size = begin;
    begin = size == 0 ? kNone : static_cast<std::uint32_t>(end);
    end += size;
    if (end > std::numeric_limits<std::int32_t>::max()) return {};
  }
  if (end == 0) return {};
  cells.words.assign(end + kWordsBehind, 0);
  for_each([&](std::uint32_t c, Record& record) {
    if (cells.begin[c] == kNone) return;
    record.read(mesh, c);
    record.write(cells.words.data() + cells.begin[c]);
  });
  return cells;
}

}  // namespace plume
