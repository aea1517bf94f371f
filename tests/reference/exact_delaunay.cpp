#include "exact_delaunay.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace plume::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Rational = CGAL::Gmpq;
using Interval = CGAL::Interval_nt<false>;
using Point = ExactDelaunay::Point;
using Segment = ExactDelaunay::Segment;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> vector_to(const Point& from, const Point& to) {
  return {Number(to[0]) - Number(from[0]), Number(to[1]) - Number(from[1]),
          Number(to[2]) - Number(from[2])};
}
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Inside is where dot(normal, p) <= offset.
template <class Number>
struct HalfSpace {
  Vector<Number> normal;
  Number offset;
};

// Behind the triangle a, b, c, which is seen counterclockwise from outside.
template <class Number>
HalfSpace<Number> behind(const Point& a, const Point& b, const Point& c) {
  const Vector<Number> normal = cross(vector_to<Number>(a, b), vector_to<Number>(a, c));
  return {normal, dot(normal, Vector<Number>{Number(a[0]), Number(a[1]), Number(a[2])})};
}

// The same with a normal of length one.
HalfSpace<double> unit(HalfSpace<double> side) {
  const double length = std::sqrt(dot(side.normal, side.normal));
  for (double& x : side.normal) x /= length;
  side.offset /= length;
  return side;
}

// Of a point above the plane, in lengths of the normal.
template <class Number>
Number height(const HalfSpace<Number>& side, const Point& p) {
  return dot(side.normal, Vector<Number>{Number(p[0]), Number(p[1]), Number(p[2])}) - side.offset;
}

// The part of a segment, from + t * (to - from) for t in [0, 1], that half-spaces leave over;
// nothing where low > high.
template <class Number>
struct Span {
  Number low{0}, high{1};

  void clip(const HalfSpace<Number>& side, const Segment& segment) {
    const Number above = height(side, segment.from);
    const Number slope = dot(side.normal, vector_to<Number>(segment.from, segment.to));
    if (slope > 0) {
      high = std::min<Number>(high, -above / slope);
    } else if (slope < 0) {
      low = std::max<Number>(low, -above / slope);
    } else if (above > 0) {
      low = Number(2);
      high = Number(-1);
    }
  }
};

double rounded_root(const Rational& square) {
  mpfr_t root;
  mpfr_init2(root, 256);
  mpfr_set_q(root, square.mpq(), MPFR_RNDN);
  mpfr_sqrt(root, root, MPFR_RNDN);
  const double rounded = mpfr_get_d(root, MPFR_RNDN);
  mpfr_clear(root);
  return rounded;
}

// Between the line through p along a direction of length one, and the edge from a to b.
double distance(const Point& p, const Vector<double>& along, const Point& a, const Point& b) {
  auto across = [&](const Point& q) {  // from the line to q
    Vector<double> v = vector_to<double>(p, q);
    const double t = dot(v, along);
    for (std::size_t i = 0; i < 3; ++i) v[i] -= t * along[i];
    return v;
  };
  Vector<double> nearest = across(a);
  const Vector<double> edge = vector_to<double>(nearest, across(b));
  const double length2 = dot(edge, edge);
  const double t = length2 > 0 ? std::clamp(-dot(nearest, edge) / length2, 0.0, 1.0) : 0.0;
  for (std::size_t i = 0; i < 3; ++i) nearest[i] += t * edge[i];
  return std::sqrt(dot(nearest, nearest));
}

// The faces of a positively oriented tetrahedron, counterclockwise from outside.
constexpr std::size_t kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

std::array<HalfSpace<double>, 4> sides(const std::vector<Point>& points,
                                       const std::array<std::uint32_t, 4>& tetrahedron) {
  std::array<HalfSpace<double>, 4> four;
  for (std::size_t f = 0; f < 4; ++f)
    four[f] =
        unit(behind<double>(points[tetrahedron[kFaces[f][0]]], points[tetrahedron[kFaces[f][1]]],
                            points[tetrahedron[kFaces[f][2]]]));
  return four;
}

Kernel::Point_3 to_cgal(const Point& p) { return {p[0], p[1], p[2]}; }

}  // namespace

struct ExactDelaunay::Implementation {
  // One plane of the hull, which may hold many of its faces.
  struct HullPlane {
    HalfSpace<Rational> exact;
    HalfSpace<Interval> enclosing;  // the same numbers, to tell quickly which planes matter
    HalfSpace<double> rounded;      // with a normal of length one
  };

  void find_hull(const std::vector<Point>& points);

  Triangulation triangulation;
  std::vector<HullPlane> hull_planes;
  std::vector<std::array<std::uint32_t, 2>> hull_edges;
};

void ExactDelaunay::Implementation::find_hull(const std::vector<Point>& points) {
  std::set<std::array<Rational, 4>> planes;
  std::set<std::array<std::uint32_t, 2>> edges;
  for (auto outside : triangulation.all_cell_handles()) {
    int infinite = 0;
    if (!outside->has_vertex(triangulation.infinite_vertex(), infinite)) continue;
    // The face is that of a cell inside, where faces are known to be seen from outside.
    const auto inside = outside->neighbor(infinite);
    const auto& corners = kFaces[inside->index(outside)];
    std::array<std::uint32_t, 3> face;
    for (std::size_t i = 0; i < 3; ++i)
      face[i] = inside->vertex(static_cast<int>(corners[i]))->info();
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert({std::min(face[i], face[(i + 1) % 3]), std::max(face[i], face[(i + 1) % 3])});
    const Point &a = points[face[0]], &b = points[face[1]], &c = points[face[2]];
    const HalfSpace<Rational> exact = behind<Rational>(a, b, c);
    const auto& n = exact.normal;
    const Rational size = CGAL::abs(n[0]) + CGAL::abs(n[1]) + CGAL::abs(n[2]);
    if (!planes.insert({n[0] / size, n[1] / size, n[2] / size, exact.offset / size}).second)
      continue;
    hull_planes.push_back({exact, {}, unit(behind<double>(a, b, c))});
    const CGAL::Protect_FPU_rounding<true> upwards;
    hull_planes.back().enclosing = behind<Interval>(a, b, c);
  }
  hull_edges.assign(edges.begin(), edges.end());
}

ExactDelaunay::ExactDelaunay(const std::vector<Point>& points)
    : points_(points), implementation_(std::make_unique<Implementation>()) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
  for (const Point& p : points) {
    if (!std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); }))
      throw std::invalid_argument("a point is not finite");
    numbered.emplace_back(to_cgal(p), static_cast<std::uint32_t>(numbered.size()));
  }
  Triangulation& triangulation = implementation_->triangulation;
  triangulation.insert(numbered.begin(), numbered.end());
  if (triangulation.number_of_vertices() != points.size() || triangulation.dimension() != 3)
    throw std::invalid_argument("points coincide, or are all in one plane");
  for (auto cell : triangulation.finite_cell_handles()) {
    cell->info() = static_cast<std::uint32_t>(tetrahedra_.size());
    tetrahedra_.push_back({cell->vertex(0)->info(), cell->vertex(1)->info(),
                           cell->vertex(2)->info(), cell->vertex(3)->info()});
  }
  implementation_->find_hull(points);
}

ExactDelaunay::~ExactDelaunay() = default;
ExactDelaunay::ExactDelaunay(ExactDelaunay&&) noexcept = default;
ExactDelaunay& ExactDelaunay::operator=(ExactDelaunay&&) noexcept = default;

std::vector<std::uint32_t> ExactDelaunay::cells_along(const Segment& segment) const {
  const Triangulation& triangulation = implementation_->triangulation;
  std::vector<std::uint32_t> cells;
  std::size_t steps = 0;
  auto at = triangulation.segment_traverser_cells_begin(to_cgal(segment.from), to_cgal(segment.to));
  while (at.has_next()) {
    // Having come to an edge or a vertex, the iterator is at a cell that the segment may only touch
    // there, and its step goes around to the one that it passes through, and on (CGAL 5.5.1). The
    // latter is then the previous one. Elsewhere that is just the cell that it was at.
    ++at;
    const auto passed = at.previous();
    if (!triangulation.is_infinite(passed)) cells.push_back(passed->info());
    if (++steps > 64 * triangulation.number_of_cells())
      throw std::runtime_error("CGAL's segment traverser does not end");
  }
  return cells;
}

double ExactDelaunay::length_in_hull(const Segment& segment) const {
  // Few planes can be the ones that cut the segment first and last; only these are computed with.
  const auto& planes = implementation_->hull_planes;
  std::vector<Interval> cuts(planes.size(), Interval(-kInfinity, kInfinity));
  std::vector<int> directions(planes.size(), 0);  // 0: not known
  double low = -kInfinity, high = kInfinity;
  {
    const CGAL::Protect_FPU_rounding<true> upwards;
    const Vector<Interval> along = vector_to<Interval>(segment.from, segment.to);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Interval slope = dot(planes[i].enclosing.normal, along);
      if (slope.inf() <= 0 && slope.sup() >= 0) continue;
      cuts[i] = -height(planes[i].enclosing, segment.from) / slope;
      directions[i] = slope.inf() > 0 ? 1 : -1;
      if (directions[i] > 0)
        high = std::min(high, cuts[i].sup());
      else
        low = std::max(low, cuts[i].inf());
    }
  }
  Span<Rational> span;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (directions[i] > 0 && cuts[i].inf() > high) continue;
    if (directions[i] < 0 && cuts[i].sup() < low) continue;
    span.clip(planes[i].exact, segment);
  }
  if (span.low > span.high) return 0;
  const Vector<Rational> along = vector_to<Rational>(segment.from, segment.to);
  const Rational share = span.high - span.low;
  return rounded_root(share * share * dot(along, along));
}

double ExactDelaunay::length_in_moved_hull(const Segment& segment, double outwards) const {
  Span<double> span;
  for (const auto& plane : implementation_->hull_planes) {
    HalfSpace<double> side = plane.rounded;
    side.offset += outwards;
    span.clip(side, segment);
  }
  const Vector<double> along = vector_to<double>(segment.from, segment.to);
  return std::max(0.0, span.high - span.low) * std::sqrt(dot(along, along));
}

double ExactDelaunay::clearance(const Segment& segment,
                                const std::vector<std::uint32_t>& cells) const {
  Vector<double> along = vector_to<double>(segment.from, segment.to);
  const double length = std::sqrt(dot(along, along));
  for (double& x : along) x /= length;
  double least = kInfinity;
  auto keep_off_edge = [&](std::uint32_t a, std::uint32_t b) {
    least = std::min(least, distance(segment.from, along, points_[a], points_[b]));
  };
  for (const auto& [a, b] : implementation_->hull_edges) keep_off_edge(a, b);
  for (const std::uint32_t cell : cells)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) keep_off_edge(tetrahedra_[cell][i], tetrahedra_[cell][j]);
  if (cells.empty()) return least;
  for (const HalfSpace<double>& side : sides(points_, tetrahedra_[cells.front()]))
    least = std::min(least, std::abs(height(side, segment.from)));
  for (const HalfSpace<double>& side : sides(points_, tetrahedra_[cells.back()]))
    least = std::min(least, std::abs(height(side, segment.to)));
  return least;
}

bool ExactDelaunay::passes(const Segment& segment, std::uint32_t cell, double depth) const {
  Span<double> span;
  for (HalfSpace<double> side : sides(points_, tetrahedra_[cell])) {
    side.offset -= depth;
    span.clip(side, segment);
  }
  return span.low < span.high;
}

}  // namespace plume::reference
