// The Stanford polygon format (ply_header.h). VTK's reader knows no vertex properties but colours,
// normals and texture coordinates.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "plume/io/ply_header.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_points.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

using Type = PlyType;
using Property = PlyProperty;
using Element = PlyElement;
using Header = PlyHeader;

constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};  // of each type

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

// The numbers behind the header, one after the other.
class Values {
 public:
  Values(std::string_view bytes, const Header& header, const std::filesystem::path& file)
      : bytes_(bytes.substr(header.length)), header_(header), file_(file) {}

  void at(const Element& element, std::size_t number, const Property& property) {
    element_ = &element;
    number_ = number;
    property_ = &property;
  }

  std::size_t bytes_left() const { return bytes_.size(); }

  double next(Type type) { return header_.text ? next_word() : next_number(type); }

  [[noreturn]] void fail_here(const std::string& what) const {
    fail(file_, fmt::format("{} {} of {}, property {}: {}", element_->name, number_,
                            element_->count, property_->name, what));
  }

 private:
  double next_word() {
    const std::size_t begin = std::min(bytes_.find_first_not_of(" \t\r\n"), bytes_.size());
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", begin), bytes_.size());
    std::string_view word = bytes_.substr(begin, end - begin);
    if (word.empty()) fail_here("the file ends; it is truncated");
    bytes_.remove_prefix(end);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size())
      fail_here(fmt::format("'{:.40}' is no number", word));
    return value;
  }

  template <class T>
  double take() {
    std::array<char, sizeof(T)> raw;
    if (bytes_.size() < raw.size()) fail_here("the file ends; it is truncated");
    std::copy_n(bytes_.data(), raw.size(), raw.begin());
    bytes_.remove_prefix(raw.size());
    if (header_.big_endian != (std::endian::native == std::endian::big))
      std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double next_number(Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return take<float>();
      case Type::float64:
        break;
    }
    return take<double>();
  }

  std::string_view bytes_;
  const Header& header_;
  const std::filesystem::path& file_;
  const Element* element_ = nullptr;
  std::size_t number_ = 0;
  const Property* property_ = nullptr;
};

// A count that the file is too short for would be allocated before that shows.
void check_count(const Element& element, const Values& values, bool text,
                 const std::filesystem::path& file) {
  std::size_t least = 0;
  for (const Property& property : element.properties)
    least += text ? 2
                  : kBytes[static_cast<std::size_t>(property.list ? property.length_type
                                                                  : property.type)];
  if (least > 0 && element.count > values.bytes_left() / least + 1)
    fail(file, fmt::format("truncated: {} of {} and {} bytes for them", element.count, element.name,
                           values.bytes_left()));
}

vtkSmartPointer<vtkDataArray> array_for(Type type) {
  switch (type) {
    case Type::uint8:
      return vtkSmartPointer<vtkUnsignedCharArray>::New();
    case Type::float32:
      return vtkSmartPointer<vtkFloatArray>::New();
    case Type::uint32:  // beyond what an int holds
    case Type::float64:
      return vtkSmartPointer<vtkDoubleArray>::New();
    default:
      return vtkSmartPointer<vtkIntArray>::New();
  }
}

void read_vertices(const Element& element, Values& values, const std::filesystem::path& file,
                   vtkPolyData& data) {
  const auto count = static_cast<vtkIdType>(element.count);
  struct Target {
    vtkSmartPointer<vtkDataArray> array;
    int component = 0;
  };
  std::vector<Target> targets;
  vtkSmartPointer<vtkDataArray> coordinates;
  std::size_t found = 0;
  for (const Property& property : element.properties) {
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.list) {
      targets.emplace_back();
    } else if (property.name.size() == 1 && axis != std::string_view::npos) {
      ++found;
      if (!coordinates) {
        coordinates = array_for(property.type == Type::float64 ? Type::float64 : Type::float32);
        coordinates->SetNumberOfComponents(3);
        coordinates->SetNumberOfTuples(count);
      }
      targets.push_back({coordinates, static_cast<int>(axis)});
    } else {
      targets.push_back({array_for(property.type), 0});
      targets.back().array->SetName(property.name.c_str());
      targets.back().array->SetNumberOfTuples(count);
      data.GetPointData()->AddArray(targets.back().array);
    }
  }
  if (found != 3) fail(file, "PLY header: vertices have no properties x, y and z");
  for (vtkIdType i = 0; i < count; ++i)
    for (std::size_t p = 0; p < targets.size(); ++p) {
      const Property& property = element.properties[p];
      values.at(element, static_cast<std::size_t>(i), property);
      if (property.list) {
        for (double left = values.next(property.length_type); left > 0; --left)
          values.next(property.type);
        continue;
      }
      const double value = values.next(property.type);
      if (targets[p].array == coordinates && !std::isfinite(value))
        values.fail_here(fmt::format("the coordinate is {}, and must be finite", value));
      targets[p].array->SetComponent(i, targets[p].component, value);
    }
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  data.SetPoints(points);
}

void read_faces(const Element& element, Values& values, vtkCellArray& polygons) {
  if (element.properties.empty()) return;
  std::vector<vtkIdType> ids;
  for (std::size_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      values.at(element, i, property);
      const double length = property.list ? values.next(property.length_type) : 1;
      if (!(length >= 0) || length > static_cast<double>(values.bytes_left()))
        values.fail_here(fmt::format("a list of {} values; the file is damaged", length));
      const bool corners =
          property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
      ids.clear();
      for (double n = 0; n < length; ++n) {
        const double value = values.next(property.type);
        if (!corners) continue;
        if (!(std::abs(value) < 1e15)) values.fail_here(fmt::format("point {}", value));
        ids.push_back(static_cast<vtkIdType>(value));
      }
      if (corners) polygons.InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    }
}

void check_ids(vtkPolyData& data, const std::filesystem::path& file) {
  const vtkIdType points = data.GetNumberOfPoints();
  vtkCellArray* const polygons = data.GetPolys();
  const vtkIdType* ids = nullptr;
  vtkIdType size = 0;
  for (vtkIdType face = 0; face < polygons->GetNumberOfCells(); ++face) {
    polygons->GetCellAtId(face, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
      if (ids[i] < 0 || ids[i] >= points)
        fail(file, fmt::format("face {} has vertex {}, and there are {}; write the file again",
                               face, ids[i], points));
  }
}

vtkSmartPointer<vtkDataObject> read_ply(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const Header header = read_ply_header(bytes, file);
  Values values(bytes, header, file);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  const auto polygons = vtkSmartPointer<vtkCellArray>::New(),
             unused = vtkSmartPointer<vtkCellArray>::New();
  bool vertices = false;
  for (const Element& element : header.elements) {
    check_count(element, values, header.text, file);
    if (element.name == "vertex" && !vertices) {
      read_vertices(element, values, file, *data);
      vertices = true;
    } else {
      read_faces(element, values, element.name == "face" ? *polygons : *unused);
    }
  }
  if (!vertices) fail(file, "PLY header: no vertices");
  data->SetPolys(polygons);
  if (polygons->GetNumberOfCells() == 0) mark_as_points(*data);
  check_ids(*data, file);
  return data;
}

}  // namespace

OpenedFile open_ply(const std::filesystem::path& file, const ReadOptions&, const Notice&) {
  return std::make_unique<WholeFile>([file](const Notice&) { return read_ply(file); });
}

}  // namespace plume
