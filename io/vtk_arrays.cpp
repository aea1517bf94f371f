#include "plume/io/vtk_arrays.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkPointData.h>

#include <algorithm>
#include <memory>
#include <span>

#include "plume/mesh/error.h"

namespace plume {
namespace {

template <class T>
Array borrow(vtkDataArray* values) {
  const auto held = std::make_shared<const vtkSmartPointer<vtkDataArray>>(values);
  return Array::borrow(std::span<const T>(static_cast<const T*>(values->GetVoidPointer(0)),
                                          static_cast<std::size_t>(values->GetNumberOfValues())),
                       held);
}

Array convert_to_float(vtkDataArray* values) {
  std::vector<float> converted(static_cast<std::size_t>(values->GetNumberOfValues()));
  const int components = values->GetNumberOfComponents();
  std::size_t next = 0;
  for (vtkIdType tuple = 0; tuple < values->GetNumberOfTuples(); ++tuple)
    for (int c = 0; c < components; ++c)
      converted[next++] = static_cast<float>(values->GetComponent(tuple, c));
  return Array::own(std::move(converted));
}

bool is_taken(const std::vector<Field>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Field& field) { return field.name == name; });
}

// Pressure on points and pressure on cells are two fields, which a user must be able to tell apart.
std::string unique_name(const std::vector<Field>& fields, const std::string& wanted,
                        Association association) {
  if (!is_taken(fields, wanted)) return wanted;
  std::string name = wanted + (association == Association::cell ? "_cell" : "_point");
  for (int i = 2; is_taken(fields, name); ++i) name = wanted + "_" + std::to_string(i);
  return name;
}

void add_fields(vtkDataSetAttributes& data, Association association, std::size_t expected,
                const std::filesystem::path& file, const Notice& notice, std::vector<Field>& fields,
                std::string& active) {
  vtkDataArray* const active_scalars = data.GetScalars();
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    // Null for an array of strings, which has no picture.
    vtkDataArray* const array = data.GetArray(i);
    if (!array || array->GetNumberOfComponents() < 1) continue;
    if (array == data.GetGlobalIds() || array == data.GetPedigreeIds()) continue;
    const std::string given = array->GetName() ? array->GetName() : "";
    if (given == vtkDataSetAttributes::GhostArrayName()) continue;
    if (static_cast<std::size_t>(array->GetNumberOfTuples()) != expected)
      throw Error(file.string() + ": array '" + given + "' has " +
                  std::to_string(array->GetNumberOfTuples()) + " values for " +
                  std::to_string(expected) +
                  (association == Association::cell ? " cells" : " points") +
                  "; the file is damaged or truncated");
    const std::string wanted = given.empty() ? "unnamed" : given;
    Field field;
    field.name = unique_name(fields, wanted, association);
    field.association = association;
    field.components = array->GetNumberOfComponents();
    field.values = to_array(array);
    if (field.name != wanted && notice)
      notice(file.string() + ": a second array '" + wanted + "' is called '" + field.name + "'");
    if (array == active_scalars && active.empty()) active = field.name;
    fields.push_back(std::move(field));
  }
}

}  // namespace

Array to_array(vtkDataArray* values) {
  if (values->HasStandardMemoryLayout()) {
    switch (values->GetDataType()) {
      case VTK_FLOAT:
        return borrow<float>(values);
      case VTK_DOUBLE:
        return borrow<double>(values);
      case VTK_UNSIGNED_CHAR:
        return borrow<std::uint8_t>(values);
      case VTK_INT:
        return borrow<int>(values);
      case VTK_LONG:
        if constexpr (sizeof(long) == 8) return borrow<long>(values);
        break;
      case VTK_LONG_LONG:
        return borrow<long long>(values);
      case VTK_ID_TYPE:
        return borrow<vtkIdType>(values);
      default:
        break;
    }
  }
  return convert_to_float(values);
}

Array to_coordinates(vtkDataArray* values) {
  const Array array = to_array(values);
  if (array.type() == Array::Type::float32 || array.type() == Array::Type::float64) return array;
  return convert_to_float(values);
}

std::vector<Field> fields_of(vtkDataSet& data, const std::filesystem::path& file,
                             const Notice& notice, std::string& active) {
  std::vector<Field> fields;
  active.clear();
  add_fields(*data.GetPointData(), Association::point,
             static_cast<std::size_t>(data.GetNumberOfPoints()), file, notice, fields, active);
  add_fields(*data.GetCellData(), Association::cell,
             static_cast<std::size_t>(data.GetNumberOfCells()), file, notice, fields, active);
  return fields;
}

Field select_cells(const Field& field, const std::vector<std::int64_t>& cells) {
  Field selected = field;
  selected.values = field.values.visit([&](auto values) {
    using T = std::remove_cv_t<typename decltype(values)::value_type>;
    const auto components = static_cast<std::size_t>(field.components);
    std::vector<T> kept;
    kept.reserve(cells.size() * components);
    for (const auto cell : cells)
      for (std::size_t c = 0; c < components; ++c)
        kept.push_back(values[static_cast<std::size_t>(cell) * components + c]);
    return Array::own(std::move(kept));
  });
  return selected;
}

}  // namespace plume
