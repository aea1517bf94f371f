#include "plume/mesh/distinct_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "plume/mesh/coincident_points.h"
#include "plume/mesh/error.h"
#include "plume/mesh/local_frame.h"

namespace plume {
namespace {

void check_set(const PointSet& set) {
  if (set.points.size() % 3 != 0)
    throw Error(
        fmt::format("the point array has {} values, which is no multiple of 3", set.points.size()));
  if (set.point_count() == 0) throw Error("there are no points");
  constexpr std::size_t kMost = std::size_t{1} << 31;  // as a mesh can have (validate.cpp)
  if (set.point_count() >= kMost)
    throw Error(fmt::format("{} points are more than Plume can number", set.point_count()));
  for (const Field& field : set.fields) {
    if (field.association != Association::point)
      throw Error(fmt::format("field '{}' is of cells, which points alone do not have; drop it",
                              field.name));
    const std::size_t expected = set.point_count() * static_cast<std::size_t>(field.components);
    if (field.values.size() != expected)
      throw Error(fmt::format("field '{}' has {} values for {} points of {} components", field.name,
                              field.values.size(), set.point_count(), field.components));
  }
  bounds_of(set.points);  // names the first point that is not finite
}

Array select(const Array& values, std::size_t components, const std::vector<std::uint32_t>& kept) {
  return values.visit([&](auto all) {
    using T = std::remove_cv_t<typename decltype(all)::value_type>;
    std::vector<T> some;
    some.reserve(components * kept.size());
    for (const std::uint32_t point : kept)
      for (std::size_t c = 0; c < components; ++c) some.push_back(all[components * point + c]);
    return Array::own(std::move(some));
  });
}

bool same_values(const Field& field, std::size_t a, std::size_t b) {
  const auto n = static_cast<std::size_t>(field.components);
  return field.values.visit([&](auto values) {
    for (std::size_t c = 0; c < n; ++c)
      if (!(values[n * a + c] == values[n * b + c])) return false;
    return true;
  });
}

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

}  // namespace

std::uint32_t DistinctPoints::original(std::size_t point) const {
  return kept.empty() ? static_cast<std::uint32_t>(point) : kept[point];
}

DistinctPoints distinct_points(const PointSet& set, std::vector<Finding>& findings) {
  check_set(set);
  DistinctPoints distinct;
  set.points.visit([&](auto values) { distinct.coordinates.assign(values.begin(), values.end()); });
  const std::vector<std::uint32_t> first = first_coincident(distinct.coordinates);
  if (first.empty()) return distinct;
  Finding merged{"points in the place of an earlier one: left out", 0, {}};
  Finding differing{"of the points left out have other values than the one that is kept", 0, {}};
  distinct.place.resize(first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      distinct.place[i] = static_cast<std::uint32_t>(distinct.kept.size());
      std::copy_n(&distinct.coordinates[3 * std::size_t{i}], 3,
                  &distinct.coordinates[3 * distinct.kept.size()]);
      distinct.kept.push_back(i);
      continue;
    }
    distinct.place[i] = distinct.place[first[i]];
    add_example(merged, i);
    const auto same = [&](const Field& field) { return same_values(field, i, first[i]); };
    if (!std::all_of(set.fields.begin(), set.fields.end(), same)) add_example(differing, i);
  }
  distinct.coordinates.resize(3 * distinct.kept.size());
  findings.push_back(std::move(merged));
  if (differing.count > 0) findings.push_back(std::move(differing));
  return distinct;
}

void take_points(const PointSet& set, const DistinctPoints& distinct, Mesh& mesh) {
  mesh.points = set.points;
  mesh.fields = set.fields;
  mesh.active_field = set.active_field;
  if (distinct.kept.empty()) return;
  mesh.points = select(set.points, 3, distinct.kept);
  for (Field& field : mesh.fields)
    field.values = select(field.values, static_cast<std::size_t>(field.components), distinct.kept);
}

std::string describe_point(const DistinctPoints& points, std::size_t point) {
  const double* const p = &points.coordinates[3 * point];
  return fmt::format("point {} ({}, {}, {})", points.original(point), p[0], p[1], p[2]);
}

std::string describe_spread(const DistinctPoints& points) {
  const std::size_t count = points.count();
  const auto at = [&](std::size_t i) {
    return Vector{points.coordinates[3 * i], points.coordinates[3 * i + 1],
                  points.coordinates[3 * i + 2]};
  };
  struct Furthest {
    std::size_t point = 0;
    double distance = 0;
  };
  const auto furthest = [&](auto&& distance) {
    Furthest result;
    for (std::size_t i = 0; i < count; ++i) {
      const double d = distance(at(i));
      if (d > result.distance) result = {i, d};
    }
    return result;
  };
  const Vector a = at(0);
  const Furthest b = furthest([&](const Vector& p) { return length(minus(p, a)); });
  Vector along = minus(at(b.point), a);
  for (double& x : along) x /= b.distance > 0 ? b.distance : 1;
  const Furthest c = furthest([&](const Vector& p) { return length(cross(along, minus(p, a))); });
  Vector normal = cross(along, minus(at(c.point), a));
  for (double& x : normal) x /= c.distance > 0 ? c.distance : 1;
  const Furthest d = furthest([&](const Vector& p) { return std::abs(dot(normal, minus(p, a))); });
  const auto within = [](double distance) {
    return distance > 0 ? fmt::format(", or within {:.2g} of it", distance) : std::string();
  };
  // What rounding makes of points along a line that is aslant; wording only.
  constexpr double kRounding = 1e-14;
  if (c.distance <= kRounding * b.distance)
    return fmt::format("all {} points are on the line through {} and {}{}", count,
                       describe_point(points, 0), describe_point(points, b.point),
                       within(c.distance));
  return fmt::format("all {} points are in the plane of {}, {} and {}{}", count,
                     describe_point(points, 0), describe_point(points, b.point),
                     describe_point(points, c.point), within(d.distance));
}

}  // namespace plume
