#include "plume/mesh/walkable_cells.h"

#include <algorithm>
#include <mutex>

#include "plume/mesh/closed_cell.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/orientation.h"
#include "plume/mesh/space_curve.h"

namespace plume {
namespace {

// All cells' faces before those of neighbours are joined: a slot for each face of each cell.
struct Slots {
  std::vector<std::uint32_t> cell_begin{0};  // cells + 1 offsets into the slots
  std::vector<std::uint32_t> cell;           // of each slot
  std::vector<std::uint32_t> begin{0};       // slots + 1 offsets into ids
  std::vector<std::uint32_t> ids;
  std::vector<std::uint32_t> partner;  // the same face of the neighbour, or kNone
  std::vector<double> volume;          // of each cell

  std::span<const std::uint32_t> loop(std::uint32_t slot) const {
    return {ids.data() + begin[slot], ids.data() + begin[slot + 1]};
  }
};

std::vector<std::uint32_t> curve_order(const Mesh& mesh, const CellReader& cells,
                                       const LocalFrame& frame) {
  return hilbert_order(cells.size(), [&](std::size_t i) {
    thread_local std::vector<std::uint32_t> ids;
    cells.points(i, ids);
    std::array<double, 3> center{0, 0, 0};
    for (const std::uint32_t id : ids) {
      const auto p = point_at(mesh, id);
      for (std::size_t a = 0; a < 3; ++a) center[a] += p[a];
    }
    for (double& x : center) x /= static_cast<double>(std::max<std::size_t>(ids.size(), 1));
    const WalkablePoint p = frame.local(center[0], center[1], center[2], 0);
    return std::array<float, 3>{p.position[0], p.position[1], p.position[2]};
  });
}

// Reads the faces of all cells, leaving out cells without an inside.
Slots read_slots(const Mesh& mesh, const CellReader& cells, std::vector<std::uint32_t>& order,
                 std::vector<Finding>& findings) {
  Slots slots;
  Finding open{"cells whose faces leave a gap, left out", 0, {}};
  CellFaces faces;
  std::erase_if(order, [&](std::uint32_t cell) {
    cells.faces(cell, faces.sizes, faces.ids);
    drop_repeated_points(faces);
    const bool closed =
        cells.type(cell) == CellType::polyhedron ? close_and_orient(mesh, faces) : is_closed(faces);
    if (!closed || faces.sizes.empty()) {
      add_example(open, cell);
      return true;
    }
    slots.volume.push_back(signed_volume(mesh, faces.sizes, faces.ids));
    slots.ids.insert(slots.ids.end(), faces.ids.begin(), faces.ids.end());
    const auto index = static_cast<std::uint32_t>(slots.cell_begin.size() - 1);
    for (const std::uint32_t size : faces.sizes) {
      slots.begin.push_back(slots.begin.back() + size);
      slots.cell.push_back(index);
    }
    slots.cell_begin.push_back(static_cast<std::uint32_t>(slots.cell.size()));
    return false;
  });
  if (open.count > 0) findings.push_back(std::move(open));
  slots.partner.assign(slots.cell.size(), kNone);
  return slots;
}

// Whether two loops go around the same points, and if so, in opposite directions.
enum class Loops { different, same_way, opposite };
Loops compare(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  if (a.size() != b.size()) return Loops::different;
  const std::size_t n = a.size();
  for (std::size_t start = 0; start < n; ++start) {
    if (b[start] != a[0]) continue;
    bool forward = true, backward = true;
    for (std::size_t i = 1; i < n; ++i) {
      forward = forward && a[i] == b[(start + i) % n];
      backward = backward && a[i] == b[(start + n - i) % n];
    }
    if (backward) return Loops::opposite;
    if (forward) return Loops::same_way;
  }
  return Loops::different;
}

void match(std::size_t points, Slots& slots, const std::vector<std::uint32_t>& original,
           std::vector<Finding>& findings) {
  Finding crowded{"faces shared by more than two cells", 0, {}};
  std::mutex guard;
  auto key = [&](std::size_t slot) {
    std::array<std::uint32_t, 3> smallest{kNone, kNone, kNone};
    for (std::uint32_t id : slots.loop(static_cast<std::uint32_t>(slot)))
      for (auto& place : smallest)
        if (id < place) std::swap(id, place);
    return smallest;
  };
  match_faces(
      points, slots.cell.size(), key,
      [&](std::uint32_t a, std::uint32_t b) {
        // Two faces of one collapsed cell may coincide; a cell is no neighbour of itself.
        return slots.cell[a] != slots.cell[b] &&
               compare(slots.loop(a), slots.loop(b)) != Loops::different;
      },
      [&](std::uint32_t a, std::uint32_t b) {
        slots.partner[a] = b;
        slots.partner[b] = a;
      },
      [&](std::uint32_t slot) {
        const std::lock_guard lock(guard);
        add_example(crowded, original[slots.cell[slot]]);
      });
  if (crowded.count > 0) findings.push_back(std::move(crowded));
}

// Gives all cells one sense of inside; a turned cell has its loops reversed.
void orient(Slots& slots, const std::vector<std::uint32_t>& original,
            std::vector<Finding>& findings) {
  Finding one_sided{"faces where neighbours cannot agree on a side, taken as boundary", 0, {}};
  std::vector<std::uint32_t> cuts;
  const auto turned = cells_to_turn(
      slots.volume.size(),
      [&](std::uint32_t cell, const auto& visit) {
        for (std::uint32_t s = slots.cell_begin[cell]; s < slots.cell_begin[cell + 1]; ++s) {
          const std::uint32_t other = slots.partner[s];
          if (other == kNone) continue;
          const bool agree = compare(slots.loop(s), slots.loop(other)) == Loops::opposite;
          visit(slots.cell[other], agree, static_cast<int>(s - slots.cell_begin[cell]));
        }
      },
      [&](std::uint32_t cell) { return slots.volume[cell]; },
      [&](std::uint32_t cell, int face) {
        cuts.push_back(slots.cell_begin[cell] + static_cast<std::uint32_t>(face));
      });
  for (const std::uint32_t slot : cuts) {
    slots.partner[slot] = kNone;
    add_example(one_sided, original[slots.cell[slot]]);
  }
  if (one_sided.count > 0) findings.push_back(std::move(one_sided));
  Finding reversed{"cells listed with the opposite orientation, turned around", 0, {}};
  for (std::uint32_t cell = 0; cell < slots.volume.size(); ++cell) {
    if (!turned[cell]) continue;
    add_example(reversed, original[cell]);
    for (std::uint32_t s = slots.cell_begin[cell]; s < slots.cell_begin[cell + 1]; ++s)
      std::reverse(slots.ids.begin() + slots.begin[s], slots.ids.begin() + slots.begin[s + 1]);
  }
  if (reversed.count > 0) findings.push_back(std::move(reversed));
}

// Numbers the faces in the order of the cells and joins those of neighbours.
void store_faces(const Slots& slots, WalkableCells& result) {
  result.face_begin.push_back(0);
  result.cell_begin = slots.cell_begin;
  result.cell_faces.resize(slots.cell.size());
  for (std::uint32_t slot = 0; slot < slots.cell.size(); ++slot) {
    const std::uint32_t partner = slots.partner[slot];
    if (partner != kNone && partner < slot) {
      const std::uint32_t face = result.cell_faces[partner];
      result.cell_faces[slot] = face;
      result.face_sides[face].neighbor = slots.cell[slot];
      continue;
    }
    const auto face = static_cast<std::uint32_t>(result.face_sides.size());
    const auto loop = slots.loop(slot);
    result.cell_faces[slot] = face;
    result.face_points.insert(result.face_points.end(), loop.begin(), loop.end());
    result.face_begin.push_back(static_cast<std::uint32_t>(result.face_points.size()));
    result.face_sides.push_back({slots.cell[slot], kNone});
    if (partner == kNone) result.boundary.push_back({slots.cell[slot], face});
  }
}

// Points in the order in which the faces first use them; unused points are left out. Returns the
// number of each of the user's points, kNone where there is none.
std::vector<std::uint32_t> store_points(const Mesh& mesh, const ScalarField& scalar,
                                        WalkableCells& result) {
  std::vector<std::uint32_t> renumbered(mesh.point_count(), kNone);
  for (std::uint32_t& point : result.face_points) {
    if (renumbered[point] == kNone) {
      renumbered[point] = static_cast<std::uint32_t>(result.points.size());
      const auto p = point_at(mesh, point);
      result.points.push_back(result.frame.local(
          p[0], p[1], p[2],
          scalar.association == Association::point ? scalar.values[point] : 0.0f));
    }
    point = renumbered[point];
  }
  return renumbered;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::size_t WalkableCells::bytes() const {
  return bytes_of(points) + bytes_of(face_begin) + bytes_of(face_points) + bytes_of(face_sides) +
         bytes_of(cell_begin) + bytes_of(cell_faces) + bytes_of(cell_values) +
         bytes_of(original_cells) + bytes_of(point_numbers) + bytes_of(boundary) +
         bytes_of(corner_cells) + edge_cells.bytes();
}

void prepare_packets(WalkableCells& mesh) {
  mesh.corner_cells = make_corner_cells(mesh);
  mesh.edge_cells = make_edge_cells(mesh);
}

WalkableCells make_walkable_cells(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                  bool keep_original_cells, bool keep_point_numbers) {
  WalkableCells result;
  result.frame = LocalFrame::of(bounds);
  const CellReader cells(mesh);
  std::vector<std::uint32_t> order = curve_order(mesh, cells, result.frame);
  Slots slots = read_slots(mesh, cells, order, result.findings);
  match(mesh.point_count(), slots, order, result.findings);
  orient(slots, order, result.findings);
  store_faces(slots, result);
  std::vector<std::uint32_t> numbers = store_points(mesh, scalar, result);
  if (keep_point_numbers) result.point_numbers = std::move(numbers);
  if (scalar.association == Association::cell) {
    result.cell_values.reserve(order.size());
    for (const std::uint32_t cell : order) result.cell_values.push_back(scalar.values[cell]);
  }
  if (keep_original_cells) result.original_cells = std::move(order);
  return result;
}

}  // namespace plume
