/// The last integrator made, kept for as long as nothing that it was made from changes.
#pragma once

#include <memory>
#include <mutex>

#include "plume/preint/integrator.h"

namespace plume {

/// Tables take longer to build than many a frame to render. Keeps the last one, and builds anew
/// where the transfer function or the settings are others than for that. Integrators without a
/// table are made when they are asked for, and leave it where it is.
///
/// Safe to call from many threads: one builds, the others wait for it. What was given out stays
/// alive for who holds it.
class IntegratorCache {
 public:
  /// As make_integrator().
  std::shared_ptr<const Integrator> get(const TransferFunction& transfer_function,
                                        const IntegratorSettings& settings);

 private:
  std::mutex guard_;
  TransferFunction transfer_function_;
  IntegratorSettings settings_;
  std::shared_ptr<const Integrator> last_;
};

}  // namespace plume
