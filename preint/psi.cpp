#include "plume/preint/psi.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace plume {

namespace {

/// A node in (0, 1), which stands for -node as well, and its weight; the rule is for [-1, 1].
struct Node {
  double position;
  double weight;
};

constexpr std::array<Node, 8> sixteen_nodes{{
    {0.0950125098376374402, 0.1894506104550684963},
    {0.2816035507792589132, 0.1826034150449235889},
    {0.4580167776572273863, 0.1691565193950025382},
    {0.6178762444026437484, 0.1495959888165767321},
    {0.7554044083550030339, 0.1246289712555338721},
    {0.8656312023878317439, 0.0951585116824927848},
    {0.9445750230732325761, 0.0622535239386478929},
    {0.9894009349916499326, 0.0271524594117540949},
}};

template <class F>
double integral(double low, double high, const F& f) {
  const double middle = (low + high) / 2, half = (high - low) / 2;
  double sum = 0;
  for (const Node& node : sixteen_nodes)
    sum += node.weight * (f(middle - half * node.position) + f(middle + half * node.position));
  return half * sum;
}

/// A polynomial in t, which runs from -1 to 1 over its range.
template <std::size_t degree>
using Polynomial = std::array<double, degree + 1>;

/// By Horner's rule. The sum is taken in ascending order so that the compiler unrolls it.
template <std::size_t size>
double value(const std::array<double, size>& coefficients, double t) {
  double sum = coefficients[size - 1];
  for (std::size_t i = size - 1; i-- > 0;) sum = sum * t + coefficients[i];
  return sum;
}

/// Interpolates f(t) on [-1, 1] at the Chebyshev nodes: within a factor of two or three of the best
/// polynomial of that degree.
template <std::size_t degree, class F>
Polynomial<degree> fitted(const F& f) {
  constexpr std::size_t count = degree + 1;
  const double pi = std::acos(-1.0);
  std::array<double, count> nodes, differences;
  for (std::size_t i = 0; i < count; ++i) {
    nodes[i] = std::cos(pi * (static_cast<double>(i) + 0.5) / count);
    differences[i] = f(nodes[i]);
  }
  for (std::size_t order = 1; order < count; ++order)
    for (std::size_t i = count; i-- > order;)
      differences[i] = (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order]);
  // From Newton's form to powers of t.
  Polynomial<degree> result{};
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t power = count; power-- > 1;)
      result[power] = result[power - 1] - nodes[i] * result[power];
    result[0] = differences[i] - nodes[i] * result[0];
  }
  return result;
}

/// The greatest optical depth that takes the power series in d.
constexpr double series_reach = 0.25;

/// (s + x / 2) g(x, d) over y, for one sign of d. With u = v / (s + x / 2) it is the integral of
///     exp(-2 (1 - y) v -+ (y v)^2),
/// where extinction grows, over all v >= 0; where it falls, up to (1 - y) / y^2, where there is no
/// extinction left.
class ScaledTail {
 public:
  explicit ScaledTail(bool grows) {
    for (std::size_t i = 0; i < count; ++i)
      pieces_[i] = fitted<5>(
          [&](double t) { return exact((static_cast<double>(i) + (t + 1) / 2) / count, grows); });
  }

  double operator()(double y) const {
    const double place = y * count;
    const std::size_t i = std::min(static_cast<std::size_t>(place), count - 1);
    return value(pieces_[i], 2 * (place - static_cast<double>(i)) - 1);
  }

 private:
  static double exact(double y, bool grows) {
    constexpr double invisible = 40;  // exp(-40) is 4e-18
    constexpr int panels = 64;
    const double rate = 2 * (1 - y), square = grows ? y * y : -y * y;
    const double end = grows ? std::sqrt(invisible) / std::max(y, std::sqrt(1 / invisible))
                             : std::min((1 - y) / (y * y), 2 * invisible);
    double sum = 0;
    for (int i = 0; i < panels; ++i)
      sum += integral(end * i / panels, end * (i + 1) / panels,
                      [&](double v) { return std::exp(-v * (rate + square * v)); });
    return sum;
  }

  static constexpr std::size_t count = 64;
  std::array<Polynomial<5>, count> pieces_;
};

struct Fits {
  ScaledTail growing{true}, falling{false};
  /// Over m in [0, series_reach]: the mean transparency of uniform extinction, and the coefficients
  /// of chi = m x0 + d x1 + d^2 x2 + ...; transparency so far is exp(-m u) exp(d u (1 - u)).
  Polynomial<6> mean = fitted<6>([](double t) { return moment(t, 0, 0, 1); });
  Polynomial<5> x0 = fitted<5>([](double t) { return moment(t, 1, 0, 1); });
  Polynomial<4> x1 = fitted<4>([](double t) { return moment(t, 1, 1, 1); });
  Polynomial<3> x2 = fitted<3>([](double t) { return moment(t, 2, 2, 2); });
  Polynomial<2> x3 = fitted<2>([](double t) { return moment(t, 3, 3, 6); });
  Polynomial<1> x4 = fitted<1>([](double t) { return moment(t, 4, 4, 24); });
  Polynomial<0> x5 = fitted<0>([](double t) { return moment(t, 5, 5, 120); });

 private:
  static double moment(double t, int power, int power_of_rest, double divisor) {
    const double m = (t + 1) / 2 * series_reach;
    return integral(0, 1,
                    [&](double u) {
                      return std::pow(u, power) * std::pow(1 - u, power_of_rest) * std::exp(-m * u);
                    }) /
           divisor;
  }
};

const Fits& fits() {
  static const Fits made;
  return made;
}

/// Where m lies in the range of the power series.
double series_place(double m) { return m * (2 / series_reach) - 1; }

}  // namespace

double absorbed(double depth) {
  if (depth <= series_reach) return depth * value(fits().mean, series_place(depth));
  return 1 - std::exp(-depth);
}

Absorption absorption(double a, double b) {
  assert(a >= 0 && b >= 0);
  const Fits& fit = fits();
  const double m = (a + b) / 2, d = (b - a) / 2;
  if (m <= series_reach) {
    const double t = series_place(m);
    const double square = d * d;
    const double low = value(fit.x1, t) + d * value(fit.x2, t);
    const double middle = value(fit.x3, t) + d * value(fit.x4, t);
    const double chi = m * value(fit.x0, t) + d * (low + square * (middle + square * fit.x5[0]));
    return {m * value(fit.mean, t), chi};
  }
  const ScaledTail& tail = d >= 0 ? fit.growing : fit.falling;
  const double s = std::sqrt(std::abs(d));
  const double transparency = std::exp(-m);
  const double front = 1 / (s + a / 2), back = 1 / (s + b / 2);
  const double seen = front * tail(s * front), behind = back * tail(s * back);
  return {1 - transparency, std::max(0.0, seen - transparency * (1 + behind))};
}

double chi(double a, double b) { return absorption(a, b).chi; }

double psi(double a, double b) {
  const Absorption both = absorption(a, b);
  return 1 - both.absorbed + both.chi;
}

}  // namespace plume
