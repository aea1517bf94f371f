#include "plume/preint/integrator_cache.h"

#include <tbb/task_arena.h>

namespace plume {

std::shared_ptr<const Integrator> IntegratorCache::get(const TransferFunction& transfer_function,
                                                       const IntegratorSettings& settings) {
  if (settings.kind != IntegratorKind::table && settings.kind != IntegratorKind::second_order_table)
    return std::make_shared<const Integrator>(make_integrator(transfer_function, settings));
  const std::lock_guard lock(guard_);
  if (!last_ || transfer_function != transfer_function_ || settings != settings_) {
    last_.reset();  // a table of the old one need not be kept beside the new one
    // Isolated: a thread that waits for others to build must not take up a task of its caller's
    // that comes here as well.
    tbb::this_task_arena::isolate([&] {
      last_ = std::make_shared<const Integrator>(make_integrator(transfer_function, settings));
    });
    transfer_function_ = transfer_function;
    settings_ = settings;
  }
  return last_;
}

}  // namespace plume
