#include "plume/io/plot3d_layout.h"

#include <cstdint>
#include <optional>

#include "plume/io/plot3d_bytes.h"
#include "plume/io/read_file.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

// Beyond these a header is taken for something else. They keep all sizes far from overflow.
constexpr std::int32_t most_blocks = 100000;
constexpr std::int32_t most_points_along_an_axis = 1000000;
constexpr std::uint64_t most_points = std::uint64_t{1} << 40;

// What the header says, in whatever way it was read.
struct Header {
  Plot3dLayout layout;
  /// Bytes of the header, or numbers of it in a text file.
  std::uint64_t length = 0;
  /// Integers behind the dimensions of an Overflow solution file: variables, species.
  std::int32_t variables = 5;
  bool is_overflow = false;
};

std::uint64_t points_in(const std::array<int, 3>& block) {
  return static_cast<std::uint64_t>(block[0]) * static_cast<std::uint64_t>(block[1]) *
         static_cast<std::uint64_t>(block[2]);
}

std::uint64_t points_in(const Plot3dLayout& layout) {
  std::uint64_t points = 0;
  for (const auto& block : layout.blocks) points += points_in(block);
  return points;
}

// Reads `count` blocks' dimensions through `next`, which gives one integer after the other.
bool read_dimensions(std::int32_t count, int axes, auto&& next,
                     std::vector<std::array<int, 3>>& blocks) {
  std::uint64_t points = 0;
  for (std::int32_t block = 0; block < count; ++block) {
    std::array<int, 3> dimensions{1, 1, 1};
    for (int axis = 0; axis < axes; ++axis) {
      const std::optional<std::int32_t> n = next();
      if (!n || *n < 1 || *n > most_points_along_an_axis) return false;
      dimensions[static_cast<std::size_t>(axis)] = *n;
    }
    points += points_in(dimensions);
    if (points > most_points) return false;
    blocks.push_back(dimensions);
  }
  return true;
}

std::optional<Header> binary_header(const std::filesystem::path& file, Plot3dLayout layout,
                                    int axes) {
  Plot3dIntegers integers(file, layout.little_endian);
  const auto mark_is = [&](std::int32_t bytes) {
    return !layout.record_marks || integers.next() == bytes;
  };
  std::int32_t count = 1;
  if (layout.multi_block) {
    if (!mark_is(4)) return std::nullopt;
    const auto n = integers.next();
    if (!n || *n < 1 || *n > most_blocks || !mark_is(4)) return std::nullopt;
    count = *n;
  }
  Header header;
  const std::int32_t bytes = 4 * axes * count;
  bool overflow = false;
  if (layout.record_marks) {
    const auto mark = integers.next();
    overflow = mark == bytes + 8;
    if (mark != bytes && !overflow) return std::nullopt;
  }
  if (!read_dimensions(
          count, axes, [&] { return integers.next(); }, layout.blocks))
    return std::nullopt;
  if (overflow) {
    const auto variables = integers.next(), species = integers.next();
    if (!variables || !species || *variables < 5 || *variables > 1000 || *species < 0 ||
        *species > *variables)
      return std::nullopt;
    header.variables = *variables;
    header.is_overflow = true;
  }
  if (!mark_is(overflow ? bytes + 8 : bytes)) return std::nullopt;
  header.layout = std::move(layout);
  header.length = integers.position();
  return header;
}

std::optional<Header> text_header(const Plot3dText& text, bool multi_block, int axes) {
  Header header;
  header.layout.text = true;
  header.layout.multi_block = multi_block;
  // Text has more digits than a float can hold.
  header.layout.double_precision = true;
  std::size_t next = 0;
  std::int32_t count = 1;
  if (multi_block) {
    const auto n = text.integer(next++);
    if (!n || *n < 1 || *n > most_blocks) return std::nullopt;
    count = *n;
  }
  if (!read_dimensions(
          count, axes, [&] { return text.integer(next++); }, header.layout.blocks))
    return std::nullopt;
  header.length = next;
  return header;
}

std::vector<Plot3dLayout> binary_layouts() {
  std::vector<Plot3dLayout> layouts;
  // Record marks first: they cannot be there by chance.
  for (const bool marks : {true, false})
    for (const bool little_endian : {false, true})
      for (const bool multi_block : {false, true}) {
        Plot3dLayout layout;
        layout.record_marks = marks;
        layout.little_endian = little_endian;
        layout.multi_block = multi_block;
        layouts.push_back(layout);
      }
  return layouts;
}

// Bytes of a grid file, or numbers where it is text.
std::uint64_t grid_length(const Header& header, int axes) {
  const Plot3dLayout& layout = header.layout;
  const std::uint64_t per_point =
      layout.text ? static_cast<std::uint64_t>(axes) + (layout.blanking ? 1 : 0)
                  : static_cast<std::uint64_t>(axes) * (layout.double_precision ? 8 : 4) +
                        (layout.blanking ? 4 : 0);
  const std::uint64_t marks = layout.record_marks ? 8 * layout.blocks.size() : 0;
  return header.length + marks + points_in(layout) * per_point;
}

std::uint64_t solution_length(const Header& header) {
  const Plot3dLayout& layout = header.layout;
  const std::uint64_t number = layout.text ? 1 : layout.double_precision ? 8 : 4;
  const std::uint64_t marks = layout.record_marks ? 16 : 0;
  return header.length + layout.blocks.size() * (4 * number + marks) +
         points_in(layout) * 5 * number;
}

std::string size_of(const Plot3dLayout& layout) {
  const auto& first = layout.blocks.front();
  std::string text = std::to_string(layout.blocks.size()) +
                     (layout.blocks.size() == 1 ? " block of " : " blocks, the first of ");
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += (axis ? " x " : "") + std::to_string(first[axis]);
  return text + " points";
}

struct Contents {
  std::optional<Plot3dText> text;
  /// Bytes, or numbers where it is text.
  std::uint64_t length = 0;

  explicit Contents(const std::filesystem::path& file) {
    if (looks_like_numbers(first_bytes(file, 512))) text.emplace(file);
    length = text ? text->count() : std::filesystem::file_size(file);
  }
};

// Headers the file could have, with `axes` dimensions for each block.
std::vector<Header> possible_headers(const std::filesystem::path& file, const Contents& contents,
                                     int axes) {
  std::vector<Header> headers;
  if (contents.text) {
    for (const bool multi_block : {false, true})
      if (auto header = text_header(*contents.text, multi_block, axes)) headers.push_back(*header);
  } else {
    for (const auto& layout : binary_layouts())
      if (auto header = binary_header(file, layout, axes)) headers.push_back(*header);
  }
  return headers;
}

// All the ways in which a header's points could be written.
std::vector<Header> with_precisions(const Header& header) {
  std::vector<Header> all;
  for (const bool blanking : {false, true})
    for (const bool is_double : {false, true}) {
      if (header.layout.text && !is_double) continue;
      all.push_back(header);
      all.back().layout.blanking = blanking;
      all.back().layout.double_precision = is_double;
    }
  return all;
}

[[noreturn]] void fail_by_length(const std::filesystem::path& file,
                                 const std::vector<Header>& headers, const Contents& contents,
                                 const char* kind, auto&& least_length) {
  // A header that would fill a file several times this size is more likely no header.
  for (const Header& header : headers) {
    const std::uint64_t least = least_length(header);
    const bool trusted = header.layout.record_marks || least / 64 < contents.length;
    if (contents.length < least && trusted)
      throw Error(file.string() + ": truncated: " + size_of(header.layout) + " take at least " +
                  std::to_string(least) + (contents.text ? " numbers" : " bytes") +
                  ", and it has " + std::to_string(contents.length) + "; copy it again");
  }
  throw Error(file.string() + ": no Plot3D " + kind +
              " of any known layout (binary of either byte order, with or without record marks, "
              "float or double, or text); check that it is one, and whole");
}

// Overflow's records differ in length from file to file; their marks have to lead to its end.
void check_overflow(const std::filesystem::path& file, const Header& header) {
  Plot3dIntegers integers(file, header.layout.little_endian);
  integers.skip(header.length);
  const std::int64_t number = header.layout.double_precision ? 8 : 4;
  const auto record = [&](auto&& fits) {
    const auto length = integers.next();
    if (!length || !fits(*length)) return false;
    integers.skip(static_cast<std::uint64_t>(*length));
    return integers.next() == length;
  };
  for (const auto& block : header.layout.blocks) {
    const auto values = static_cast<std::int64_t>(points_in(block)) * header.variables * number;
    if (!record([&](std::int64_t length) { return length >= 7 * number + 4 && length < 10000; }) ||
        !record([&](std::int64_t length) { return length == values; }))
      throw Error(file.string() + ": a record of this Overflow solution is not as long as " +
                  size_of(header.layout) + " and " + std::to_string(header.variables) +
                  " variables ask for; the file is damaged or truncated");
  }
}

void check_dimensions(const std::filesystem::path& file, const Plot3dLayout& solution,
                      const Plot3dLayout& grid) {
  if (solution.blocks != grid.blocks)
    throw Error(file.string() + ": holds " + size_of(solution) + ", its grid " + size_of(grid) +
                "; name the solution that belongs to the grid");
}

// Some old systems fill files up to a whole disk block.
bool fits(std::uint64_t needed, std::uint64_t length, bool is_text) {
  constexpr std::uint64_t disk_block = 512;
  if (needed == length) return true;
  return !is_text && needed < length && length - needed < disk_block && length % disk_block == 0;
}

// The first way of writing one of the headers that makes a file of this length.
std::optional<Header> find_fitting(const std::vector<Header>& headers, const Contents& contents,
                                   auto&& length_of) {
  for (const Header& header : headers)
    for (const Header& way : with_precisions(header))
      if (fits(length_of(way), contents.length, contents.text.has_value())) return way;
  return std::nullopt;
}

}  // namespace

std::string Plot3dLayout::description() const {
  std::string words;
  if (text)
    words = "text";
  else
    words = std::string("binary, ") + (little_endian ? "little-endian, " : "big-endian, ") +
            (double_precision ? "double, " : "float, ") + (record_marks ? "" : "no ") +
            "record marks";
  return words + (multi_block ? ", multi-block header" : ", single-block header");
}

Plot3dLayout plot3d_grid_layout(const std::filesystem::path& file) {
  const Contents contents(file);
  const auto headers = possible_headers(file, contents, 3);
  const auto length = [](const Header& header) { return grid_length(header, 3); };
  if (const auto found = find_fitting(headers, contents, length)) return found->layout;
  if (const auto flat = find_fitting(possible_headers(file, contents, 2), contents,
                                     [](const Header& header) { return grid_length(header, 2); }))
    throw Error(file.string() + ": a 2D Plot3D grid, " + size_of(flat->layout) +
                ", which has no volume cells; Plume needs a 3D grid");
  fail_by_length(file, headers, contents, "grid", length);
}

void check_plot3d_solution(const std::filesystem::path& file, const Plot3dLayout& grid) {
  check_readable(file);
  const Contents contents(file);
  auto headers = possible_headers(file, contents, 3);
  for (Header& header : headers) {
    header.layout.double_precision = grid.double_precision;
    if (!header.is_overflow || header.layout.description() != grid.description()) continue;
    check_dimensions(file, header.layout, grid);
    check_overflow(file, header);
    return;
  }
  const auto found = find_fitting(headers, contents, solution_length);
  if (!found) fail_by_length(file, headers, contents, "solution", solution_length);
  if (found->layout.description() != grid.description())
    throw Error(file.string() + ": is " + found->layout.description() + ", its grid is " +
                grid.description() + "; write both in the same way");
  check_dimensions(file, found->layout, grid);
}

}  // namespace plume
