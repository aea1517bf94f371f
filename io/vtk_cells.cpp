#include "plume/io/vtk_cells.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <limits>
#include <span>

#include "plume/io/vtk_arrays.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

// The cell whose corners are the first points of a higher-order cell; the type itself when it is
// no higher-order volume.
int corner_type(int type) {
  switch (type) {
    case VTK_QUADRATIC_TETRA:
    case VTK_HIGHER_ORDER_TETRAHEDRON:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return VTK_TETRA;
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_HIGHER_ORDER_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return VTK_HEXAHEDRON;
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_HIGHER_ORDER_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return VTK_WEDGE;
    case VTK_QUADRATIC_PYRAMID:
    case VTK_TRIQUADRATIC_PYRAMID:
    case VTK_HIGHER_ORDER_PYRAMID:
    case VTK_LAGRANGE_PYRAMID:
    case VTK_BEZIER_PYRAMID:
      return VTK_PYRAMID;
    default:
      return type;
  }
}

const char* name_of(int type) {
  switch (type) {
    case VTK_EMPTY_CELL:
      return "empty cell";
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return "vertex";
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_QUADRATIC_EDGE:
    case VTK_CUBIC_LINE:
    case VTK_LAGRANGE_CURVE:
      return "line";
    case VTK_TRIANGLE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_LAGRANGE_TRIANGLE:
      return "triangle";
    case VTK_TRIANGLE_STRIP:
      return "triangle strip";
    case VTK_POLYGON:
    case VTK_QUADRATIC_POLYGON:
      return "polygon";
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_LAGRANGE_QUADRILATERAL:
      return "quadrilateral";
    case VTK_CONVEX_POINT_SET:
      return "convex point set";
    default:
      return "cell of another type";
  }
}

std::string count_of(std::int64_t count, const std::string& name) {
  const std::string number = std::to_string(count) + " ";
  if (count == 1) return number + name;
  if (name == "vertex") return number + "vertices";
  if (name == "cell of another type") return number + "cells of another type";
  return number + name + "s";
}

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t cell,
                       const std::string& what) {
  throw Error(file.string() + ": cell " + std::to_string(cell) + " " + what +
              "; the file is damaged, write it again");
}

struct Source {
  const std::filesystem::path& file;
  std::span<const std::uint8_t> types;
  std::size_t points;
};

void check_ids(const Source& source, std::size_t cell, auto ids) {
  for (const auto id : ids)
    if (id < 0 || static_cast<std::size_t>(id) >= source.points)
      fail(source.file, cell,
           "uses point " + std::to_string(id) + " of " + std::to_string(source.points));
}

// Everything below reads through the offsets, so they are checked before anything else.
template <class Id>
void check_cells(const Source& source, std::span<const Id> offsets, std::span<const Id> ids) {
  if (offsets.size() != source.types.size() + 1)
    throw Error(source.file.string() + ": " + std::to_string(offsets.size()) + " offsets for " +
                std::to_string(source.types.size()) +
                " cells; the file is damaged, write it again");
  for (std::size_t cell = 0; cell < source.types.size(); ++cell) {
    const Id begin = offsets[cell], end = offsets[cell + 1];
    if (begin < 0 || end < begin || static_cast<std::size_t>(end) > ids.size())
      fail(source.file, cell,
           "has points " + std::to_string(begin) + " to " + std::to_string(end) + " of " +
               std::to_string(ids.size()));
    const int type = corner_type(source.types[cell]);
    if (!is_volume_cell_type(type)) continue;
    const auto wanted = static_cast<Id>(points_per_cell(static_cast<CellType>(type)));
    const bool higher_order = type != source.types[cell];
    if (wanted > 0 && (higher_order ? end - begin < wanted : end - begin != wanted))
      fail(source.file, cell,
           std::string("is a ") + cell_type_name(static_cast<CellType>(type)) + " with " +
               std::to_string(end - begin) + " points");
    check_ids(source, cell,
              ids.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
  }
}

// Volume cells that are to be kept, in order; counts the others.
std::vector<std::int64_t> choose_cells(std::span<const std::uint8_t> types,
                                       const std::vector<std::uint8_t>& hidden, CellCensus& census,
                                       bool& all) {
  // Nearly every file of volume cells has nothing else: find that out before storing ids.
  const auto is_plain = [](std::uint8_t type) { return is_volume_cell_type(type); };
  all = hidden.empty() && std::all_of(types.begin(), types.end(), is_plain);
  if (all) return {};
  std::vector<std::int64_t> kept;
  for (std::size_t cell = 0; cell < types.size(); ++cell) {
    const int type = corner_type(types[cell]);
    if (!is_volume_cell_type(type)) {
      ++census.dropped[types[cell]];
    } else if (!hidden.empty() && hidden[cell]) {
      ++census.hidden;
    } else {
      if (type != types[cell]) ++census.higher_order;
      kept.push_back(static_cast<std::int64_t>(cell));
    }
  }
  return kept;
}

void take_polyhedra(vtkUnstructuredGrid& grid, const Source& source, const VolumeCells& chosen,
                    Cells& cells) {
  vtkIdTypeArray* const faces = grid.GetFaces();
  vtkIdTypeArray* const locations = grid.GetFaceLocations();
  const bool needed =
      std::find(source.types.begin(), source.types.end(), VTK_POLYHEDRON) != source.types.end();
  if (!needed) return;
  if (!faces || !locations ||
      static_cast<std::size_t>(locations->GetNumberOfValues()) != source.types.size())
    throw Error(source.file.string() + ": polyhedra without faces; the file is damaged");
  const std::span<const vtkIdType> stream(faces->GetPointer(0),
                                          static_cast<std::size_t>(faces->GetNumberOfValues()));
  for (std::size_t cell = 0; cell < source.types.size(); ++cell) {
    if (source.types[cell] != VTK_POLYHEDRON) continue;
    const vtkIdType location = locations->GetValue(static_cast<vtkIdType>(cell));
    auto next = static_cast<std::size_t>(location);
    if (location < 0 || next >= stream.size() || stream[next] < 0)
      fail(source.file, cell, "is a polyhedron without faces");
    const vtkIdType count = stream[next++];
    for (vtkIdType face = 0; face < count; ++face) {
      if (next >= stream.size() || stream[next] < 0 ||
          static_cast<std::size_t>(stream[next]) > stream.size() - next - 1)
        fail(source.file, cell, "is a polyhedron whose faces end too early");
      const auto size = static_cast<std::size_t>(stream[next]);
      check_ids(source, cell, stream.subspan(next + 1, size));
      next += size + 1;
    }
  }
  cells.polyhedron_faces = to_array(faces);
  if (chosen.all) {
    cells.polyhedron_locations = to_array(locations);
    return;
  }
  // Faces of dropped cells stay in the stream, where nothing refers to them.
  std::vector<std::int64_t> kept_locations;
  for (const auto cell : chosen.kept)
    kept_locations.push_back(source.types[static_cast<std::size_t>(cell)] == VTK_POLYHEDRON
                                 ? locations->GetValue(cell)
                                 : -1);
  cells.polyhedron_locations = Array::own(std::move(kept_locations));
}

// One type with a fixed number of points needs neither offsets nor a type for each cell.
bool is_uniform(std::span<const std::uint8_t> types) {
  return !types.empty() && types[0] != VTK_POLYHEDRON &&
         std::all_of(types.begin(), types.end(), [&](auto type) { return type == types[0]; });
}

template <class Id>
void copy_kept(const Source& source, std::span<const Id> offsets, std::span<const Id> ids,
               VolumeCells& result) {
  std::vector<std::uint8_t> types;
  std::vector<Id> kept_offsets{0};
  std::vector<Id> kept_ids;
  types.reserve(result.kept.size());
  kept_offsets.reserve(result.kept.size() + 1);
  for (const auto id : result.kept) {
    const auto cell = static_cast<std::size_t>(id);
    const auto type = static_cast<std::uint8_t>(corner_type(source.types[cell]));
    const auto begin = static_cast<std::size_t>(offsets[cell]);
    auto count = static_cast<std::size_t>(offsets[cell + 1]) - begin;
    const int corners = points_per_cell(static_cast<CellType>(type));
    if (corners > 0) count = static_cast<std::size_t>(corners);
    const auto points = ids.subspan(begin, count);
    kept_ids.insert(kept_ids.end(), points.begin(), points.end());
    kept_offsets.push_back(static_cast<Id>(kept_ids.size()));
    types.push_back(type);
  }
  result.cells.connectivity = Array::own(std::move(kept_ids));
  if (is_uniform(types)) {
    types.resize(1);
  } else {
    result.cells.offsets = Array::own(std::move(kept_offsets));
  }
  result.cells.types = Array::own(std::move(types));
}

template <class ArrayType>
void take_cells(vtkUnstructuredGrid& grid, const Source& source, ArrayType* offsets,
                ArrayType* connectivity, VolumeCells& result) {
  using Id = typename ArrayType::ValueType;
  const std::span<const Id> begins(offsets->GetPointer(0),
                                   static_cast<std::size_t>(offsets->GetNumberOfValues()));
  const std::span<const Id> ids(connectivity->GetPointer(0),
                                static_cast<std::size_t>(connectivity->GetNumberOfValues()));
  check_cells(source, begins, ids);
  if (!result.all) {
    copy_kept(source, begins, ids, result);
    return;
  }
  result.cells.connectivity = to_array(connectivity);
  if (is_uniform(source.types) && begins.front() == 0) {
    result.cells.types = Array::own(std::vector<std::uint8_t>{source.types[0]});
  } else {
    result.cells.types = to_array(grid.GetCellTypesArray());
    result.cells.offsets = to_array(offsets);
  }
}

}  // namespace

std::string CellCensus::dropped_cells() const {
  // Several of VTK's types have one name.
  std::map<std::string, std::int64_t> by_name;
  for (const auto& [type, count] : dropped) by_name[name_of(type)] += count;
  std::string text;
  for (const auto& [name, count] : by_name)
    text += (text.empty() ? "" : ", ") + count_of(count, name);
  return text;
}

VolumeCells volume_cells_of(vtkUnstructuredGrid& grid, const std::filesystem::path& file,
                            CellCensus& census) {
  VolumeCells result;
  vtkCellArray* const cells = grid.GetCells();
  vtkUnsignedCharArray* const types = grid.GetCellTypesArray();
  if (!cells || !types || grid.GetNumberOfCells() == 0) return result;
  const Source source{file,
                      {types->GetPointer(0), static_cast<std::size_t>(types->GetNumberOfValues())},
                      static_cast<std::size_t>(grid.GetNumberOfPoints())};
  result.kept = choose_cells(source.types, hidden_cells_of(grid), census, result.all);
  if (!result.all && result.kept.empty()) return result;
  if (cells->IsStorage64Bit())
    take_cells(grid, source, cells->GetOffsetsArray64(), cells->GetConnectivityArray64(), result);
  else
    take_cells(grid, source, cells->GetOffsetsArray32(), cells->GetConnectivityArray32(), result);
  take_polyhedra(grid, source, result, result.cells);
  return result;
}

std::vector<std::uint8_t> hidden_cells_of(vtkDataSet& data) {
  using Attributes = vtkDataSetAttributes;
  constexpr int hiding =
      Attributes::HIDDENCELL | Attributes::DUPLICATECELL | Attributes::REFINEDCELL;
  vtkUnsignedCharArray* const cell_ghosts = data.GetCellGhostArray();
  vtkUnsignedCharArray* const point_ghosts = data.GetPointGhostArray();
  const vtkIdType count = data.GetNumberOfCells();
  std::vector<std::uint8_t> hidden;
  const auto hide = [&](vtkIdType cell) {
    if (hidden.empty()) hidden.resize(static_cast<std::size_t>(count));
    hidden[static_cast<std::size_t>(cell)] = 1;
  };
  if (cell_ghosts && cell_ghosts->GetNumberOfValues() == count)
    for (vtkIdType cell = 0; cell < count; ++cell)
      if (cell_ghosts->GetValue(cell) & hiding) hide(cell);
  if (!point_ghosts || point_ghosts->GetNumberOfValues() != data.GetNumberOfPoints()) return hidden;
  const std::span<const unsigned char> points(
      point_ghosts->GetPointer(0), static_cast<std::size_t>(point_ghosts->GetNumberOfValues()));
  const auto is_hidden = [](unsigned char ghost) { return (ghost & Attributes::HIDDENPOINT) != 0; };
  if (std::none_of(points.begin(), points.end(), is_hidden)) return hidden;
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = 0; cell < count; ++cell) {
    data.GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
      const auto id = static_cast<std::size_t>(ids->GetId(i));
      if (id < points.size() && is_hidden(points[id])) hide(cell);
    }
  }
  return hidden;
}

}  // namespace plume
