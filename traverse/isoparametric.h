/// The inverse of the isoparametric maps: which parameters of a cell belong to a place in it.
///
/// Hexahedra, wedges and pyramids have VTK's shape functions, which on a face are those by which
/// faces are measured (measure.h): bilinear on quadrilaterals, linear on triangles. So the values
/// on the two sides of a face are the same.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "plume/mesh/local_frame.h"

namespace plume {

/// A place in the local frame of a mesh, or three parameters of a cell.
using Place = std::array<double, 3>;

/// How well a place is inverted: no parameter is off by more, where the map is regular.
inline constexpr double kParameterTolerance = 1e-6;
/// How far outside of a cell, in parameters, a place may be found: a ray that grazes a twisted face
/// sees the sliver behind it as part of the cell in front (grid_walker.h).
inline constexpr double kFarthestOutside = 0.25;

/// Position and scalar of a point, or a difference of some: x, y, z, scalar.
using PointValue = std::array<double, 4>;

inline PointValue point_value(const WalkablePoint& p) {
  return {p.position[0], p.position[1], p.position[2], p.scalar};
}
inline void add_multiple(PointValue& sum, double factor, const PointValue& value) {
  for (std::size_t a = 0; a < 4; ++a) sum[a] += factor * value[a];
}
inline PointValue operator-(PointValue a, const PointValue& b) {
  add_multiple(a, -1, b);
  return a;
}

/// What rounding of the corners' coordinates (at most 2^-25 each, in a mesh of size one) can make
/// of a map's twist where there is none: 2^-22, no more than a place on a ray may be off itself.
inline bool is_rounding(const PointValue& twist) {
  constexpr double kRounding = 0x1p-22;
  return std::abs(twist[0]) <= kRounding && std::abs(twist[1]) <= kRounding &&
         std::abs(twist[2]) <= kRounding;
}

/// Hexahedra and wedges: 1, r, s, t, rs, st, tr, rst, each times a vector.
class MultilinearMap {
 public:
  /// Corner a + 2b + 4c has the parameters (a, b, c).
  static MultilinearMap hexahedron(const std::array<WalkablePoint, 8>& corners) {
    MultilinearMap map;
    std::array<PointValue, 8> p;
    for (std::size_t i = 0; i < 8; ++i) p[i] = point_value(corners[i]);
    map.one_ = p[0];
    map.r_ = p[1] - p[0];
    map.s_ = p[2] - p[0];
    map.t_ = p[4] - p[0];
    map.rs_ = (p[3] - p[2]) - map.r_;
    map.st_ = (p[6] - p[4]) - map.s_;
    map.tr_ = (p[5] - p[1]) - map.t_;
    map.rst_ = ((p[7] - p[6]) - (p[5] - p[4])) - map.rs_;
    map.center_ = {0.5, 0.5, 0.5};
    return map;
  }

  /// VTK's order: the triangle t = 0, then that of t = 1; r leads to their second points, s to
  /// their third.
  static MultilinearMap wedge(const std::array<WalkablePoint, 6>& corners) {
    MultilinearMap map;
    std::array<PointValue, 6> p;
    for (std::size_t i = 0; i < 6; ++i) p[i] = point_value(corners[i]);
    map.one_ = p[0];
    map.r_ = p[1] - p[0];
    map.s_ = p[2] - p[0];
    map.t_ = p[3] - p[0];
    map.tr_ = (p[4] - p[3]) - map.r_;
    map.st_ = (p[5] - p[3]) - map.s_;
    map.center_ = {1.0 / 3, 1.0 / 3, 0.5};
    map.triangular_ = true;
    return map;
  }

  PointValue at(const Place& p) const {
    const auto [r, s, t] = p;
    PointValue value = one_;
    add_multiple(value, r, r_);
    add_multiple(value, s, s_);
    add_multiple(value, t, t_);
    add_multiple(value, r * s, rs_);
    add_multiple(value, s * t, st_);
    add_multiple(value, t * r, tr_);
    add_multiple(value, r * s * t, rst_);
    return value;
  }

  /// The derivatives by r, s and t.
  std::array<PointValue, 3> derivatives(const Place& p) const {
    const auto [r, s, t] = p;
    std::array<PointValue, 3> d{r_, s_, t_};
    add_multiple(d[0], s, rs_);
    add_multiple(d[0], t, tr_);
    add_multiple(d[0], s * t, rst_);
    add_multiple(d[1], r, rs_);
    add_multiple(d[1], t, st_);
    add_multiple(d[1], t * r, rst_);
    add_multiple(d[2], s, st_);
    add_multiple(d[2], r, tr_);
    add_multiple(d[2], r * s, rst_);
    return d;
  }

  /// A parallelepiped, or a wedge with parallel edges.
  bool is_affine() const {
    return is_rounding(rs_) && is_rounding(st_) && is_rounding(tr_) && is_rounding(rst_);
  }
  Place center() const { return center_; }
  /// How far inside of the cell: negative outside.
  double depth(const Place& p) const {
    const auto [r, s, t] = p;
    const double across = triangular_ ? 1 - r - s : std::fmin(1 - r, 1 - s);
    return std::fmin(std::fmin(std::fmin(r, s), across), std::fmin(t, 1 - t));
  }

 private:
  PointValue one_{}, r_{}, s_{}, t_{}, rs_{}, st_{}, tr_{}, rst_{};
  Place center_{};
  bool triangular_ = false;
};

/// A pyramid over a quadrilateral: (1 - t) times the bilinear patch at (r, s), plus t times the
/// apex. In a = (1 - t) r, b = (1 - t) s and w = 1 - t, the map over a parallelogram is linear up
/// to the apex, where r and s mean nothing; over others only a b / w is not.
class PyramidMap {
 public:
  PyramidMap(const std::array<PointValue, 4>& base, const PointValue& apex)
      : apex_(apex),
        w_(base[0] - apex),
        a_(base[1] - base[0]),
        b_(base[3] - base[0]),
        twist_((base[0] - base[1]) - (base[3] - base[2])) {}

  PointValue at(const Place& p) const {
    const auto [a, b, w] = p;
    PointValue value = apex_;
    add_multiple(value, w, w_);
    add_multiple(value, a, a_);
    add_multiple(value, b, b_);
    add_multiple(value, w == 0 ? 0 : a * b / w, twist_);
    return value;
  }

  std::array<PointValue, 3> derivatives(const Place& p) const {
    const auto [a, b, w] = p;
    std::array<PointValue, 3> d{a_, b_, w_};
    if (w == 0) return d;
    add_multiple(d[0], b / w, twist_);
    add_multiple(d[1], a / w, twist_);
    add_multiple(d[2], -a * b / (w * w), twist_);
    return d;
  }

  bool is_affine() const { return is_rounding(twist_); }
  Place center() const { return {0.375, 0.375, 0.75}; }
  double depth(const Place& p) const {
    const auto [a, b, w] = p;
    return std::fmin(std::fmin(std::fmin(a, b), std::fmin(w - a, w - b)), 1 - w);
  }

 private:
  PointValue apex_, w_, a_, b_, twist_;
};

/// The inverse of three derivatives in space, or nothing where they lie in a plane.
class InverseJacobian {
 public:
  explicit InverseJacobian(const std::array<PointValue, 3>& d) {
    auto cross = [](const PointValue& p, const PointValue& q) {
      return Place{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    };
    rows_ = {cross(d[1], d[2]), cross(d[2], d[0]), cross(d[0], d[1])};
    const double determinant =
        d[0][0] * rows_[0][0] + d[0][1] * rows_[0][1] + d[0][2] * rows_[0][2];
    const double inverse = 1 / determinant;
    regular_ = std::isfinite(inverse);
    for (Place& row : rows_)
      for (double& x : row) x *= inverse;
  }
  bool is_regular() const { return regular_; }
  /// Parameters that lead from `value` to `place`, as far as the derivatives hold.
  Place step(const PointValue& value, const Place& place) const {
    Place result;
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = rows_[i][0] * (place[0] - value[0]) + rows_[i][1] * (place[1] - value[1]) +
                  rows_[i][2] * (place[2] - value[2]);
    return result;
  }

 private:
  std::array<Place, 3> rows_;
  bool regular_;
};

inline double largest(const Place& p) {
  return std::fmax(std::abs(p[0]), std::fmax(std::abs(p[1]), std::abs(p[2])));
}

/// The parameters at which the map is at `place`. Affine maps are solved. For others Newton's
/// method, its steps halved until the next one would be shorter (the natural monotonicity test,
/// which no affine change of coordinates changes, so that flat cells are as good as any: Deuflhard,
/// "Newton Methods for Nonlinear Problems", 2004, chapter 3).
///
/// Ends where the correction that is left, with the last derivatives, is below kParameterTolerance.
/// Nothing where 20 steps do not get there, where a step would have to be below 1/64 of Newton's,
/// where the derivatives lie in a plane (collapsed cells), where anything is not finite, or where
/// the parameters are farther than kFarthestOutside from the cell.
template <class Map>
std::optional<Place> invert(const Map& map, const Place& place, const Place& start) {
  constexpr int kSteps = 20;
  constexpr double kShortest = 1.0 / 64;
  Place p = start;
  PointValue value = map.at(p);
  auto inside = [&](const Place& q) {
    return map.depth(q) >= -kFarthestOutside ? std::optional<Place>(q) : std::nullopt;
  };
  auto moved = [&p](double share, const Place& way) {
    return Place{p[0] + share * way[0], p[1] + share * way[1], p[2] + share * way[2]};
  };
  for (int i = 0; i < kSteps; ++i) {
    const InverseJacobian inverse(map.derivatives(p));
    if (!inverse.is_regular()) return std::nullopt;
    const Place way = inverse.step(value, place);
    if (map.is_affine()) return inside(moved(1, way));
    for (double share = 1;; share /= 2) {
      if (share < kShortest) return std::nullopt;
      const Place trial = moved(share, way);
      const PointValue there = map.at(trial);
      const Place left = inverse.step(there, place);
      // Not: larger, as nothing is larger than what is no number.
      if (!(largest(left) <= (1 - share / 4) * largest(way))) {
        if (largest(way) > kParameterTolerance) continue;
        return inside(p);  // as good as rounding lets it be
      }
      p = trial;
      value = there;
      if (largest(left) <= kParameterTolerance) return inside(moved(1, left));
      break;
    }
  }
  return std::nullopt;
}

}  // namespace plume
