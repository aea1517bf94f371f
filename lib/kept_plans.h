/// Plans for tolerances, kept from one picture of a scene to the next.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "plume/lib/planner.h"

namespace plume {

/// Planning renders small pictures, and may take longer than the picture itself. What is done for a
/// picture depends on what is the same as in one of the last four:
///
/// | the same                                             | what is done                         |
/// |------------------------------------------------------|--------------------------------------|
/// | everything (scene, camera, settings, classification) | the plan is taken as it is. That is  |
/// |                                                      | provable: planning has no chance in  |
/// |                                                      | it and would find the same           |
/// | all but camera, size, opaque surfaces and depth      | bounds (early termination, closed    |
/// | limits, shades of gray, and the field's values       | form) are computed anew, at no cost. |
/// |                                                      | The order was measured on another    |
/// |                                                      | picture, so it is looked at shortly  |
/// |                                                      | on this one (Pilot::Look::brief)    |
/// |                                                      | and taken if the greatest estimate   |
/// |                                                      | of all pictures so far is within what|
/// |                                                      | is asked. Else planned anew          |
/// | the settings, as above, and both show a plain volume | all is looked at, but the last order |
/// | (another transfer function)                          | first: taken if its estimate here is |
/// |                                                      | within what is asked, and nothing    |
/// |                                                      | cheaper seems to be                  |
/// | anything else differs (tolerance, mode, light, clip  | planned anew. Where cells are linear |
/// | planes, ...)                                         | that is a matter of microseconds     |
///
/// Threads, the window and further channels do not matter to a plan.
///
/// Safe to call from many threads. What plan is kept then depends on who was first.
class KeptPlans {
 public:
  /// As plan_for(), which it calls where it has to. Requires as that does, of the one scene.
  Plan get(const Scene& scene, const Camera& camera, const RenderSettings& settings);

  /// The field's values or the opaque surfaces are others: no plan is taken as it is.
  void scene_changed();

 private:
  struct Kept {
    Camera camera;
    RenderSettings settings;
    Classification classification;
    std::uint64_t version;  // of the scene
    Plan plan;
  };
  std::mutex guard_;
  std::uint64_t version_ = 0;
  std::vector<Kept> kept_;  // the last used first
};

}  // namespace plume
