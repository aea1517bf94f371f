/// What is worth its time: points of time and error, and which of them nothing else beats.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace plume::command {

/// One way to make a picture, as it was measured.
struct ChartPoint {
  std::string method;       ///< what it is called
  std::string family;       ///< "plume", or whose it is
  double milliseconds = 0;  ///< a frame, > 0
  double max_error = 0;     ///< the greatest difference of a channel from the reference, >= 0
  double rms_error = 0;     ///< over all channels of all pixels, >= 0
};

/// Which of its errors a point is judged by.
using ErrorOf = double ChartPoint::*;

/// Whether `a` takes no longer than `b`, has no greater error, and is better in one of the two.
bool dominates(const ChartPoint& a, const ChartPoint& b, ErrorOf error = &ChartPoint::max_error);

/// The numbers of the points that none dominates, the fastest first. Of points alike in both, all.
std::vector<std::size_t> pareto_front(const std::vector<ChartPoint>& points,
                                      ErrorOf error = &ChartPoint::max_error);

/// The number of the fastest point with an error of at most that, of several as fast the one with
/// the least error; nothing where none is. It is on the front.
std::optional<std::size_t> fastest_within(const std::vector<ChartPoint>& points, double max_error,
                                          ErrorOf error = &ChartPoint::max_error);

/// For each point the one to take in its place: the fastest whose error is no greater. Nothing for
/// points of the front.
std::vector<std::optional<std::size_t>> dominated_by(const std::vector<ChartPoint>& points,
                                                     ErrorOf error = &ChartPoint::max_error);

/// How a peer compares with us at one error.
struct PeerFactor {
  double error;                     ///< both must keep to it
  std::optional<std::size_t> ours;  ///< the fastest of ours that does
  std::optional<std::size_t> theirs;
  /// How many times as long the peer's takes; nothing where one of the two has no such point.
  std::optional<double> factor;
};

/// At each decade of the error from 1e-1 to 1e-6.
std::vector<PeerFactor> peer_factors(const std::vector<ChartPoint>& ours,
                                     const std::vector<ChartPoint>& theirs);

}  // namespace plume::command
