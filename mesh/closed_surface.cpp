#include "plume/mesh/closed_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "plume/mesh/error.h"

namespace plume {
namespace {

struct EdgeUse {
  std::uint32_t low, high, triangle;
  auto operator<=>(const EdgeUse&) const = default;
};

using Face = std::array<std::int32_t, 3>;

Face sorted_face(std::int32_t a, std::int32_t b, std::int32_t c) {
  Face face{a, b, c};
  std::sort(face.begin(), face.end());
  return face;
}

}  // namespace

void check_closed(std::span<const double> points,
                  const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  const std::vector<std::uint32_t>& numbers) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), numbers[t]});
    }
  std::sort(uses.begin(), uses.end());
  constexpr std::size_t kExamples = 3;
  std::size_t open = 0;
  std::string examples;
  const auto place = [&](std::uint32_t point) {
    const double* const p = &points[3 * std::size_t{point}];
    return fmt::format("({}, {}, {})", p[0], p[1], p[2]);
  };
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high)
      ++end;
    if ((end - begin) % 2 == 0) continue;
    if (++open > kExamples) continue;
    examples += fmt::format("{} the edge {} {} of triangle", open > 1 ? "," : "",
                            place(uses[begin].low), place(uses[begin].high));
    for (std::size_t i = begin; i < end; ++i)
      examples += fmt::format("{} {}", i > begin ? "," : "", uses[i].triangle);
  }
  if (open == 0) return;
  throw Error(fmt::format(
      "the surface is not closed: {} edges have an odd number of triangles{}{}; close the surface",
      open, open > kExamples ? ", among them" : ":", examples));
}

std::vector<bool> enclosed(std::span<const std::int32_t> tetrahedra,
                           std::span<const std::int32_t> neighbors,
                           std::span<const std::int32_t> facets) {
  std::vector<Face> sheets;
  sheets.reserve(facets.size() / 3);
  for (std::size_t i = 0; i + 2 < facets.size(); i += 3)
    sheets.push_back(sorted_face(facets[i], facets[i + 1], facets[i + 2]));
  std::sort(sheets.begin(), sheets.end());

  enum : std::uint8_t { unknown, inside, outside };
  std::vector<std::uint8_t> state(tetrahedra.size() / 4, unknown);
  std::vector<std::size_t> next;  // whose neighbours are to be looked at
  for (std::size_t t = 0; t < state.size(); ++t)
    for (std::size_t i = 0; i < 4 && state[t] == unknown; ++i)
      if (neighbors[4 * t + i] < 0) {
        state[t] = inside;
        next.push_back(t);
      }
  while (!next.empty()) {
    const std::size_t t = next.back();
    next.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int32_t neighbor = neighbors[4 * t + i];
      if (neighbor < 0) continue;
      auto& beyond = state[static_cast<std::size_t>(neighbor)];
      if (beyond != unknown) continue;
      const Face face =
          sorted_face(tetrahedra[4 * t + (i + 1) % 4], tetrahedra[4 * t + (i + 2) % 4],
                      tetrahedra[4 * t + (i + 3) % 4]);
      const bool sheet = std::binary_search(sheets.begin(), sheets.end(), face);
      beyond = (state[t] == inside) != sheet ? inside : outside;
      next.push_back(static_cast<std::size_t>(neighbor));
    }
  }
  std::vector<bool> result;
  result.reserve(state.size());
  for (const std::uint8_t one : state) result.push_back(one == inside);
  return result;
}

}  // namespace plume
