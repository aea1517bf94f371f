/// The last integrators made, kept for as long as nothing that they were made from changes.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "plume/preint/integrator.h"

namespace plume {

/// Tables take longer to build than many a frame to render. They depend on the transfer function
/// and the settings alone: a new camera, size, field or light builds nothing. Keeps up to four, the
/// last used first, as long as those besides the first take no more than 64 MB in all: so that who
/// goes to and fro between two functions, or two sizes of table, builds each once. Integrators
/// without a table are made when they are asked for, and leave the tables where they are.
///
/// Safe to call from many threads: one builds, the others wait for it. What was given out stays
/// alive for who holds it.
class IntegratorCache {
 public:
  /// As make_integrator().
  std::shared_ptr<const Integrator> get(const TransferFunction& transfer_function,
                                        const IntegratorSettings& settings);

  /// Tables built so far.
  std::size_t built() const;

 private:
  struct Kept {
    TransferFunction transfer_function;
    IntegratorSettings settings;
    std::shared_ptr<const Integrator> integrator;
  };
  void drop_the_oldest();

  mutable std::mutex guard_;
  std::vector<Kept> kept_;  // the last used first
  std::size_t built_ = 0;
};

}  // namespace plume
