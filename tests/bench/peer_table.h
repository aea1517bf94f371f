/// Peers, timed in turns and compared with a reference.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "plume/lib/image.h"
#include "plume/tests/bench/peer.h"
#include "plume/tests/bench/picture_error.h"

namespace plume::bench {

struct PeerTimings {
  int rounds = 5;          ///< frames of each way; medians are reported
  double limit = 60;       ///< seconds a way may take in all; one frame is always made
  bool one_thread = true;  ///< then the process' time on the processor is taken, else the clock's
  /// Told of each way's first frame, where it is given.
  std::function<void(const std::string&)> say;
  /// A directory for the pictures, as PNG files; none where empty.
  std::string pictures;
};

struct PeerRow {
  std::string family, method;
  double seconds = 0;  ///< median of a frame
  int frames = 0;      ///< that it is the median of
  /// Whether the first frame, which builds what is kept, is the only one: it took the limit.
  bool cold = false;
  PictureError error;  ///< against the reference
};

/// Each makes a frame that is not timed, unless it takes the limit, and shows its picture; then all
/// take turns, and those that have used their limit up stand by.
std::vector<PeerRow> compare_peers(std::span<const PeerWay> ways, const Image& reference,
                                   const PeerTimings& timings);

/// "method,family,milliseconds,max_error,rms_error", one line for each.
std::string peer_csv(std::span<const PeerRow> rows);

/// A markdown table, with ratios to the first row.
std::string peer_table(std::span<const PeerRow> rows);

}  // namespace plume::bench
