#include "plume/mesh/point_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "plume/mesh/explicit_cells.h"

namespace plume {

PointCells::PointCells(const Mesh& mesh) : mesh_(mesh) {
  if (!mesh.is_grid()) gather();
}

void PointCells::gather() {
  const CellReader reader(mesh_);
  const std::size_t points = mesh_.point_count();
  auto for_each_corner = [&](auto&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, reader.size()), [&](const auto& range) {
      std::vector<std::uint32_t> ids;
      for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
        reader.points(cell, ids);
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        for (const std::uint32_t id : ids) visit(id, static_cast<std::uint32_t>(cell));
      }
    });
  };
  std::vector<std::atomic<std::uint32_t>> filled(points);
  for_each_corner([&](std::uint32_t point, std::uint32_t) {
    filled[point].fetch_add(1, std::memory_order_relaxed);
  });
  begin_.resize(points + 1);
  for (std::size_t p = 0; p < points; ++p)
    begin_[p + 1] = begin_[p] + filled[p].exchange(0, std::memory_order_relaxed);
  cells_.resize(begin_.back());
  for_each_corner([&](std::uint32_t point, std::uint32_t cell) {
    cells_[begin_[point] + filled[point].fetch_add(1, std::memory_order_relaxed)] = cell;
  });
  // In which order they came depends on the threads.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p)
      std::sort(cells_.begin() + static_cast<std::ptrdiff_t>(begin_[p]),
                cells_.begin() + static_cast<std::ptrdiff_t>(begin_[p + 1]));
  });
}

void PointCells::around(std::size_t point, std::vector<std::uint32_t>& cells) const {
  if (!mesh_.is_grid()) {
    cells.assign(cells_.begin() + static_cast<std::ptrdiff_t>(begin_[point]),
                 cells_.begin() + static_cast<std::ptrdiff_t>(begin_[point + 1]));
    return;
  }
  cells.clear();
  const CellReader reader(mesh_);
  // Along each axis the cell before the point and the one behind it.
  std::array<std::size_t, 3> first, last, count;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto points = static_cast<std::size_t>(mesh_.dimensions[a]);
    const std::size_t index = point % points;
    point /= points;
    count[a] = points - 1;
    first[a] = index > 0 ? index - 1 : 0;
    last[a] = std::min(index, count[a] - 1);
  }
  for (std::size_t k = first[2]; k <= last[2]; ++k)
    for (std::size_t j = first[1]; j <= last[1]; ++j)
      for (std::size_t i = first[0]; i <= last[0]; ++i) {
        const std::size_t cell = i + count[0] * (j + count[1] * k);
        if (!reader.hidden(cell)) cells.push_back(static_cast<std::uint32_t>(cell));
      }
}

}  // namespace plume
