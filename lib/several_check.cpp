#include "plume/lib/several_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "plume/lib/render_check.h"
#include "plume/lib/render_modes.h"
#include "plume/lib/render_plan.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

// Ways that are there to compare, and the planner, know one mesh.
void check_methods(const RenderSettings& settings) {
  const char* what = nullptr;
  const char* instead = nullptr;
  if (settings.tolerance) {
    what = "a tolerance";
    instead = "choose the order and early termination";
  } else if (settings.integrator.kind != IntegratorKind::closed_form) {
    what = "an integrator other than the closed form";
    instead = "leave it out; where meshes overlap, their sum is integrated to rounding";
  } else if (settings.interval_form != IntervalForm::exponential) {
    what = "the linear form of intervals";
    instead = "leave it out";
  } else if (settings.interval_way != IntervalWay::split) {
    what = "intervals from tables";
    instead = "leave it out";
  }
  if (what != nullptr)
    throw Error(fmt::format("several meshes in one picture have no {}; {}", what, instead));
}

// A channel of hits is of those scenes that have any.
void check_each(const std::vector<const Scene*>& scenes, const RenderSettings& settings) {
  const bool hits = std::any_of(scenes.begin(), scenes.end(), [&](const Scene* scene) {
    return is_classified(*scene, settings);
  });
  for (const Scene* scene : scenes) {
    RenderSettings own = settings;
    if (hits && !is_classified(*scene, settings)) {
      std::erase(own.channels, "isovalue");
      std::erase(own.channels, "normal");
      own.lighting.reset();
    }
    check_settings(*scene, own);
  }
}

// A number of which there is one a ray is of one quantity.
void check_mode(const std::vector<const Scene*>& scenes, Mode mode) {
  const ShadeBy shade = in_words(mode).shade;
  if (shade != ShadeBy::transfer_function && mode != Mode::integral) return;
  const Scene& first = *scenes.front();
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    const ScalarField& field = scenes[i]->field();
    if (field.name != first.field().name)
      throw Error(fmt::format(
          "mode {}: {} shows '{}' and {} shows '{}'; give both the same field, or choose a mode "
          "that each mesh has its own optics in",
          in_words(mode).name, name_of(scenes, 0), first.field().name, name_of(scenes, i),
          field.name));
    if (shade == ShadeBy::transfer_function &&
        scenes[i]->transfer_function() != first.transfer_function())
      throw Error(fmt::format(
          "mode {}: {} and {} have different transfer functions, and a pixel has one colour; set "
          "the same one for both",
          in_words(mode).name, name_of(scenes, 0), name_of(scenes, i)));
  }
}

}  // namespace

std::string name_of(const std::vector<const Scene*>& scenes, std::size_t index) {
  const std::string& name = scenes[index]->name();
  return name.empty() ? fmt::format("mesh {}", index + 1) : fmt::format("mesh '{}'", name);
}

void check_several(const std::vector<const Scene*>& scenes, const RenderSettings& settings) {
  check_each(scenes, settings);
  check_methods(settings);
  check_mode(scenes, settings.mode);
  if (std::count(settings.channels.begin(), settings.channels.end(), "cell_id") > 0)
    throw Error(
        "channel 'cell_id': with several meshes in one picture a number says no cell; leave it "
        "out, "
        "or render the meshes one by one");
}

}  // namespace plume
