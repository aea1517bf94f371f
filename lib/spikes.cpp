#include "plume/lib/spikes.h"

#include <algorithm>
#include <limits>

namespace plume {

double narrowest_spike(const TransferFunction& transfer_function) {
  double narrowest = std::numeric_limits<double>::infinity();
  const auto& knots = transfer_function.knots;
  if (knots.empty()) return narrowest;
  double greatest = 0;
  for (const auto& knot : knots) greatest = std::max<double>(greatest, knot.optics.extinction);
  const double enough = 0.1 * greatest;
  double low = knots.front().optics.extinction, peak = low, from = knots.front().scalar;
  for (const auto& knot : knots) {
    const double extinction = knot.optics.extinction;
    peak = std::max(peak, extinction);
    const bool fallen = peak - low > enough && peak - extinction > enough;
    if (fallen) narrowest = std::min(narrowest, knot.scalar - from);
    if (fallen || extinction <= low) {
      low = peak = extinction;
      from = knot.scalar;
    }
  }
  return narrowest;
}

}  // namespace plume
