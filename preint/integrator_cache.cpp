#include "plume/preint/integrator_cache.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace plume {
namespace {

constexpr std::size_t kMost = 4, kMostBytes = 64'000'000;

std::size_t bytes_of(const Integrator& integrator) {
  return std::visit(
      [](const auto& table) -> std::size_t {
        if constexpr (requires { table.bytes(); }) return table.bytes();
        return 0;
      },
      integrator);
}

}  // namespace

std::shared_ptr<const Integrator> IntegratorCache::get(const TransferFunction& transfer_function,
                                                       const IntegratorSettings& settings) {
  if (settings.kind != IntegratorKind::table && settings.kind != IntegratorKind::second_order_table)
    return std::make_shared<const Integrator>(make_integrator(transfer_function, settings));
  const std::lock_guard lock(guard_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return kept.settings == settings && kept.transfer_function == transfer_function;
  });
  if (found != kept_.end()) {
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front().integrator;
  }
  Kept made{transfer_function, settings, nullptr};
  // Isolated: a thread that waits for others to build must not take up a task of its caller's
  // that comes here as well.
  tbb::this_task_arena::isolate([&] {
    made.integrator =
        std::make_shared<const Integrator>(make_integrator(transfer_function, settings));
  });
  ++built_;
  kept_.insert(kept_.begin(), std::move(made));
  drop_the_oldest();
  return kept_.front().integrator;
}

void IntegratorCache::drop_the_oldest() {
  std::size_t bytes = 0, count = 1;
  for (; count < std::min(kept_.size(), kMost); ++count) {
    bytes += bytes_of(*kept_[count].integrator);
    if (bytes > kMostBytes) break;
  }
  kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(count), kept_.end());
}

std::size_t IntegratorCache::built() const {
  const std::lock_guard lock(guard_);
  return built_;
}

}  // namespace plume
