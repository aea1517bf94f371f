// Points in text, one a line: .csv, and .xyz where it is no Plot3D grid.
#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include "plume/io/plot3d_layout.h"
#include "plume/io/read_file.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_points.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  text = text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

// Lines of text with values in them, comments and empty lines left out, each cut into its columns.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& file) : tabs_(lower_extension(file) == ".csv") {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(file.string() + ": cannot be opened; check its permissions");
    text_.assign(std::istreambuf_iterator<char>(stream), {});
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
  }

  // False at the end. The first line's separator is that of all.
  bool next(std::vector<std::string_view>& columns) {
    std::string_view line;
    do {
      if (at_ >= text_.size()) return false;
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      line = std::string_view(text_).substr(at_, end - at_);
      at_ = end + 1;
      ++number_;
      const auto begin = line.find_first_not_of(kBlank);
      if (begin == std::string_view::npos || line[begin] == '#') line = {};
    } while (line.empty());
    if (!separator_) {
      separator_ = ' ';
      for (const char c : {',', ';', '\t'})
        if (*separator_ == ' ' && (c != '\t' || tabs_) && line.find(c) != std::string_view::npos)
          separator_ = c;
    }
    cut(line, columns);
    return true;
  }

  std::size_t number() const { return number_; }

 private:
  void cut(std::string_view line, std::vector<std::string_view>& columns) const {
    columns.clear();
    if (*separator_ == ' ') {
      for (std::size_t begin = line.find_first_not_of(kBlank); begin != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
        columns.push_back(trimmed(line.substr(begin, end - begin)));
        begin = line.find_first_not_of(kBlank, end);
      }
      return;
    }
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(*separator_, begin), line.size());
      columns.push_back(trimmed(line.substr(begin, end - begin)));
      begin = end + 1;
    }
  }

  std::string text_;
  bool tabs_;  // separate columns, which may be empty; elsewhere they are blanks
  std::size_t at_ = 0, number_ = 0;
  std::optional<char> separator_;
};

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

struct Columns {
  std::vector<std::string> names;
  std::array<std::size_t, 3> coordinates{0, 1, 2};

  bool is_coordinate(std::size_t column) const {
    return std::find(coordinates.begin(), coordinates.end(), column) != coordinates.end();
  }
};

// x, y and z, or what ParaView calls them.
Columns columns_of_header(const std::vector<std::string_view>& header,
                          const std::filesystem::path& file, std::size_t line) {
  Columns columns;
  for (const std::string_view name : header) columns.names.emplace_back(name);
  for (const std::array<const char*, 3> wanted :
       {std::array{"x", "y", "z"}, std::array{"points:0", "points:1", "points:2"},
        std::array{"points_0", "points_1", "points_2"}}) {
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < header.size(); ++i)
        if (lower(header[i]) == wanted[axis]) {
          columns.coordinates[axis] = i;
          ++found;
          break;
        }
    if (found == 3) return columns;
  }
  std::string names;
  for (const std::string& name : columns.names) names += (names.empty() ? "" : ", ") + name;
  throw Error(
      fmt::format("{}: line {}: no columns x, y and z among '{:.200}'; name them, or leave out the "
                  "header where "
                  "they come first",
                  file.string(), line, names));
}

Columns unnamed_columns(std::size_t count, const std::filesystem::path& file, std::size_t line) {
  if (count < 3)
    throw Error(fmt::format("{}: line {} has {} column{}; a point needs x, y and z", file.string(),
                            line, count, count == 1 ? "" : "s"));
  Columns columns;
  columns.names = {"x", "y", "z"};
  for (std::size_t i = 3; i < count; ++i)
    columns.names.push_back(count == 4 ? "value" : fmt::format("value_{}", i - 2));
  return columns;
}

[[noreturn]] void fail_at(const std::filesystem::path& file, std::size_t line, std::size_t column,
                          const std::string& name, const std::string& what) {
  throw Error(
      fmt::format("{}: line {}, column {} ({}): {}", file.string(), line, column + 1, name, what));
}

double value_at(const std::filesystem::path& file, std::size_t line, const Columns& columns,
                const std::vector<std::string_view>& values, std::size_t column) {
  const std::string text(values[column].substr(0, 40));
  const std::optional<double> value = number_in(values[column]);
  if (!value)
    fail_at(
        file, line, column, columns.names[column],
        text.empty()
            ? "is empty; write nan where there is no value"
            : fmt::format("'{}' is no number; write it with a point, the exponent with e", text));
  if (columns.is_coordinate(column) && !std::isfinite(*value))
    fail_at(file, line, column, columns.names[column],
            fmt::format("the coordinate is '{}', and must be finite; remove or repair the point",
                        text));
  return *value;
}

// "velocity" where names from `first` on are velocity:0, velocity:1, ..., and how many there are.
std::pair<std::string, std::size_t> components_from(const Columns& columns, std::size_t first) {
  const auto component = [&](std::size_t column, std::size_t i) -> std::optional<std::string> {
    const std::string end = fmt::format(":{}", i);
    if (column >= columns.names.size() || columns.is_coordinate(column) ||
        !columns.names[column].ends_with(end))
      return std::nullopt;
    return columns.names[column].substr(0, columns.names[column].size() - end.size());
  };
  const auto name = component(first, 0);
  std::size_t count = 1;
  while (name && component(first + count, count) == name) ++count;
  if (count == 1) return {columns.names[first], 1};
  return {*name, count};
}

vtkSmartPointer<vtkDataObject> poly_data(const Columns& columns,
                                         const std::vector<double>& values) {
  const std::size_t width = columns.names.size();
  const auto count = static_cast<vtkIdType>(values.size() / width);
  const auto gather = [&](const auto& from) {
    const auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetNumberOfComponents(static_cast<int>(from.size()));
    array->SetNumberOfTuples(count);
    double* to = array->GetPointer(0);
    for (std::size_t row = 0; row < values.size(); row += width)
      for (const std::size_t column : from) *to++ = values[row + column];
    return array;
  };
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(gather(columns.coordinates));
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  mark_as_points(*data);
  for (std::size_t column = 0; column < width;) {
    if (columns.is_coordinate(column)) {
      ++column;
      continue;
    }
    const auto [name, components] = components_from(columns, column);
    std::vector<std::size_t> from(components);
    for (std::size_t& one : from) one = column++;
    const auto array = gather(from);
    array->SetName(name.c_str());
    data->GetPointData()->AddArray(array);
  }
  return data;
}

bool is_text(const std::filesystem::path& file) {
  const std::string start = first_bytes(file, 512);
  return std::all_of(start.begin(), start.end(), [](unsigned char c) {
    return (c >= 32 && c != 127) || c == '\n' || c == '\r' || c == '\t' || c == '\f';
  });
}

// What the first line says: a Plot3D grid's begins with its number of blocks, or its dimensions.
enum class FirstLine { a_point, dimensions, block_count };
FirstLine first_line_of(const std::filesystem::path& file) {
  Lines lines(file);
  std::vector<std::string_view> columns;
  if (!lines.next(columns)) return FirstLine::a_point;
  for (const std::string_view text : columns) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < 1)
      return FirstLine::a_point;
  }
  return columns.size() < 3 ? FirstLine::block_count : FirstLine::dimensions;
}

// Reads all of it, once a step is asked for.
vtkSmartPointer<vtkDataObject> read_point_table(const std::filesystem::path& file) {
  if (!is_text(file))
    throw Error(file.string() + ": binary, and should be text, a point a line: x y z [value ...]");
  Lines lines(file);
  std::vector<std::string_view> line;
  if (!lines.next(line)) throw Error(file.string() + ": no points in it");
  const bool has_header =
      std::none_of(line.begin(), line.end(), [](auto text) { return number_in(text).has_value(); });
  const Columns columns = has_header ? columns_of_header(line, file, lines.number())
                                     : unnamed_columns(line.size(), file, lines.number());
  std::vector<double> values;
  if (has_header && !lines.next(line)) throw Error(file.string() + ": a header and no points");
  do {
    if (line.size() != columns.names.size())
      throw Error(fmt::format("{}: line {} has {} columns instead of {}", file.string(),
                              lines.number(), line.size(), columns.names.size()));
    for (std::size_t column = 0; column < line.size(); ++column)
      values.push_back(value_at(file, lines.number(), columns, line, column));
  } while (lines.next(line));
  return poly_data(columns, values);
}

}  // namespace

OpenedFile open_point_table(const std::filesystem::path& file, const ReadOptions&, const Notice&) {
  return std::make_unique<WholeFile>([file](const Notice&) { return read_point_table(file); });
}

OpenedFile open_xyz(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice) {
  if (!is_text(file) || !options.solution.empty()) return open_plot3d(file, options, notice);
  const FirstLine first = first_line_of(file);
  if (first == FirstLine::a_point) return open_point_table(file, options, notice);
  try {
    return open_plot3d(file, options, notice);
  } catch (const Error& error) {
    if (first == FirstLine::block_count) throw;
    throw Error(std::string(error.what()) +
                " (if these are points, put a line with their columns' names before them, x y z)");
  }
}

}  // namespace plume
