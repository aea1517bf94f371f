#include "plume/mesh/point_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "plume/mesh/explicit_cells.h"

namespace plume {

PointCells cells_around_points(const Mesh& mesh) {
  const CellReader cells(mesh);
  const std::size_t points = mesh.point_count();
  auto for_each_corner = [&](auto&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size()), [&](const auto& range) {
      std::vector<std::uint32_t> ids;
      for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
        if (cells.hidden(cell)) continue;
        cells.points(cell, ids);
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
  PointCells result;
  result.begin.resize(points + 1);
  for (std::size_t p = 0; p < points; ++p)
    result.begin[p + 1] = result.begin[p] + filled[p].exchange(0, std::memory_order_relaxed);
  result.cells.resize(result.begin.back());
  for_each_corner([&](std::uint32_t point, std::uint32_t cell) {
    result.cells[result.begin[point] + filled[point].fetch_add(1, std::memory_order_relaxed)] =
        cell;
  });
  // In which order they came depends on the threads.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p)
      std::sort(result.cells.begin() + static_cast<std::ptrdiff_t>(result.begin[p]),
                result.cells.begin() + static_cast<std::ptrdiff_t>(result.begin[p + 1]));
  });
  return result;
}

}  // namespace plume
