#include "plume/io/read_blocks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "plume/io/read_point_merge.h"
#include "plume/mesh/rectilinear_axes.h"

namespace plume {
namespace {

// Ids of a block's explicit cells, as an array of grids and of explicit cells alike.
struct BlockCells {
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> sizes;
  std::vector<std::int64_t> ids;
  // Which cells of the block these are; empty for all of them.
  std::vector<std::int64_t> kept;
};

BlockCells cells_of_grid(const Mesh& grid) {
  BlockCells cells;
  const auto [ni, nj, nk] = grid.dimensions;
  const std::size_t count = grid.cell_count();
  cells.ids.reserve(8 * count);
  const bool any_hidden = !grid.hidden_cells.empty();
  std::int64_t cell = 0;
  for (std::int64_t k = 0; k + 1 < nk; ++k)
    for (std::int64_t j = 0; j + 1 < nj; ++j)
      for (std::int64_t i = 0; i + 1 < ni; ++i, ++cell) {
        if (any_hidden) {
          if (grid.hidden_cells.at<int>(static_cast<std::size_t>(cell)) != 0) continue;
          cells.kept.push_back(cell);
        }
        const std::int64_t p = i + ni * (j + nj * k), up = ni * nj;
        for (const std::int64_t id :
             {p, p + 1, p + 1 + ni, p + ni, p + up, p + up + 1, p + up + 1 + ni, p + up + ni})
          cells.ids.push_back(id);
      }
  cells.types.assign(cells.ids.size() / 8, static_cast<std::uint8_t>(CellType::hexahedron));
  cells.sizes.assign(cells.types.size(), 8);
  return cells;
}

BlockCells cells_of(const Mesh& block) {
  if (block.is_grid()) return cells_of_grid(block);
  BlockCells cells;
  const std::size_t count = block.cell_count();
  if (count == 0) return cells;  // points alone
  const auto type_of = [&](std::size_t cell) {
    return block.cells.types.at<std::uint8_t>(block.cells.types.size() == 1 ? 0 : cell);
  };
  for (std::size_t cell = 0; cell < count; ++cell) cells.types.push_back(type_of(cell));
  block.cells.connectivity.visit([&](auto ids) {
    const auto append = [&](std::size_t begin, std::size_t end) {
      cells.sizes.push_back(static_cast<std::int64_t>(end - begin));
      for (std::size_t i = begin; i < end; ++i)
        cells.ids.push_back(static_cast<std::int64_t>(ids[i]));
    };
    if (block.cells.offsets.empty()) {
      const auto n = static_cast<std::size_t>(points_per_cell(static_cast<CellType>(type_of(0))));
      for (std::size_t cell = 0; cell < count; ++cell) append(cell * n, (cell + 1) * n);
    } else {
      for (std::size_t cell = 0; cell < count; ++cell)
        append(block.cells.offsets.at<std::size_t>(cell),
               block.cells.offsets.at<std::size_t>(cell + 1));
    }
  });
  return cells;
}

// Where block b's point p goes is ids[b][p].
using PointIds = std::vector<std::vector<std::int64_t>>;

class CellList {
 public:
  void append(const Mesh& block, const BlockCells& cells, const std::vector<std::int64_t>& ids) {
    const auto id_of = [&](std::int64_t id) { return ids[static_cast<std::size_t>(id)]; };
    std::size_t next = 0;
    for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
      types_.push_back(cells.types[cell]);
      for (std::int64_t i = 0; i < cells.sizes[cell]; ++i)
        connectivity_.push_back(id_of(cells.ids[next++]));
      offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
      locations_.push_back(-1);
      if (cells.types[cell] != static_cast<std::uint8_t>(CellType::polyhedron)) continue;
      locations_.back() = static_cast<std::int64_t>(faces_.size());
      block.cells.polyhedron_faces.visit([&](auto stream) {
        auto at = block.cells.polyhedron_locations.at<std::size_t>(cell);
        const auto face_count = static_cast<std::int64_t>(stream[at++]);
        faces_.push_back(face_count);
        for (std::int64_t face = 0; face < face_count; ++face) {
          const auto size = static_cast<std::int64_t>(stream[at++]);
          faces_.push_back(size);
          for (std::int64_t i = 0; i < size; ++i)
            faces_.push_back(id_of(static_cast<std::int64_t>(stream[at++])));
        }
      });
    }
  }

  Cells finish(std::size_t points) {
    Cells cells;
    const bool one_type = std::all_of(types_.begin(), types_.end(),
                                      [&](auto type) { return type == types_.front(); });
    const bool polyhedra = !faces_.empty();
    if (one_type && !polyhedra)
      types_.resize(1);
    else
      cells.offsets = Array::own(std::move(offsets_));
    if (points <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      cells.connectivity =
          Array::own(std::vector<std::int32_t>(connectivity_.begin(), connectivity_.end()));
    else
      cells.connectivity = Array::own(std::move(connectivity_));
    cells.types = Array::own(std::move(types_));
    if (polyhedra) {
      cells.polyhedron_locations = Array::own(std::move(locations_));
      cells.polyhedron_faces = Array::own(std::move(faces_));
    }
    return cells;
  }

 private:
  std::vector<std::uint8_t> types_;
  std::vector<std::int64_t> offsets_{0};
  std::vector<std::int64_t> connectivity_;
  std::vector<std::int64_t> locations_;
  std::vector<std::int64_t> faces_;
};

template <class T>
std::vector<T> all_points(const std::vector<Mesh>& blocks) {
  std::vector<T> points;
  std::size_t total = 0;
  for (const Mesh& block : blocks) total += block.points.size();
  points.reserve(total);
  for (const Mesh& block : blocks)
    block.points.visit([&](auto values) {
      for (const auto value : values) points.push_back(static_cast<T>(value));
    });
  return points;
}

// Numbers the points of all blocks and gives the coordinates of those that stay.
template <class T>
Array number_points(const std::vector<Mesh>& blocks, bool merge_points, PointIds& ids) {
  std::vector<T> points = all_points<T>(blocks);
  std::int64_t next = 0;
  for (const Mesh& block : blocks) {
    ids.emplace_back(block.point_count());
    for (auto& id : ids.back()) id = next++;
  }
  if (merge_points) merge_block_points(points, ids);
  return Array::own(std::move(points));
}

const Field* find(const Mesh& block, const Field& like) {
  for (const Field& field : block.fields)
    if (field.name == like.name && field.association == like.association &&
        field.components == like.components)
      return &field;
  return nullptr;
}

template <class T>
Array join(const std::vector<const Field*>& parts, const std::vector<BlockCells>& cells,
           const PointIds& ids, std::size_t point_count, std::int64_t& conflicts) {
  const auto components = static_cast<std::size_t>(parts[0]->components);
  const bool on_points = parts[0]->association == Association::point;
  std::vector<T> joined;
  if (on_points) joined.reserve(point_count * components);
  for (std::size_t b = 0; b < parts.size(); ++b) {
    parts[b]->values.visit([&](auto values) {
      const auto append = [&](std::size_t from) {
        for (std::size_t c = 0; c < components; ++c)
          joined.push_back(static_cast<T>(values[from * components + c]));
      };
      if (on_points) {
        for (std::size_t p = 0; p < ids[b].size(); ++p) {
          const auto to = static_cast<std::size_t>(ids[b][p]) * components;
          if (to >= joined.size()) {
            append(p);
            continue;
          }
          bool same = true;
          for (std::size_t c = 0; c < components; ++c)
            same = same && joined[to + c] == static_cast<T>(values[p * components + c]);
          if (!same) ++conflicts;
        }
      } else if (!cells[b].kept.empty()) {
        for (const auto cell : cells[b].kept) append(static_cast<std::size_t>(cell));
      } else {
        for (std::size_t cell = 0; cell < cells[b].types.size(); ++cell) append(cell);
      }
    });
  }
  return Array::own(std::move(joined));
}

Array join_field(const std::vector<const Field*>& parts, const std::vector<BlockCells>& cells,
                 const PointIds& ids, std::size_t point_count, std::int64_t& conflicts) {
  const bool one_type = std::all_of(parts.begin(), parts.end(), [&](const Field* part) {
    return part->values.type() == parts[0]->values.type();
  });
  if (!one_type) return join<double>(parts, cells, ids, point_count, conflicts);
  return parts[0]->values.visit([&](auto values) {
    using T = std::remove_cv_t<typename decltype(values)::value_type>;
    return join<T>(parts, cells, ids, point_count, conflicts);
  });
}

}  // namespace

Mesh append_blocks(std::vector<Mesh> blocks, bool merge_points, const std::filesystem::path& file,
                   const Notice& notice) {
  for (Mesh& block : blocks)
    if (block.is_rectilinear()) block = with_points(block);
  Mesh mesh;
  PointIds ids;
  const bool any_double = std::any_of(blocks.begin(), blocks.end(), [](const Mesh& block) {
    return block.points.type() == Array::Type::float64;
  });
  mesh.points = any_double ? number_points<double>(blocks, merge_points, ids)
                           : number_points<float>(blocks, merge_points, ids);

  std::vector<BlockCells> cells;
  CellList list;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    cells.push_back(cells_of(blocks[b]));
    list.append(blocks[b], cells.back(), ids[b]);
  }
  mesh.cells = list.finish(mesh.point_count());

  const auto say = [&](const std::string& text) {
    if (notice) notice(file.string() + ": " + text);
  };
  // In how many blocks a field is that not all of them have, in the order of their names.
  std::map<std::string, std::size_t> partial;
  for (const Mesh& block : blocks)
    for (const Field& field : block.fields) {
      std::vector<const Field*> parts;
      for (const Mesh& other : blocks)
        if (const Field* part = find(other, field)) parts.push_back(part);
      if (parts.size() < blocks.size()) {
        partial[field.name] = std::max(partial[field.name], parts.size());
        continue;
      }
      if (&block != &blocks.front()) continue;
      std::int64_t conflicts = 0;
      Field joined{field.name, field.association, field.components, {}};
      joined.values = join_field(parts, cells, ids, mesh.point_count(), conflicts);
      if (conflicts > 0)
        say("field '" + field.name + "' differs between blocks at " + std::to_string(conflicts) +
            " merged points; the first block's values are kept");
      mesh.fields.push_back(std::move(joined));
    }
  for (const auto& [name, count] : partial)
    say("field '" + name + "' dropped: only " + std::to_string(count) + " of " +
        std::to_string(blocks.size()) + " blocks have it");

  const std::string& active = blocks.front().active_field;
  if (std::any_of(mesh.fields.begin(), mesh.fields.end(),
                  [&](const Field& field) { return field.name == active; }))
    mesh.active_field = active;
  return mesh;
}

}  // namespace plume
