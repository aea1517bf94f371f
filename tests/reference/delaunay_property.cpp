#include "delaunay_property.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace plume::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Rational = CGAL::Gmpq;

Point at(const Points& points, std::uint32_t i) {
  return {points[i][0], points[i][1], points[i][2]};
}

// Each face, by its ascending points, with the fourth points of its tetrahedra.
std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> faces(
    const Tetrahedra& tetrahedra) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> result;
  for (const auto& t : tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::uint32_t, 3> face{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      std::sort(face.begin(), face.end());
      result[face].push_back(t[i]);
    }
  return result;
}

}  // namespace

std::size_t count_not_positive(const Points& points, const Tetrahedra& tetrahedra) {
  return static_cast<std::size_t>(
      std::count_if(tetrahedra.begin(), tetrahedra.end(), [&](const auto& t) {
        return CGAL::orientation(at(points, t[0]), at(points, t[1]), at(points, t[2]),
                                 at(points, t[3])) != CGAL::POSITIVE;
      }));
}

std::size_t count_bad_faces(const Points& points, const Tetrahedra& tetrahedra) {
  std::size_t bad = 0;
  for (const auto& [face, fourth] : faces(tetrahedra)) {
    const auto side = [&, &face = face](std::uint32_t p) {
      return CGAL::orientation(at(points, face[0]), at(points, face[1]), at(points, face[2]),
                               at(points, p));
    };
    if (fourth.size() > 2 || (fourth.size() == 2 && side(fourth[0]) == side(fourth[1]))) ++bad;
  }
  return bad;
}

std::size_t count_not_delaunay(const Points& points, const Tetrahedra& tetrahedra) {
  std::size_t bad = 0;
  for (const auto& [face, fourth] : faces(tetrahedra))
    if (fourth.size() == 2 &&
        CGAL::side_of_bounded_sphere(at(points, face[0]), at(points, face[1]), at(points, face[2]),
                                     at(points, fourth[0]),
                                     at(points, fourth[1])) == CGAL::ON_BOUNDED_SIDE)
      ++bad;
  return bad;
}

std::string six_volumes(const Points& points, const Tetrahedra& tetrahedra) {
  Rational sum = 0;
  for (const auto& t : tetrahedra) {
    std::array<std::array<Rational, 3>, 3> v;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 3; ++a)
        v[i][a] = Rational(points[t[i + 1]][a]) - Rational(points[t[0]][a]);
    sum += v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
           v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  }
  std::ostringstream text;
  text << sum;
  return text.str();
}

}  // namespace plume::reference
