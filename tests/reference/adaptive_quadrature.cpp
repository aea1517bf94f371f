#include "plume/tests/reference/adaptive_quadrature.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace plume::reference {

namespace {

/// The 15 nodes of Kronrod on [-1, 1], ascending; every second one is Gauss's. Source: QUADPACK,
/// routine qk15.
struct KronrodNode {
  double position;
  double kronrod_weight;
  double gauss_weight;
};

constexpr double outermost[8][3] = {
    {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
    {0.949107912342758524526189684047851, 0.063092092629978553290700663189204,
     0.129484966168869693270611432679082},
    {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
    {0.741531185599394439863864773280788, 0.140653259715525918745189590510238,
     0.279705391489276667901467771423780},
    {0.586087235467691130294144691693013, 0.169004726639267902826583426598550, 0},
    {0.405845151377397166906606412076961, 0.190350578064785409913256402421014,
     0.381830050505118944950369775488975},
    {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
    {0, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327},
};

std::array<KronrodNode, 15> make_kronrod_nodes() {
  std::array<KronrodNode, 15> nodes;
  for (std::size_t i = 0; i < 8; ++i) {
    nodes[i] = {-outermost[i][0], outermost[i][1], outermost[i][2]};
    nodes[14 - i] = {outermost[i][0], outermost[i][1], outermost[i][2]};
  }
  return nodes;
}

const std::array<KronrodNode, 15> kronrod_nodes = make_kronrod_nodes();

/// An integral and how far the two rules differ on it.
struct Estimate {
  double value = 0;
  double error = 0;
};

template <class F>
Estimate gauss_kronrod(const F& f, double low, double high) {
  const double middle = (low + high) / 2;
  const double half = (high - low) / 2;
  double kronrod = 0;
  double gauss = 0;
  for (const KronrodNode& node : kronrod_nodes) {
    const double value = f(middle + half * node.position);
    kronrod += node.kronrod_weight * value;
    gauss += node.gauss_weight * value;
  }
  return {kronrod * half, std::abs(kronrod - gauss) * half};
}

/// Deep enough for a panel of 1e-18 of the whole; there, an estimate is taken as it is.
constexpr int deepest = 60;

template <class F>
double adaptive(const F& f, double low, double high, double tolerance, int level = 0) {
  const Estimate estimate = gauss_kronrod(f, low, high);
  // Beyond some 1e-14 of the value, the difference of the rules is rounding.
  const double accepted = std::max(tolerance, 2e-14 * std::abs(estimate.value));
  if (estimate.error <= accepted || level == deepest) return estimate.value;
  const double middle = (low + high) / 2;
  return adaptive(f, low, middle, tolerance / 2, level + 1) +
         adaptive(f, middle, high, tolerance / 2, level + 1);
}

/// Front to back through one medium; `depth_` is the optical depth up to where it has come.
class Marcher {
 public:
  Marcher(const Medium& medium, double tolerance) : medium_(medium), tolerance_(tolerance) {}

  /// Adds the panel [low, high], which must hold no break point inside.
  void add(double low, double high, int level = 0) {
    if (++panel_count_ > 100'000) {
      throw std::runtime_error("adaptive quadrature does not converge: is a break point missing?");
    }
    const auto extinction = [this](double t) { return medium_.extinction(t); };
    // Behind this nothing is seen; only the optical depth goes on.
    if (depth_ > 60) {
      depth_ += adaptive(extinction, low, high, tolerance_ * depth_);
      return;
    }
    const double middle = (low + high) / 2;
    const double half = (high - low) / 2;
    std::array<double, 3> kronrod{0, 0, 0};
    std::array<double, 3> gauss{0, 0, 0};
    double largest_color = 1e-300;
    // Counted from the panel's start, or a thin panel would vanish next to depth_.
    double panel_depth = 0;
    double depth_error = 0;
    double t_before = low;
    for (const KronrodNode& node : kronrod_nodes) {
      const double t = middle + half * node.position;
      const Estimate step = gauss_kronrod(extinction, t_before, t);
      panel_depth += step.value;
      depth_error += step.error;
      t_before = t;
      const std::array<double, 3> color = medium_.color(t);
      const double source = extinction(t) * std::exp(-(depth_ + panel_depth)) * half;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        kronrod[channel] += node.kronrod_weight * source * color[channel];
        gauss[channel] += node.gauss_weight * source * color[channel];
        largest_color = std::max(largest_color, color[channel]);
      }
    }
    const Estimate last_step = gauss_kronrod(extinction, t_before, high);
    panel_depth += last_step.value;
    depth_error += last_step.error;
    double error = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      error = std::max(error, std::abs(kronrod[channel] - gauss[channel]) / largest_color);
    }
    // A panel much deeper than 1 could hide all it shows before its first node, so that both rules
    // agree on nothing.
    const bool fine = panel_depth <= 1 && error <= tolerance_ * std::max(panel_depth, 1e-3) &&
                      depth_error <= tolerance_ * std::max(panel_depth, 1e-300);
    if (!fine && level < deepest) {
      add(low, middle, level + 1);
      add(middle, high, level + 1);
      return;
    }
    for (std::size_t channel = 0; channel < 3; ++channel) rgb_[channel] += kronrod[channel];
    depth_ += panel_depth;
  }

  Radiance result() const { return {rgb_, -std::expm1(-depth_), depth_}; }

 private:
  const Medium& medium_;
  double tolerance_;
  std::array<double, 3> rgb_{0, 0, 0};
  double depth_ = 0;
  int panel_count_ = 0;
};

using Values = std::array<double, 4>;

Values weighted(const Values& first, double first_weight, const Values& second,
                double second_weight) {
  Values result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = first_weight * first[i] + second_weight * second[i];
  }
  return result;
}

Values values_of(const TransferFunction::Knot& knot) {
  const auto& [extinction, color] = knot.optics;
  return {extinction, color[0], color[1], color[2]};
}

/// Extinction, red, green and blue at `scalar`, by the linear function that holds at `inside`, a
/// scalar of the same piece (or beyond all knots).
Values optics_at(const TransferFunction& transfer_function, double scalar, double inside) {
  const auto& knots = transfer_function.knots;
  if (inside < knots.front().scalar) return values_of(knots.front());
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    if (!(inside < knots[i + 1].scalar)) continue;
    // Each weight from its own difference: 1 - weight would lose what is left of an extinction that
    // falls to zero.
    const double low = knots[i].scalar;
    const double high = knots[i + 1].scalar;
    return weighted(values_of(knots[i]), (high - scalar) / (high - low),  //
                    values_of(knots[i + 1]), (scalar - low) / (high - low));
  }
  return values_of(knots.back());
}

}  // namespace

Radiance integrate(const Medium& medium, double tolerance) {
  std::vector<double> ends{0};
  for (const double t : medium.break_points) {
    if (t > 0 && t < medium.length) ends.push_back(t);
  }
  ends.push_back(medium.length);
  std::sort(ends.begin(), ends.end());
  Marcher marcher(medium, tolerance);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i] < ends[i + 1]) marcher.add(ends[i], ends[i + 1]);
  }
  return marcher.result();
}

Radiance integrate_linear(const TransferFunction& transfer_function, double s_in, double s_out,
                          double length, double tolerance) {
  std::vector<double> scalars{s_in, s_out};
  for (const auto& knot : transfer_function.knots) {
    const double scalar = knot.scalar;
    if (scalar > std::min(s_in, s_out) && scalar < std::max(s_in, s_out)) {
      scalars.push_back(scalar);
    }
  }
  std::sort(scalars.begin(), scalars.end());
  if (s_out < s_in) std::reverse(scalars.begin(), scalars.end());
  Medium part;
  Marcher marcher(part, tolerance);
  for (std::size_t i = 0; i + 1 < scalars.size(); ++i) {
    // Each part has a t of its own, so that a short one at the end of the segment keeps its digits.
    part.length =
        s_in == s_out ? length : length * ((scalars[i + 1] - scalars[i]) / (s_out - s_in));
    if (part.length == 0) continue;
    const double inside = (scalars[i] + scalars[i + 1]) / 2;
    const Values front = optics_at(transfer_function, scalars[i], inside);
    const Values back = optics_at(transfer_function, scalars[i + 1], inside);
    const auto at = [=, part_length = part.length](double t) {
      return weighted(front, 1 - t / part_length, back, t / part_length);
    };
    part.extinction = [=](double t) { return at(t)[0]; };
    part.color = [=](double t) {
      const Values values = at(t);
      return std::array<double, 3>{values[1], values[2], values[3]};
    };
    marcher.add(0, part.length);
  }
  return marcher.result();
}

double integrate(const std::function<double(double)>& f, double low, double high,
                 double tolerance) {
  return adaptive(f, low, high, tolerance);
}

}  // namespace plume::reference
