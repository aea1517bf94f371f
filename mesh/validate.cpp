#include "plume/mesh/validate.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "plume/mesh/error.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/face_matching.h"
#include "plume/mesh/rectilinear_axes.h"

namespace plume {
namespace {

void check_grid(const Mesh& mesh) {
  const auto& n = mesh.dimensions;
  if (n[0] < 2 || n[1] < 2 || n[2] < 2)
    throw Error(fmt::format("a grid of {} x {} x {} points has no volume cells", n[0], n[1], n[2]));
  const auto points = static_cast<std::size_t>(n[0] * n[1] * n[2]);
  if (points != mesh.point_count())
    throw Error(fmt::format("a grid of {} x {} x {} points needs {} points and has {}", n[0], n[1],
                            n[2], points, mesh.point_count()));
  if (!mesh.hidden_cells.empty() && mesh.hidden_cells.size() != mesh.cell_count())
    throw Error(fmt::format("hidden_cells has {} values for {} cells", mesh.hidden_cells.size(),
                            mesh.cell_count()));
}

// Offsets and types: after this, every cell's points can be read.
void check_layout(const Mesh& mesh) {
  const Cells& cells = mesh.cells;
  const std::size_t count = mesh.cell_count();
  if (cells.types.size() != 1 && cells.types.size() != count)
    throw Error(fmt::format("{} cell types for {} cells", cells.types.size(), count));
  for (std::size_t i = 0; i < cells.types.size(); ++i)
    if (!is_volume_cell_type(cells.types.at<int>(i)))
      throw Error(fmt::format("cell {} is of type {}, which is no volume cell; drop it", i,
                              cells.types.at<int>(i)));
  if (cells.offsets.empty()) return;
  cells.offsets.visit([&](auto offsets) {
    for (std::size_t i = 0; i < count; ++i) {
      const CellType type =
          static_cast<CellType>(cells.types.at<int>(cells.types.size() == 1 ? 0 : i));
      const double begin = static_cast<double>(offsets[i]);
      const double end = static_cast<double>(offsets[i + 1]);
      if (begin < 0 || end < begin || end > static_cast<double>(cells.connectivity.size()))
        throw Error(
            fmt::format("cell {} claims connectivity {} to {} of {}: its offsets are out of order",
                        i, begin, end, cells.connectivity.size()));
      const int wanted = points_per_cell(type);
      if (wanted > 0 && end - begin != wanted)
        throw Error(fmt::format("cell {}, a {}, has {} points instead of {}", i,
                                cell_type_name(type), end - begin, wanted));
    }
  });
}

void check_polyhedra(const Mesh& mesh) {
  const Cells& cells = mesh.cells;
  const std::size_t count = mesh.cell_count();
  const auto stream_size = cells.polyhedron_faces.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (cells.types.at<int>(cells.types.size() == 1 ? 0 : i) !=
        static_cast<int>(CellType::polyhedron))
      continue;
    if (cells.polyhedron_locations.size() != count)
      throw Error(
          fmt::format("cell {} is a polyhedron, but there are {} face locations for {} cells", i,
                      cells.polyhedron_locations.size(), count));
    auto truncated = [&](std::int64_t at) {
      return Error(fmt::format("cell {}, a polyhedron, has faces beyond the face stream ({} of {})",
                               i, at, stream_size));
    };
    std::int64_t at = cells.polyhedron_locations.at<std::int64_t>(i);
    auto next = [&] {
      if (at < 0 || at >= static_cast<std::int64_t>(stream_size)) throw truncated(at);
      return cells.polyhedron_faces.at<std::int64_t>(static_cast<std::size_t>(at++));
    };
    const std::int64_t faces = next();
    for (std::int64_t f = 0; f < faces; ++f) {
      const std::int64_t size = next();
      for (std::int64_t p = 0; p < size; ++p) {
        const std::int64_t id = next();
        if (id < 0 || id >= static_cast<std::int64_t>(mesh.point_count()))
          throw Error(fmt::format("cell {} refers to point {}, but the mesh has points 0 to {}", i,
                                  id, mesh.point_count() - 1));
      }
    }
  }
}

std::size_t cell_of(const Mesh& mesh, std::size_t connectivity_index) {
  if (mesh.cells.offsets.empty())
    return connectivity_index / static_cast<std::size_t>(points_per_cell(
                                    static_cast<CellType>(mesh.cells.types.at<int>(0))));
  return mesh.cells.offsets.visit([&](auto offsets) {
    const auto after = std::upper_bound(
        offsets.begin(), offsets.end(), connectivity_index,
        [](std::size_t i, auto offset) { return i < static_cast<std::size_t>(offset); });
    return static_cast<std::size_t>(after - offsets.begin()) - 1;
  });
}

void check_ids(const Mesh& mesh) {
  const auto points = static_cast<std::int64_t>(mesh.point_count());
  mesh.cells.connectivity.visit([&](auto ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto id = static_cast<std::int64_t>(ids[i]);
      if (id < 0 || id >= points)
        throw Error(fmt::format("cell {} refers to point {}, but the mesh has points 0 to {}",
                                cell_of(mesh, i), id, points - 1));
    }
  });
}

}  // namespace

Bounds check_structure(const Mesh& mesh) {
  if (mesh.is_rectilinear()) return check_axes(mesh);
  if (mesh.points.size() % 3 != 0)
    throw Error(fmt::format("the point array has {} values, which is no multiple of 3",
                            mesh.points.size()));
  const Bounds bounds = bounds_of(mesh.points);
  // Faces are numbered, six a cell at the most; and packets load points by twice their numbers.
  if (mesh.point_count() >= kNone / 2 || mesh.cell_count() >= kNone / 6)
    throw Error(fmt::format("{} points and {} cells are more than Plume can number",
                            mesh.point_count(), mesh.cell_count()));
  if (mesh.is_grid()) {
    check_grid(mesh);
    return bounds;
  }
  if (mesh.cell_count() == 0) throw Error("the mesh has no volume cells");
  check_layout(mesh);
  check_ids(mesh);
  check_polyhedra(mesh);
  return bounds;
}

namespace {

// Length of the diagonal of a cell's box.
double extent_of(const Mesh& mesh, const std::vector<std::uint32_t>& points) {
  Bounds box{point_at(mesh, points[0]), point_at(mesh, points[0])};
  for (const std::uint32_t point : points) {
    const auto p = point_at(mesh, point);
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], p[a]);
      box.high[a] = std::max(box.high[a], p[a]);
    }
  }
  return box.diagonal();
}

// Volumes below this share of the cube over a cell's extent count as zero.
constexpr double kFlat = 1e-12;

struct PoorCells {
  Finding positive{"cells inside out", 0, {}};
  Finding negative{"cells inside out", 0, {}};
  Finding flat{"cells of zero volume", 0, {}};
  Finding repeated{"cells with repeated points", 0, {}};

  void merge(const PoorCells& other) {
    merge(positive, other.positive);
    merge(negative, other.negative);
    merge(flat, other.flat);
    merge(repeated, other.repeated);
  }

 private:
  static void merge(Finding& into, const Finding& from) {
    const std::size_t count = into.count + from.count;
    for (const std::size_t cell : from.examples) add_example(into, cell);
    into.count = count;
  }
};

}  // namespace

std::vector<Finding> find_poor_cells(const Mesh& mesh) {
  // Coordinates that strictly ascend or descend leave no cell without volume or unlike the others.
  if (mesh.is_rectilinear()) return {};
  const CellReader cells(mesh);
  tbb::enumerable_thread_specific<PoorCells> parts;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size()), [&](const auto& range) {
    PoorCells& mine = parts.local();
    std::vector<std::uint32_t> points, sizes, ids;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (cells.hidden(i)) continue;
      cells.points(i, points);
      // The faces of a polyhedron have no agreed sense, so its volume has no sign either.
      if (cells.type(i) != CellType::polyhedron) {
        cells.faces(i, sizes, ids);
        const double volume = signed_volume(mesh, sizes, ids);
        const double extent = extent_of(mesh, points);
        if (std::abs(volume) <= kFlat * extent * extent * extent)
          add_example(mine.flat, i);
        else
          add_example(volume > 0 ? mine.positive : mine.negative, i);
      }
      std::sort(points.begin(), points.end());
      if (std::adjacent_find(points.begin(), points.end()) != points.end())
        add_example(mine.repeated, i);
    }
  });
  PoorCells whole;
  for (const PoorCells& part : parts) whole.merge(part);
  // A mesh may be left-handed as a whole; inside out are the cells that differ from the others.
  Finding& inverted = whole.positive.count < whole.negative.count ? whole.positive : whole.negative;
  std::vector<Finding> findings;
  for (Finding* finding : {&inverted, &whole.flat, &whole.repeated})
    if (finding->count > 0) findings.push_back(std::move(*finding));
  return findings;
}

}  // namespace plume
