// TetGen, in a process of its own: Debian's library (1.5.0) throws where TetGen would exit, but
// aborts on points in a plane, crashes on points in a line and after finding that a surface
// intersects itself, and keeps its predicates' bounds in globals. This file alone includes its
// header.
#define TETLIBRARY
#include <fmt/format.h>
#include <tetgen.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "plume/mesh/error.h"
#include "plume/mesh/separate_process.h"
#include "plume/mesh/tetrahedralization_engines.h"

namespace plume {
namespace {

// Corners are numbered in an int, four a tetrahedron, and there are some seven a point.
constexpr std::size_t kMostPoints = 75'000'000;
constexpr int kOutOfMemory = 1;
constexpr std::size_t kExamples = 5;

struct Header {
  std::int64_t thrown = 0;  // what TetGen threw, 0 for nothing
  std::int64_t points = 0, tetrahedra = 0, neighbors = 0, facets = 0, markers = 0;
};

struct Output {
  Header header;
  Array points, tetrahedra, neighbors, facets, markers;
};

struct Input {
  std::span<const double> points;
  const std::vector<std::array<std::uint32_t, 3>>* triangles = nullptr;
  const std::vector<std::uint32_t>* numbers = nullptr;  // of the triangles, in messages
};

void fill_input(const Input& input, tetgenio& io) {
  io.numberofpoints = static_cast<int>(input.points.size() / 3);
  io.pointlist = new double[input.points.size()];
  std::copy(input.points.begin(), input.points.end(), io.pointlist);
  if (!input.triangles) return;
  const std::size_t count = input.triangles->size();
  io.numberoffacets = static_cast<int>(count);
  io.facetlist = new tetgenio::facet[count];
  io.facetmarkerlist = new int[count];
  for (std::size_t i = 0; i < count; ++i) {
    tetgenio::facet& facet = io.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (std::size_t c = 0; c < 3; ++c)
      facet.polygonlist[0].vertexlist[c] = static_cast<int>((*input.triangles)[i][c]);
    io.facetmarkerlist[i] = static_cast<int>(i) + 1;  // 0 means none
  }
}

template <class T>
void write(ResultFile& file, const T* values, std::int64_t count) {
  if (count > 0) file.write(std::as_bytes(std::span(values, static_cast<std::size_t>(count))));
}

// In the other process, which ends after it: nothing is freed, for that is one more thing to fail.
void work(const Input& input, std::string switches, ResultFile& file) {
  auto& in = *new tetgenio;
  auto& out = *new tetgenio;
  Header header;
  try {
    fill_input(input, in);
    ::tetrahedralize(switches.data(), &in, &out);
  } catch (const int thrown) {
    header.thrown = thrown;
  } catch (const std::bad_alloc&) {
    header.thrown = kOutOfMemory;
  }
  if (header.thrown == 0) {
    header.points = 3 * std::int64_t{out.numberofpoints};
    header.tetrahedra = 4 * std::int64_t{out.numberoftetrahedra};
    header.neighbors = out.neighborlist ? header.tetrahedra : 0;
    header.facets = 3 * std::int64_t{out.numberoftrifaces};
    header.markers = out.trifacemarkerlist ? out.numberoftrifaces : 0;
  }
  write(file, &header, 1);
  write(file, out.pointlist, header.points);
  write(file, out.tetrahedronlist, header.tetrahedra);
  write(file, out.neighborlist, header.neighbors);
  write(file, out.trifacelist, header.facets);
  write(file, out.trifacemarkerlist, header.markers);
}

template <class T>
Array take(const SeparateRun& run, std::int64_t count, std::size_t& at) {
  const auto size = static_cast<std::size_t>(count);
  const std::span<const T> values(reinterpret_cast<const T*>(run.result.data() + at), size);
  at += size * sizeof(T);
  return Array::borrow(values, run.keep_alive);
}

std::string meaning_of(std::int64_t thrown) {
  switch (thrown) {
    case kOutOfMemory:
      return "out of memory";
    case 2:
      return "an error of its own";
    case 3:
      return "the surface intersects itself";
    case 4:
      return "a very small feature of the surface";
    case 5:
      return "two triangles of the surface nearly coincide";
    case 10:
      return "it refuses the points";
    default:
      return fmt::format("its error {}", thrown);
  }
}

// What TetGen has printed, in one line of no great length.
std::string words_of(const std::string& said) {
  std::string line;
  for (const char c : said) {
    const bool space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (!space)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  constexpr std::size_t kLongest = 300;
  if (line.size() > kLongest) line = "..." + line.substr(line.size() - kLongest);
  return line.empty() ? "" : fmt::format(" (its words: {})", line);
}

// Runs TetGen; gives how it failed, empty where it did not.
std::string run(const Input& input, const std::string& switches, Output& output) {
  const SeparateRun other = run_separately([&](ResultFile& file) { work(input, switches, file); });
  if (!other.failure.empty()) return other.failure + words_of(other.said);
  std::memcpy(&output.header, other.result.data(), sizeof output.header);
  const Header& header = output.header;
  if (header.thrown != 0) return meaning_of(header.thrown) + words_of(other.said);
  std::size_t at = sizeof header;
  output.points = take<double>(other, header.points, at);
  output.tetrahedra = take<std::int32_t>(other, header.tetrahedra, at);
  output.neighbors = take<std::int32_t>(other, header.neighbors, at);
  output.facets = take<std::int32_t>(other, header.facets, at);
  output.markers = take<std::int32_t>(other, header.markers, at);
  return {};
}

void check_count(std::size_t count, const char* what) {
  if (count > kMostPoints)
    throw Error(fmt::format("{} {} are more than TetGen can number ({}); use CGAL, or fewer", count,
                            what, kMostPoints));
}

// "triangle 3 (0, 0, 0) (1, 0, 0) (0, 1, 0)" of the first few.
std::string describe_triangles(const Input& input, const std::vector<std::int32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), kExamples); ++i) {
    const auto number = static_cast<std::size_t>(numbers[i]);
    text += fmt::format("{}triangle {}", i > 0 ? ", " : "", (*input.numbers)[number]);
    for (const std::uint32_t corner : (*input.triangles)[number]) {
      const double* const p = &input.points[3 * std::size_t{corner}];
      text += fmt::format(" ({}, {}, {})", p[0], p[1], p[2]);
    }
  }
  return text;
}

// TetGen's -d finds triangles that intersect, and fails less often than meshing them does.
[[noreturn]] void fail_to_fill(const Input& input, const std::string& failure) {
  Output found;
  std::vector<std::int32_t> numbers;
  if (run(input, "pdQ", found).empty())
    found.markers.visit([&](auto markers) {
      for (const auto marker : markers)
        if (marker > 0) numbers.push_back(static_cast<std::int32_t>(marker) - 1);
    });
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  if (numbers.empty())
    throw Error(fmt::format("TetGen cannot fill the surface: {}; repair the surface", failure));
  throw Error(fmt::format(
      "the surface intersects itself, or touches itself elsewhere than in common edges and points: "
      "{} triangles do{} {}; repair the surface",
      numbers.size(), numbers.size() > kExamples ? ", among them" : ":",
      describe_triangles(input, numbers)));
}

std::string switches_for(const SurfaceMeshing& meshing) {
  std::string switches = "pnQ";
  if (meshing.radius_edge_ratio > 0)
    switches += fmt::format("q{:.6f}/{:.6f}", meshing.radius_edge_ratio, meshing.dihedral_angle);
  if (meshing.volume > 0) switches += fmt::format("a{:.17g}", meshing.volume);
  return switches + fmt::format("S{}", meshing.added_points);
}

}  // namespace

bool has_tetgen() { return true; }

Array tetgen_delaunay(std::span<const double> points) {
  check_count(points.size() / 3, "points");
  Output output;
  // Neither points nor faces are asked for: they keep their numbers.
  const std::string failure = run({points}, "QNF", output);
  if (!failure.empty()) throw Error("TetGen: " + failure);
  return output.tetrahedra;
}

TetgenMesh tetgen_fill(std::span<const double> points,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       const std::vector<std::uint32_t>& numbers, const SurfaceMeshing& meshing) {
  check_count(points.size() / 3, "points");
  check_count(triangles.size(), "triangles");
  const Input input{points, &triangles, &numbers};
  Output output;
  const std::string failure = run(input, switches_for(meshing), output);
  if (!failure.empty()) fail_to_fill(input, failure);
  if (output.tetrahedra.empty()) fail_to_fill(input, "no tetrahedra came of it");
  return {output.points, output.tetrahedra, output.neighbors, output.facets};
}

}  // namespace plume
