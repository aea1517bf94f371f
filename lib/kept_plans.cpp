#include "plume/lib/kept_plans.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace plume {
namespace {

constexpr std::size_t kMost = 4;  // plans: four views of one scene, say

// What a plan depends on.
RenderSettings that_matter(RenderSettings settings) {
  settings.window.reset();
  settings.channels.clear();
  settings.threads = 0;
  settings.overlap = {};
  return settings;
}

// What remains the same from view to view.
RenderSettings of_all_views(RenderSettings settings) {
  settings.width = settings.height = 1;
  settings.depth_limit.clear();
  settings.gray_range.reset();
  return settings;
}

// What was chosen by a plan for the picture: one of the settings' own is not a choice.
RenderSettings with_choices_of(const RenderSettings& plan, const RenderSettings& settings) {
  RenderSettings made = settings;
  made.tolerance.reset();
  made.order = plan.order;
  made.scalar_tolerance = plan.scalar_tolerance;
  made.integrator = plan.integrator;
  made.early_termination = plan.early_termination;
  made.scalar_twin = plan.scalar_twin;
  return made;
}

}  // namespace

Plan KeptPlans::get(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  if (!settings.tolerance->keep_plans) return plan_for(scene, camera, settings);
  Kept now{camera, that_matter(settings), scene.classification(), 0, {}};
  std::optional<ChosenOrder> before;
  {
    const std::lock_guard lock(guard_);
    now.version = version_;
    auto looks_alike = [&](const Kept& kept) {
      return kept.classification == now.classification &&
             of_all_views(kept.settings) == of_all_views(now.settings);
    };
    const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
      return kept.version == now.version && kept.camera == now.camera &&
             kept.settings == now.settings && kept.classification == now.classification;
    });
    if (same != kept_.end()) {
      std::rotate(kept_.begin(), same, same + 1);
      Plan plan = kept_.front().plan;
      plan.settings = with_choices_of(plan.settings, settings);
      plan.reasons.emplace_back("plan: an earlier picture's, of which nothing has changed");
      return plan;
    }
    const auto alike = std::find_if(kept_.begin(), kept_.end(), looks_alike);
    if (alike != kept_.end()) {
      before = alike->plan.order;
    } else {
      const auto other_look = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
        return kept.classification.is_plain_volume() && now.classification.is_plain_volume() &&
               of_all_views(kept.settings) == of_all_views(now.settings);
      });
      if (other_look != kept_.end()) before = other_look->plan.order;
      if (before) before->of_other_look = true;
    }
  }
  // Not under the lock: planning renders, on threads that may come here for another picture.
  now.plan = plan_for(scene, camera, settings, before ? &*before : nullptr);
  Plan plan = now.plan;
  const std::lock_guard lock(guard_);
  if (now.version != version_) return plan;
  kept_.insert(kept_.begin(), std::move(now));
  if (kept_.size() > kMost) kept_.pop_back();
  return plan;
}

void KeptPlans::scene_changed() {
  const std::lock_guard lock(guard_);
  ++version_;
}

}  // namespace plume
