#include "plume/lib/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plume/lib/pilot.h"
#include "plume/lib/render_modes.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/tiles.h"

namespace plume {
namespace {

// A way to follow the scalar, the cheaper ones first (docs/evidence.md has what they cost).
struct Candidate {
  ScalarOrder order;
  double scalar_tolerance;
};
// As they cost, on the charts of docs/choosing.md.
constexpr std::array<Candidate, 9> kCandidates{{{ScalarOrder::linear, 1e-4},
                                                {ScalarOrder::quadratic, 1e-3},
                                                {ScalarOrder::quadratic, 1e-4},
                                                {ScalarOrder::quadratic, 1e-5},
                                                {ScalarOrder::cubic, 1e-4},
                                                {ScalarOrder::cubic, 1e-5},
                                                {ScalarOrder::adaptive, 1e-4},
                                                {ScalarOrder::adaptive, 1e-5},
                                                {ScalarOrder::adaptive, 1e-6}}};
// What is measured is taken so many times, for what was not looked at.
constexpr double kSafety = 2;

// Whether a pixel shows what one place on its ray is like: its error may be that of one cell, the
// worst of which a sample of pixels does not find.
bool is_of_one_place(Mode mode) {
  return mode == Mode::maximum || mode == Mode::minimum || mode == Mode::depth;
}

double greatest_color(const Scene& scene) {
  double greatest = 1;  // of alpha
  auto look_at = [&](const std::array<float, 3>& color) {
    for (const float channel : color) greatest = std::max<double>(greatest, channel);
  };
  const Classification& classification = scene.classification();
  if (classification.volume)
    for (const auto& knot : classification.volume->knots) look_at(knot.optics.color);
  for (const Isosurface& surface : classification.isosurfaces) look_at(surface.color);
  for (const IntervalVolume& interval : classification.intervals)
    for (const auto& knot : interval.profile.knots) look_at(knot.optics.color);
  return greatest;
}

const char* name_of(ScalarOrder order) {
  constexpr const char* kNames[] = {"", "1", "2", "3", "adaptive"};
  return kNames[static_cast<int>(order)];
}

bool has_optics(Mode mode) { return mode == Mode::volume || mode == Mode::optical_depth; }

// Chooses the order, and how closely its segments are followed.
void choose_order(const Scene& scene, const Camera& camera, RenderSettings& settings,
                  double max_error, double allowed, bool choose_integrator,
                  std::vector<std::string>& reasons) {
  if (is_of_one_place(settings.mode)) {
    settings.order = ScalarOrder::adaptive;
    settings.scalar_tolerance = std::clamp(0.1 * max_error, 1e-6, 1e-4);
    reasons.push_back(fmt::format(
        "order of the scalar: adaptive, to {:.1g} of the field's range, as the error of a "
        "pixel is that of one place, and samples do not find the worst",
        settings.scalar_tolerance));
    return;
  }
  const RenderSettings reference = reference_settings(settings, max_error);
  Pilot pilot(scene, camera, reference);
  std::string tried;
  settings.order = ScalarOrder::adaptive;  // none tried yet
  for (const Candidate& candidate : kCandidates) {
    if (candidate.scalar_tolerance < reference.scalar_tolerance) continue;
    // Whoever asks no optics sees no linear parts.
    if (candidate.order == settings.order && candidate.order != ScalarOrder::adaptive &&
        !has_optics(settings.mode))
      continue;
    settings.order = candidate.order;
    settings.scalar_tolerance = candidate.scalar_tolerance;
    RenderSettings whole = settings;
    whole.early_termination = 0;  // it has a share of its own
    const double error = kSafety * pilot.error_of(whole);
    if (error <= allowed) {
      reasons.push_back(fmt::format(
          "order of the scalar: {}, at an error of {:.1g} (twice the greatest of {} pixels "
          "compared with the reference){}",
          name_of(candidate.order), error, pilot.pixels(), tried));
      return;
    }
    tried += fmt::format("{} order {} has {:.1g}", tried.empty() ? ";" : ",",
                         name_of(candidate.order), error);
  }
  settings.order = reference.order;
  settings.scalar_tolerance = reference.scalar_tolerance;
  if (choose_integrator) settings.integrator = reference.integrator;
  reasons.push_back(
      "order of the scalar and integrator: the reference's, as nothing cheaper will do" + tried);
}

}  // namespace

RenderSettings reference_settings(RenderSettings settings, double max_error) {
  settings.tolerance.reset();
  settings.order = ScalarOrder::adaptive;
  settings.scalar_tolerance = std::clamp(1e-3 * max_error, 1e-6, 1e-5);
  settings.integrator = {};
  settings.integrator.kind = IntegratorKind::reference;
  settings.early_termination = 0;
  settings.scalar_twin = true;
  return settings;
}

RenderSettings plan_for(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                        std::vector<std::string>& reasons) {
  const Tolerance& asked = *settings.tolerance;
  const double max_error = asked.max_error;
  RenderSettings plan = settings;
  plan.tolerance.reset();
  if (max_error == 0) {
    const RenderSettings reference = reference_settings(settings);
    if (asked.choose_order) {
      plan.order = reference.order;
      plan.scalar_tolerance = reference.scalar_tolerance;
    }
    if (asked.choose_integrator) plan.integrator = reference.integrator;
    if (asked.choose_early_termination) plan.early_termination = reference.early_termination;
    plan.scalar_twin = true;
    reasons.push_back("tolerance 0: the reference");
    return plan;
  }
  reasons.push_back(fmt::format("tolerance {:g} in each channel", max_error));
  const double color = greatest_color(scene);
  const bool composites = settings.mode == Mode::volume;
  const bool look_for_order =
      asked.choose_order && !has_linear_cells(scene) && settings.mode != Mode::cell_count;
  double left = max_error;
  if (asked.choose_integrator) plan.integrator = {};
  if (composites && asked.choose_integrator) {
    const double by_packets =
        color * (is_classified(scene, settings) ? kClassifiedPacketError : kPacketError);
    plan.scalar_twin = settings.scalar_twin || by_packets > max_error / 4;
    const double error = plan.scalar_twin ? color * kScalarError : by_packets;
    left -= error;
    reasons.push_back(
        fmt::format("integrator: closed form, exact but for rounding: at most {:.1g}{}", error,
                    plan.scalar_twin ? ", ray by ray in double" : ""));
  }
  if (composites && asked.choose_early_termination) {
    const double share = max_error * (look_for_order ? 0.25 : 0.5);
    plan.early_termination = std::min(share / color, 0.5);
    left -= share;
    reasons.push_back(
        fmt::format("early termination: at a transmittance of {:.2g}, a bound of {:.1g}",
                    plan.early_termination, share));
  }
  if (look_for_order)
    choose_order(scene, camera, plan, max_error, left, asked.choose_integrator, reasons);
  return plan;
}

double shade_width(const RenderStatistics& statistics) {
  if (!statistics.gray_range) return 0;
  const auto& [low, high] = *statistics.gray_range;
  return static_cast<double>(high) - low;
}

double greatest_difference(const Image& picture, const Image& reference, Mode mode, double width) {
  double greatest = 0;
  // What is no number in one of them alone differs by as much as can be.
  auto take = [&](double a, double b, double unit) {
    if (std::isnan(a) && std::isnan(b)) return;
    const double difference = std::abs(a - b) / unit;
    greatest = std::max(greatest, std::isnan(difference) ? 1.0 : difference);
  };
  const std::size_t count = reference.rgba.size() / 4;
  for (std::size_t i = 0; i < 4 * count; ++i)
    if (width == 0 || i % 4 == 3) take(picture.rgba[i], reference.rgba[i], 1);
  if (width == 0) return greatest;
  const char* const channel = in_words(mode).channel;
  const auto& values = picture.channel(channel)->values;
  const auto& right = reference.channel(channel)->values;
  for (std::size_t i = 0; i < count; ++i)
    if (reference.rgba[4 * i + 3] != 0 && picture.rgba[4 * i + 3] != 0)
      take(values[i], right[i], width);
  return greatest;
}

}  // namespace plume
