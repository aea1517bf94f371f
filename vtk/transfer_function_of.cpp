#include "plume/vtk/transfer_function_of.h"

#include <vtkColorTransferFunction.h>
#include <vtkPiecewiseFunction.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plume/lib/srgb.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

/// Red, green, blue and opacity at a scalar.
using Shown = std::array<double, 4>;

// Half of what is promised: a kink may lie between the places that are looked at.
constexpr double kTolerance = 5e-4;

/// Adds where a function has points, and where it may bend in between.
template <std::size_t NodeSize, class Function>
void add_breaks(Function& function, const char* name, bool bends, std::vector<double>& breaks) {
  std::array<double, NodeSize> node{}, next{};
  const int size = function.GetSize();
  if (size == 0)
    throw Error(std::string("volume property: the ") + name + " function has no points; add two");
  for (int i = 0; i < size; ++i) {
    function.GetNodeValue(i, node.data());
    breaks.push_back(node[0]);
    if (i + 1 == size) continue;
    function.GetNodeValue(i + 1, next.data());
    const double midpoint = node[NodeSize - 2], sharpness = node[NodeSize - 1];
    if (!bends && midpoint == 0.5 && sharpness == 0) continue;
    breaks.push_back(node[0] + midpoint * (next[0] - node[0]));
  }
}

class Resampling {
 public:
  explicit Resampling(vtkVolumeProperty& property)
      : opacity_(*property.GetScalarOpacity(0)),
        unit_distance_(property.GetScalarOpacityUnitDistance(0)) {
    if (property.GetColorChannels(0) == 1)
      gray_ = property.GetGrayTransferFunction(0);
    else
      color_ = property.GetRGBTransferFunction(0);
    if (color_ != nullptr && color_->GetColorSpace() == VTK_CTF_LAB_CIEDE2000 &&
        color_->GetSize() > 1)
      fill_table();
    if (!(unit_distance_ > 0) || !std::isfinite(unit_distance_))
      throw Error("volume property: a scalar opacity unit distance of " +
                  std::to_string(unit_distance_) + "; it must be above 0");
  }

  TransferFunction result() {
    std::vector<double> breaks;
    add_breaks<4>(opacity_, "scalar opacity", false, breaks);
    if (gray_ != nullptr)
      add_breaks<4>(*gray_, "gray transfer", false, breaks);
    else
      add_breaks<6>(*color_, "RGB transfer", color_->GetColorSpace() != VTK_CTF_RGB, breaks);
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    for (const double x : breaks) most_opaque_ = std::max(most_opaque_, at(x)[3]);

    // What is beyond the ends: their values, or nothing where a function does not clamp.
    const double beyond = std::max(1.0, breaks.back() - breaks.front());
    add_knot(breaks.front(), at(breaks.front() - beyond));
    for (std::size_t i = 1; i < breaks.size(); ++i) {
      const double low = breaks[i - 1], high = breaks[i];
      const Shown first = limit(low, high), last = limit(high, low);
      add_knot(low, first);
      refine(low, first, high, last, 0);
      add_knot(high, last);
    }
    add_knot(breaks.back(), at(breaks.back() + beyond));
    return std::move(function_);
  }

 private:
  Shown at(double x) const {
    Shown shown{};
    if (gray_ != nullptr)
      shown[0] = shown[1] = shown[2] = gray_->GetValue(x);
    else if (table_.empty() || x < color_->GetRange()[0] || x > color_->GetRange()[1])
      color_->GetColor(x, shown.data());
    else
      look_up(x, shown);
    shown[3] = opacity_.GetValue(x);
    return shown;
  }

  // A colour of this space costs VTK a search for a path, 0.07 s, and a table of them no more.
  void fill_table() {
    table_.resize(3 * kTableSize);
    const double* const range = color_->GetRange();
    color_->GetTable(range[0], range[1], static_cast<int>(kTableSize), table_.data());
  }
  void look_up(double x, Shown& shown) const {
    const double* const range = color_->GetRange();
    const double place = (x - range[0]) / (range[1] - range[0]) * (kTableSize - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kTableSize - 2);
    const double t = place - static_cast<double>(below);
    for (std::size_t c = 0; c < 3; ++c)
      shown[c] = (1 - t) * table_[3 * below + c] + t * table_[3 * below + 3 + c];
  }

  /// What the functions tend to at `x` from the side of `other`: at a step, what stands at the
  /// point itself is one of the two sides.
  Shown limit(double x, double other) const {
    const Shown there = at(x), beside = at(x + 1e-6 * (other - x));
    for (std::size_t c = 0; c < 4; ++c)
      if (std::abs(there[c] - beside[c]) > 0.1 * tolerance(c)) return beside;
    return there;
  }

  double tolerance(std::size_t component) const {
    return component < 3 ? kTolerance : kTolerance * most_opaque_;
  }

  /// Adds knots between two, not themselves.
  void refine(double low, const Shown& first, double high, const Shown& last, int depth) {
    const double middle = low + 0.5 * (high - low);
    const auto as_float = static_cast<float>(middle);
    if (as_float == static_cast<float>(low) || as_float == static_cast<float>(high)) return;
    constexpr int deepest = 20;
    if (depth == deepest || is_linear(low, first, high, last)) return;
    const Shown between = at(middle);
    refine(low, first, middle, between, depth + 1);
    add_knot(middle, between);
    refine(middle, between, high, last, depth + 1);
  }

  bool is_linear(double low, const Shown& first, double high, const Shown& last) const {
    // Quarters as well as the half: a curve may cross its chord in the middle.
    for (const double t : {0.125, 0.25, 0.5, 0.75, 0.875}) {
      const Shown exact = at(low + t * (high - low));
      for (std::size_t c = 0; c < 4; ++c)
        if (std::abs((1 - t) * first[c] + t * last[c] - exact[c]) > tolerance(c)) return false;
    }
    return true;
  }

  void add_knot(double x, const Shown& shown) {
    TransferFunction::Knot knot;
    knot.scalar = static_cast<float>(x);
    for (std::size_t c = 0; c < 3; ++c) knot.optics.color[c] = static_cast<float>(shown[c]);
    knot.optics.extinction = static_cast<float>(shown[3] / unit_distance_);
    auto& knots = function_.knots;
    if (!knots.empty() && knots.back().scalar == knot.scalar) {
      if (knots.back() == knot) return;
      // Of several knots at one place, the first and the last make the step.
      if (knots.size() >= 2 && knots[knots.size() - 2].scalar == knot.scalar) knots.pop_back();
    }
    knots.push_back(knot);
  }

  vtkColorTransferFunction* color_ = nullptr;
  vtkPiecewiseFunction* gray_ = nullptr;
  vtkPiecewiseFunction& opacity_;
  static constexpr std::size_t kTableSize = 1024;
  std::vector<double> table_;
  double unit_distance_;
  double most_opaque_ = 0;
  TransferFunction function_;
};

}  // namespace

TransferFunction transfer_function_of(vtkVolumeProperty& property) {
  TransferFunction function = Resampling(property).result();
  if (const auto problem = function.problem()) throw Error("volume property: " + *problem);
  return function;
}

TransferFunction in_display_colors(TransferFunction function) {
  for (auto& knot : function.knots)
    for (float& channel : knot.optics.color) channel = static_cast<float>(linear_to_srgb(channel));
  return function;
}

}  // namespace plume
