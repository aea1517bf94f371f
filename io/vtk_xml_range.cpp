#include "plume/io/vtk_xml_range.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/io/read_file.h"
#include "plume/io/vtk_errors.h"

namespace plume {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

std::optional<std::array<double, 2>> range_in_piece(vtkXMLDataElement& piece,
                                                    const std::string& field,
                                                    Association association) {
  auto* const arrays =
      piece.FindNestedElementWithName(association == Association::point ? "PointData" : "CellData");
  for (int i = 0; arrays && i < arrays->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* const array = arrays->GetNestedElement(i);
    const char* const name = array->GetAttribute("Name");
    std::array<double, 2> range{};
    if (name && name == field && array->GetScalarAttribute("RangeMin", range[0]) == 1 &&
        array->GetScalarAttribute("RangeMax", range[1]) == 1)
      return range;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::array<double, 2>> vtk_xml_range(const std::filesystem::path& file,
                                                   const std::string& field,
                                                   Association association) {
  std::string header = first_bytes(file, kMostBytes);
  const auto arrays = header.find("<AppendedData");
  if (arrays == std::string::npos) return std::nullopt;
  header.resize(arrays);
  header += "</VTKFile>";
  vtkSmartPointer<vtkXMLDataElement> root;
  with_vtk_errors(file, {}, check_the_file, [&] {
    root.TakeReference(vtkXMLUtilities::ReadElementFromString(header.c_str()));
  });
  if (!root || root->GetNumberOfNestedElements() == 0) return std::nullopt;
  vtkXMLDataElement* const data = root->GetNestedElement(0);  // <UnstructuredGrid> and the like
  std::array<double, 2> all{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
  for (int i = 0; i < data->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* const piece = data->GetNestedElement(i);
    if (std::string(piece->GetName()) != "Piece") continue;
    const auto range = range_in_piece(*piece, field, association);
    if (!range) return std::nullopt;
    all = {std::min(all[0], (*range)[0]), std::max(all[1], (*range)[1])};
  }
  if (!std::isfinite(all[0]) || !std::isfinite(all[1]) || all[0] > all[1]) return std::nullopt;
  return all;
}

}  // namespace plume
