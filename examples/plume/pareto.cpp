#include "pareto.h"

#include <algorithm>
#include <tuple>

namespace plume::command {

bool dominates(const ChartPoint& a, const ChartPoint& b, ErrorOf error) {
  return a.milliseconds <= b.milliseconds && a.*error <= b.*error &&
         (a.milliseconds < b.milliseconds || a.*error < b.*error);
}

std::vector<std::size_t> pareto_front(const std::vector<ChartPoint>& points, ErrorOf error) {
  const auto key = [&](std::size_t i) {
    return std::tuple(points[i].milliseconds, points[i].*error, i);
  };
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || !dominates(points[front.back()], points[i], error)) front.push_back(i);
  return front;
}

std::optional<std::size_t> fastest_within(const std::vector<ChartPoint>& points, double max_error,
                                          ErrorOf error) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].*error > max_error) continue;
    if (!best || std::tie(points[i].milliseconds, points[i].*error) <
                     std::tie(points[*best].milliseconds, points[*best].*error))
      best = i;
  }
  return best;
}

std::vector<std::optional<std::size_t>> dominated_by(const std::vector<ChartPoint>& points,
                                                     ErrorOf error) {
  std::vector<std::optional<std::size_t>> by(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto better = fastest_within(points, points[i].*error, error);
    if (better && dominates(points[*better], points[i], error)) by[i] = better;
  }
  return by;
}

std::vector<PeerFactor> peer_factors(const std::vector<ChartPoint>& ours,
                                     const std::vector<ChartPoint>& theirs) {
  std::vector<PeerFactor> factors;
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    PeerFactor at{error, fastest_within(ours, error), fastest_within(theirs, error), {}};
    if (at.ours && at.theirs)
      at.factor = theirs[*at.theirs].milliseconds / ours[*at.ours].milliseconds;
    factors.push_back(at);
  }
  return factors;
}

}  // namespace plume::command
