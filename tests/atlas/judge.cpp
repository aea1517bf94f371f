#include "judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "cell_soup.h"
#include "plume/mesh/validate.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/tests/reference/cell_distance.h"
#include "plume/tests/traverse/cell_loops.h"

namespace plume::atlas {
namespace {

constexpr double kMoved = 5e-7, kSlack = 1e-6;
// A ray whose truth is known better than this has an error worth a number.
constexpr double kKnown = 2e-6;

// Rays next to a ray.
class Beside {
 public:
  explicit Beside(const Ray& ray) : ray_(ray) {
    const Place& d = ray.direction;
    std::size_t least = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (std::abs(d[a]) < std::abs(d[least])) least = a;
    Place axis{0, 0, 0};
    axis[least] = 1;
    x_ = cross(axis, d);
    const double length = std::sqrt(x_[0] * x_[0] + x_[1] * x_[1] + x_[2] * x_[2]);
    for (double& c : x_) c /= length;
    y_ = cross(d, x_);
  }

  Ray moved(double distance, double angle) const {
    Ray ray = ray_;
    for (std::size_t a = 0; a < 3; ++a)
      ray.origin[a] += distance * (std::cos(angle) * x_[a] + std::sin(angle) * y_[a]);
    return ray;
  }
  // Moved sideways by one distance at t_0 and by another one at t_1.
  Ray turned(const std::array<double, 2>& at_0, const std::array<double, 2>& at_1, double t_0,
             double t_1) const {
    Ray ray = ray_;
    for (std::size_t a = 0; a < 3; ++a) {
      const double first = at_0[0] * x_[a] + at_0[1] * y_[a];
      const double slope = (at_1[0] * x_[a] + at_1[1] * y_[a] - first) / (t_1 - t_0);
      ray.origin[a] += first - slope * t_0;
      ray.direction[a] += slope;
    }
    return ray;
  }

 private:
  static Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  const Ray& ray_;
  Place x_, y_;
};

std::vector<reference::CellLoops> fans_of(const CellSoup& soup) {
  std::vector<reference::CellLoops> cells(soup.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const auto& t : soup.cells[c].triangles)
      cells[c].push_back(
          {soup.points[t.points[0]], soup.points[t.points[1]], soup.points[t.points[2]]});
  return cells;
}

std::vector<reference::CellLoops> those_of(const std::vector<reference::CellLoops>& loops,
                                           const std::vector<std::uint32_t>& cells) {
  std::vector<reference::CellLoops> those;
  for (const std::uint32_t c : cells) those.push_back(loops[c]);
  return those;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

void Tally::add(const Tally& other) {
  rays += other.rays;
  lost += other.lost;
  looping += other.looping;
  gaps += other.gaps;
  overlaps += other.overlaps;
  wrong_cells += other.wrong_cells;
  failed += other.failed;
  chord_error = std::max(chord_error, other.chord_error);
  integral_error = std::max(integral_error, other.integral_error);
}

void Judge::Range::take(double x) {
  low = std::min(low, x);
  high = std::max(high, x);
}

Judge::Judge(const SceneMesh& mesh, Oracle oracle)
    : mesh_(mesh), oracle_(oracle), diagonal_(check_structure(mesh.mesh).diagonal()) {
  if (oracle == Oracle::cells) {
    loops_[Surface::faces] = test::loops_of(mesh.mesh);
    if (mesh.cells == "grid") loops_[Surface::triangles] = test::triangles_of(mesh.mesh);
    if (mesh.cells != "grid" && mesh.cells != "rectilinear" && mesh.cells != "tetrahedra")
      loops_[Surface::fans] = fans_of(CellSoup(mesh.mesh));
    for (const auto& [surface, loops] : loops_) truths_[surface] = truths_of(loops);
    return;
  }
  for (const Ray& ray : mesh.rays)
    truths_[Surface::faces].push_back(oracle == Oracle::box ? truth_of_box(ray) : Truth{});
}

// The cells that the ray comes near, by the spheres around them.
std::vector<std::uint32_t> Judge::cells_near(const Loops& loops, const Ray& ray) const {
  std::vector<std::uint32_t> found;
  for (std::uint32_t c = 0; c < loops.size(); ++c) {
    const reference::CellLoops& cell = loops[c];
    if (cell.empty()) continue;
    const Place& from = cell[0][0];
    double radius2 = 0, along = 0, distance2 = 0;
    for (const auto& loop : cell)
      for (const Place& p : loop) {
        double away = 0;
        for (std::size_t a = 0; a < 3; ++a) away += (p[a] - from[a]) * (p[a] - from[a]);
        radius2 = std::max(radius2, away);
      }
    for (std::size_t a = 0; a < 3; ++a) along += (from[a] - ray.origin[a]) * ray.direction[a];
    for (std::size_t a = 0; a < 3; ++a) {
      const double aside = from[a] - ray.origin[a] - along * ray.direction[a];
      distance2 += aside * aside;
    }
    if (std::sqrt(distance2) < std::sqrt(radius2) + 2 * kMoved * diagonal_) found.push_back(c);
  }
  return found;
}

std::vector<Judge::Truth> Judge::truths_of(const Loops& loops) const {
  const LinearField field(mesh_.mesh);
  std::vector<Truth> truths;
  for (const Ray& ray : mesh_.rays) {
    Truth& truth = truths.emplace_back();
    truth.near = cells_near(loops, ray);
    const Loops nearby = those_of(loops, truth.near);
    const Beside beside(ray);
    // The line itself would run into its own degeneracies, which the oracle knows nothing of.
    const Ray itself = beside.moved(1e-9 * diagonal_, 1);
    const auto seen = reference::line_lengths(nearby, itself.origin, itself.direction);
    truth.length = sum_of(seen.length);
    truth.total = {truth.length, truth.length};
    truth.cells.resize(loops.size());
    for (std::size_t c = 0; c < nearby.size(); ++c)
      truth.cells[truth.near[c]] = {seen.length[c], seen.length[c]};
    double slope = 0;
    for (std::size_t a = 0; a < 3; ++a) slope += field.slope[a] * ray.direction[a];
    auto integral_of = [&](const reference::LineLengths& of) {
      return field.at(ray.origin.data()) * sum_of(of.length) + slope * sum_of(of.moment);
    };
    truth.integral = integral_of(seen);
    Range integrals{truth.integral, truth.integral};
    for (int i = 0; i < 8; ++i) {
      const Ray moved = beside.moved(kMoved * diagonal_, 0.3 + i * 0.785);
      const auto of_moved = reference::line_lengths(nearby, moved.origin, moved.direction);
      truth.total.take(sum_of(of_moved.length));
      integrals.take(integral_of(of_moved));
      for (std::size_t c = 0; c < nearby.size(); ++c)
        truth.cells[truth.near[c]].take(of_moved.length[c]);
    }
    truth.known =
        truth.total.width() <= kKnown * diagonal_ && integrals.width() <= kKnown * diagonal_;
  }
  return truths;
}

// What is seen from t_min on of the box, and of boxes smaller and larger by what rounding may do.
Judge::Truth Judge::truth_of_box(const Ray& ray) const {
  const Bounds bounds = check_structure(mesh_.mesh);
  auto seen = [&](double by) {
    Bounds moved = bounds;
    for (std::size_t a = 0; a < 3; ++a) {
      moved.low[a] -= by;
      moved.high[a] += by;
    }
    const auto span = reference::box_span(moved.low, moved.high, ray.origin, ray.direction);
    return std::max(0.0, span[1] - std::max(span[0], ray.t_min));
  };
  Truth truth;
  truth.length = seen(0);
  truth.total = {seen(-kMoved * diagonal_), seen(kMoved * diagonal_)};
  truth.known = truth.total.width() <= kKnown * diagonal_;
  return truth;
}

// Whether rays within rounding see that length, or as little and as much, of all these cells.
bool Judge::some_ray_sees(double length, const Loops& loops, const Ray& ray, Range range,
                          double slack) const {
  std::mt19937_64 random(1);
  auto offset = [&] {
    std::array<double, 2> place;
    for (double& x : place)
      x = kMoved * diagonal_ * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
    return place;
  };
  const Beside beside(ray);
  const Bounds bounds = check_structure(mesh_.mesh);
  double middle = 0;
  for (std::size_t a = 0; a < 3; ++a)
    middle += (bounds.center()[a] - ray.origin[a]) * ray.direction[a];
  for (int i = 0; i < 100; ++i) {
    const auto at_0 = offset(), at_1 = offset();
    const Ray turned =
        beside.turned(at_0, at_1, middle - 0.5 * diagonal_, middle + 0.5 * diagonal_);
    range.take(sum_of(reference::line_lengths(loops, turned.origin, turned.direction).length));
    if (range.holds(length, slack)) return true;
  }
  return false;
}

// Whether a stretch of the ray is not where the cell is. Of what is sampled, the sample is asked.
bool Judge::is_beside(const Span& span, const Ray& ray, const reference::CellLoops& cell,
                      bool sampled) const {
  for (const double share : {0.5, 0.1, 0.3, 0.7, 0.9}) {
    if (sampled && share != 0.5) break;
    const double t = span.t_in + share * (span.t_out - span.t_in);
    Place place;
    for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
    if (reference::distance_outside(cell, place) > (kMoved + kSlack) * diagonal_) return true;
  }
  return false;
}

Tally Judge::operator()(const MethodWalks& method) const {
  const Surface surface = truths_.count(method.surface) > 0 ? method.surface : Surface::faces;
  const auto& truths = truths_.at(surface);
  const double slack = kSlack * diagonal_ + 4 * method.resolution;
  Tally tally;
  std::vector<double> length;
  for (std::size_t i = 0; i < method.walks.size(); ++i) {
    const AtlasWalk& walk = method.walks[i];
    const Truth& truth = truths[i];
    ++tally.rays;

    std::vector<std::array<double, 2>> covered;
    double sum = 0, integral = 0;
    bool backwards = false;
    length.assign(truth.cells.size(), 0);
    for (const Span& span : walk.spans) {
      // What is not a number covers nothing, and is missed as a gap.
      if (!(span.t_out >= span.t_in)) {
        backwards = backwards || span.t_out < span.t_in - slack;
        continue;
      }
      covered.push_back({span.t_in, span.t_out});
      sum += span.t_out - span.t_in;
      integral += 0.5 * (span.s_in + span.s_out) * (span.t_out - span.t_in);
      if (span.cell < length.size()) length[span.cell] += span.t_out - span.t_in;
    }
    std::sort(covered.begin(), covered.end());
    double together = 0, until = -std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : covered) {
      if (to > until) together += to - std::max(from, until);
      until = std::max(until, to);
    }

    const bool right_total = truth.total.holds(together, slack) ||
                             (!truth.known && oracle_ == Oracle::cells &&
                              some_ray_sees(together, those_of(loops_.at(surface), truth.near),
                                            mesh_.rays[i], truth.total, slack));
    const bool gap = !right_total && together < truth.total.low;
    const bool overlap =
        backwards || sum > together + slack || (!right_total && together > truth.total.high);
    const bool wrong = std::any_of(walk.spans.begin(), walk.spans.end(), [&](const Span& span) {
      return span.cell < length.size() && length[span.cell] > truth.cells[span.cell].high + slack &&
             is_beside(span, mesh_.rays[i], loops_.at(surface)[span.cell], method.resolution > 0);
    });
    tally.lost += walk.lost ? 1 : 0;
    tally.looping += walk.looping ? 1 : 0;
    tally.gaps += gap ? 1 : 0;
    tally.overlaps += overlap ? 1 : 0;
    tally.wrong_cells += wrong ? 1 : 0;
    tally.failed += walk.lost || walk.looping || gap || overlap || wrong ? 1 : 0;

    if (oracle_ == Oracle::none || truth.total.high - truth.total.low > kKnown * diagonal_)
      continue;
    tally.chord_error = std::max(tally.chord_error, std::abs(together - truth.length) / diagonal_);
    if (oracle_ != Oracle::cells) continue;
    const double error = std::abs(integral - truth.integral) / diagonal_;
    tally.integral_error = std::isnan(error) ? std::numeric_limits<double>::infinity()
                                             : std::max(tally.integral_error, error);
  }
  return tally;
}

}  // namespace plume::atlas
