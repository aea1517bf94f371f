#include "plume/preint/piece_table.h"

#include <algorithm>
#include <limits>

namespace plume {
namespace {

constexpr std::size_t kLanes = 16;

void pad(std::vector<float>& values) {
  values.resize((values.size() + kLanes - 1) / kLanes * kLanes, values.back());
}

}  // namespace

PieceTable::PieceTable(const TransferFunction& transfer_function) {
  const auto& knots = transfer_function.knots;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  auto add = [this](float from, const Optics& front, float width, const Optics& back, float start) {
    // The slope in double: knots may lie far apart or close together.
    auto slope = [width](float a, float b) {
      const double value = width > 0 ? (static_cast<double>(b) - a) / width : 0;
      return static_cast<float>(std::clamp<double>(value, -std::numeric_limits<float>::max(),
                                                   std::numeric_limits<float>::max()));
    };
    low.push_back(from);
    base.push_back(start);
    extinction.push_back(front.extinction);
    extinction_slope.push_back(slope(front.extinction, back.extinction));
    for (std::size_t c = 0; c < 3; ++c) {
      color[c].push_back(front.color[c]);
      color_slope[c].push_back(slope(front.color[c], back.color[c]));
    }
    ++pieces;
  };
  add(-kInfinity, knots.front().optics, 0, knots.front().optics, knots.front().scalar);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    add(knots[i].scalar, knots[i].optics, knots[i + 1].scalar - knots[i].scalar,
        knots[i + 1].optics, knots[i].scalar);
  add(knots.back().scalar, knots.back().optics, 0, knots.back().optics, knots.back().scalar);
  low.push_back(kInfinity);
  pad(low);
  for (auto* values : {&base, &extinction, &extinction_slope, &color[0], &color[1], &color[2],
                       &color_slope[0], &color_slope[1], &color_slope[2]})
    pad(*values);
}

std::size_t PieceTable::piece_at(float scalar) const {
  const auto first = low.begin() + 1;
  const auto above = std::upper_bound(first, first + static_cast<std::ptrdiff_t>(pieces) - 1, scalar);
  return static_cast<std::size_t>(above - first);
}

}  // namespace plume
