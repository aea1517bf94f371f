#include "line_lengths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plume::reference {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

struct Point {
  Real x, y, t;  // across the line and along it
};

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real turn(const Point& a, const Point& b) { return a.x * b.y - b.x * a.y; }
Point mix(const Point& a, const Point& b, Real share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.t + share * (b.t - a.t)};
}

// An orthonormal, right-handed frame whose third axis is the line.
class Line {
 public:
  Line(const Point3& origin, const Point3& direction) {
    for (std::size_t a = 0; a < 3; ++a) {
      origin_[a] = origin[a];
      along_[a] = direction[a];
    }
    const auto least = static_cast<std::size_t>(
        std::min_element(along_.begin(), along_.end(),
                         [](Real a, Real b) { return std::abs(a) < std::abs(b); }) -
        along_.begin());
    Vector axis{0, 0, 0};
    axis[least] = 1;
    x_ = cross(axis, along_);
    const Real length = std::sqrt(dot(x_, x_));
    for (Real& c : x_) c /= length;
    y_ = cross(along_, x_);
  }

  Point operator()(const Point3& p) const {
    Vector from;
    for (std::size_t a = 0; a < 3; ++a) from[a] = p[a] - origin_[a];
    return {dot(from, x_), dot(from, y_), dot(from, along_)};
  }

  Point3 moved(Real by_x, Real by_y) const {
    Point3 p;
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = static_cast<double>(origin_[a] + by_x * x_[a] + by_y * y_[a]);
    return p;
  }

 private:
  Vector origin_, along_, x_, y_;
};

struct Crossings {
  Real sum = 0;  // of t, positive along the loop's normal, negative against it
  Real half_squares = 0;
  std::array<int, 2> count{0, 0};

  void add(Real t, bool along) {
    sum += along ? t : -t;
    half_squares += (along ? t : -t) * t / 2;
    ++count[along ? 0 : 1];
  }
};

void cross_triangle(const Point& a, const Point& b, const Point& c, Crossings& found) {
  const Real ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
  const bool along = ab > 0 && bc > 0 && ca > 0, against = ab < 0 && bc < 0 && ca < 0;
  if (along || against) found.add((bc * a.t + ca * b.t + ab * c.t) / (ab + bc + ca), along);
}

void cross_patch(const std::array<Point, 4>& p, Crossings& found) {
  for (const auto& side : {&Point::x, &Point::y}) {
    auto positive = [&](const Point& q) { return q.*side > 0; };
    if (std::all_of(p.begin(), p.end(), positive) || std::none_of(p.begin(), p.end(), positive))
      return;
  }
  // The line of constant v passes through the ray where this is 0.
  auto miss = [&](Real v) { return turn(mix(p[0], p[3], v), mix(p[1], p[2], v)); };
  const Real at_0 = miss(0), at_half = miss(0.5L), at_1 = miss(1);
  const Real bend = 2 * (at_0 - 2 * at_half + at_1), slope = at_1 - at_0 - bend;
  Real extremum = bend == 0 ? 1 : -slope / (2 * bend);
  if (!(extremum > 0 && extremum < 1)) extremum = 1;
  for (const auto& [from, to] : {std::pair<Real, Real>{0, extremum}, {extremum, 1}}) {
    Real low = from, high = to;
    if ((miss(low) > 0) == (miss(high) > 0)) continue;
    const bool falls = miss(low) > 0;
    for (int i = 0; i < 70; ++i) {
      const Real middle = (low + high) / 2;
      ((miss(middle) > 0) == falls ? low : high) = middle;
    }
    const Point left = mix(p[0], p[3], low), right = mix(p[1], p[2], low);
    const Real x = right.x - left.x, y = right.y - left.y;
    const Real u = -(left.x * x + left.y * y) / (x * x + y * y);
    if (!(u >= 0 && u <= 1)) continue;
    // d/du x d/dv, as the line turns while v grows.
    const Point up{mix(p[3], p[2], u).x - mix(p[0], p[1], u).x,
                   mix(p[3], p[2], u).y - mix(p[0], p[1], u).y, 0};
    found.add(mix(left, right, u).t, x * up.y - up.x * y > 0);
  }
}

}  // namespace

LineLengths line_lengths(const std::vector<CellLoops>& cells, const Point3& origin,
                         const Point3& direction) {
  const Line line(origin, direction);
  LineLengths result;
  result.length.reserve(cells.size());
  result.moment.reserve(cells.size());
  std::vector<Point> p;
  for (const CellLoops& cell : cells) {
    Real sum = 0, half_squares = 0;
    for (const auto& loop : cell) {
      p.clear();
      for (const Point3& corner : loop) p.push_back(line(corner));
      Crossings found;
      if (p.size() == 3) {
        cross_triangle(p[0], p[1], p[2], found);
      } else if (p.size() == 4) {
        cross_patch({p[0], p[1], p[2], p[3]}, found);
        if (found.count[0] + found.count[1] == 2) ++result.grazes;
      } else {
        Point center{0, 0, 0};
        for (const Point& q : p) {
          center.x += q.x / static_cast<Real>(p.size());
          center.y += q.y / static_cast<Real>(p.size());
          center.t += q.t / static_cast<Real>(p.size());
        }
        for (std::size_t i = 0; i < p.size(); ++i)
          cross_triangle(center, p[i], p[(i + 1) % p.size()], found);
      }
      sum += found.sum;
      half_squares += found.half_squares;
    }
    result.length.push_back(static_cast<double>(std::abs(sum)));
    result.moment.push_back(static_cast<double>(sum < 0 ? -half_squares : half_squares));
  }
  return result;
}

LengthRange line_length_range(const std::vector<CellLoops>& cells, const Point3& origin,
                              const Point3& direction, double distance) {
  LineLengths seen = line_lengths(cells, origin, direction);
  LengthRange range{seen.length, seen.length, seen.grazes};
  const Line line(origin, direction);
  for (const auto& [x, y] : {std::pair<Real, Real>{1, 0},
                             {0, 1},
                             {-1, 0},
                             {0, -1},
                             {0.7L, 0.7L},
                             {-0.7L, 0.7L},
                             {-0.7L, -0.7L},
                             {0.7L, -0.7L}}) {
    const LineLengths moved =
        line_lengths(cells, line.moved(distance * x, distance * y), direction);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      range.low[c] = std::min(range.low[c], moved.length[c]);
      range.high[c] = std::max(range.high[c], moved.length[c]);
    }
  }
  return range;
}

std::array<int, 2> patch_crossings(const std::array<Point3, 4>& loop, const Point3& origin,
                                   const Point3& direction) {
  const Line line(origin, direction);
  Crossings found;
  cross_patch({line(loop[0]), line(loop[1]), line(loop[2]), line(loop[3])}, found);
  return found.count;
}

}  // namespace plume::reference
