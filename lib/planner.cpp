#include "plume/lib/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "plume/lib/pilot.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/spikes.h"
#include "plume/lib/tiles.h"

namespace plume {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A way to follow the scalar.
struct Candidate {
  ScalarOrder order;
  double scalar_tolerance;
};
// The cheaper ones first. By packets, on the combustor at 512 x 512, they take 1, 1.6, 1.8, 2, 2.3
// (to 1e-4), 3.6 and 7 times as long as the first; order 3 takes 0.9 of the adaptive one's time to
// the same tolerance, for which it vouches for nothing.
constexpr Candidate kByPackets[] = {{ScalarOrder::linear, 1e-4},   {ScalarOrder::quadratic, 1e-3},
                                    {ScalarOrder::adaptive, 1e-3}, {ScalarOrder::adaptive, 3e-4},
                                    {ScalarOrder::adaptive, 1e-4}, {ScalarOrder::adaptive, 1e-5},
                                    {ScalarOrder::adaptive, 1e-6}};
// Ray by ray, as on the charts of 2026-11-22: 1, 1.7, 2, 2.8, 2.5, 3.3, 3.8, 4.6 and 6.6 times.
constexpr Candidate kRayByRay[] = {
    {ScalarOrder::linear, 1e-4},    {ScalarOrder::quadratic, 1e-3}, {ScalarOrder::quadratic, 1e-4},
    {ScalarOrder::quadratic, 1e-5}, {ScalarOrder::cubic, 1e-4},     {ScalarOrder::cubic, 1e-5},
    {ScalarOrder::adaptive, 1e-4},  {ScalarOrder::adaptive, 1e-5},  {ScalarOrder::adaptive, 1e-6}};
// What packets' pictures are compared with may be off by this share of the tolerance; where that is
// less than their rounding, it is the reference.
constexpr double kShareOfReference = 0.02;

// Samples may miss what spikes do that are narrower than this share of the field's range.
constexpr double kNarrow = 0.02;

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

// Makes one plan.
class Planner {
 public:
  Planner(const Scene& scene, const Camera& camera, const RenderSettings& settings,
          const ChosenOrder* before)
      : scene_(scene),
        camera_(camera),
        asked_(*settings.tolerance),
        before_(before),
        has_orders_(!has_linear_cells(scene) && settings.mode != Mode::cell_count),
        composites_(settings.mode == Mode::volume),
        left_(asked_.max_error) {
    plan_.settings = settings;
    plan_.settings.tolerance.reset();
  }

  Plan make() {
    if (asked_.max_error == 0) {
      take_reference();
    } else {
      plan_.reasons.push_back(fmt::format("tolerance {:g} in each channel", asked_.max_error));
      if (has_orders_) choose_precision();
      if (asked_.choose_integrator) choose_integrator();
      if (composites_) choose_early_termination();
      if (asked_.choose_order && has_orders_) choose_order();
    }
    if (is_to_be_measured()) measure_forced();
    plan_.error = asked_.max_error - left_;
    plan_.keeps = left_ >= 0;
    return std::move(plan_);
  }

 private:
  RenderSettings& settings() { return plan_.settings; }

  // What the pilot finds; twice its estimate where that may have missed something.
  PilotError look(Pilot& pilot, double enough = kInfinite) const {
    PilotError error = pilot.error_of(compared(), enough);
    if (has_narrow_spikes() && !error.all && error.found <= enough) error.estimate *= 2;
    return error;
  }

  bool has_narrow_spikes() const {
    const double range = static_cast<double>(scene_.field().high) - scene_.field().low;
    return has_optics(plan_.settings.mode) && scene_.classification().volume &&
           narrowest_spike(*scene_.classification().volume) < kNarrow * range;
  }

  std::string in_words(const PilotError& error) const {
    if (error.all) return fmt::format("all {} pixels compared with the reference", error.pixels);
    return fmt::format("by {} pixels compared with the reference, the worst of which has {:.1g}{}",
                       error.pixels, error.found,
                       has_narrow_spikes() ? ", doubled as extinction has narrow spikes" : "");
  }

  void take_reference() {
    const RenderSettings reference = reference_settings(settings());
    if (asked_.choose_order) {
      settings().order = reference.order;
      settings().scalar_tolerance = reference.scalar_tolerance;
    }
    if (asked_.choose_integrator) settings().integrator = reference.integrator;
    if (asked_.choose_early_termination) settings().early_termination = reference.early_termination;
    settings().scalar_twin = true;
    plan_.reasons.push_back("tolerance 0: the reference");
  }

  // Where render() would not take packets' numbers, candidates are not to be measured by packets,
  // either.
  void choose_precision() {
    if (settings().mode == Mode::volume) return;
    RenderSettings curved = settings();
    if (asked_.choose_order) curved.order = ScalarOrder::adaptive;
    if (mode_packet_error(scene_, curved) > asked_.max_error / 4) settings().scalar_twin = true;
  }

  void choose_integrator() {
    settings().integrator = {};
    if (!composites_) return;
    const double color = greatest_color(scene_);
    if (color * kScalarError > asked_.max_error / 4) {
      settings().integrator = reference_settings(settings(), asked_.max_error).integrator;
      settings().scalar_twin = true;
      plan_.reasons.push_back(
          fmt::format("integrator: the reference's, as the closed form's rounding may reach {:.1g}",
                      color * kScalarError));
      return;
    }
    const double by_packets =
        color * (is_classified(scene_, settings()) ? kClassifiedPacketError : kPacketError);
    settings().scalar_twin = settings().scalar_twin || by_packets > asked_.max_error / 4;
    const double error = settings().scalar_twin ? color * kScalarError : by_packets;
    left_ -= error;
    plan_.reasons.push_back(
        fmt::format("integrator: closed form, exact but for rounding: at most {:.1g}{}", error,
                    settings().scalar_twin ? ", ray by ray in double" : ""));
  }

  void choose_early_termination() {
    const double color = greatest_color(scene_);
    if (!asked_.choose_early_termination) {
      // A bound, where that is small enough; else it is measured, with all the rest.
      const double bound = color * settings().early_termination;
      measures_early_termination_ = bound > asked_.max_error / 2;
      if (measures_early_termination_) return;
      left_ -= bound;
      plan_.reasons.push_back(
          fmt::format("early termination: forced, at a transmittance of {:.2g}, a bound of {:.1g}",
                      settings().early_termination, bound));
      return;
    }
    const bool others = has_orders_ || !asked_.choose_integrator;
    const double share = asked_.max_error * (others ? 0.1 : 0.5);
    settings().early_termination = std::min(share / color, 0.5);
    left_ -= share;
    plan_.reasons.push_back(
        fmt::format("early termination: at a transmittance of {:.2g}, a bound of {:.1g}",
                    settings().early_termination, share));
  }

  // What is compared: early termination has a share of its own, as a rule.
  RenderSettings compared() const {
    RenderSettings settings = plan_.settings;
    if (!measures_early_termination_) settings.early_termination = 0;
    return settings;
  }

  // Whether packets make the picture at orders above 1.
  bool by_packets() const {
    RenderSettings curved = plan_.settings;
    curved.order = ScalarOrder::adaptive;
    const bool plain = !is_classified(scene_, curved) && curved.clip_planes.empty() &&
                       curved.channels.empty() && !curved.scalar_twin;
    const bool closed = !composites_ || curved.integrator.kind == IntegratorKind::closed_form;
    return plain && closed && has_packets(scene_) && has_packets_of_order(scene_, curved);
  }

  std::span<const Candidate> all_candidates() const {
    if (by_packets()) return kByPackets;
    return kRayByRay;
  }

  // What candidates are compared with. Packets' adaptive order takes a tenth of the reference's
  // time; its error is allowed for.
  RenderSettings to_compare_with() {
    RenderSettings reference = reference_settings(settings(), asked_.max_error);
    const double share = kShareOfReference * asked_.max_error;
    if (!by_packets() || greatest_color(scene_) * kPacketError > share) return reference;
    reference.integrator = {};
    reference.scalar_twin = false;
    reference.scalar_tolerance = std::max(reference.scalar_tolerance, 2e-6);
    left_ -= share;
    return reference;
  }

  // Candidates that make sense for this tolerance and mode, by their places in the list.
  std::vector<std::size_t> candidates(double finest) const {
    std::vector<std::size_t> list;
    const std::span<const Candidate> all = all_candidates();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].scalar_tolerance < finest) continue;
      const ScalarOrder order = all[i].order;
      // Whoever asks no optics sees no linear parts.
      const bool same = !list.empty() && all[list.back()].order == order &&
                        order != ScalarOrder::adaptive && !has_optics(plan_.settings.mode);
      if (!same) list.push_back(i);
    }
    return list;
  }

  void take(std::size_t candidate) {
    settings().order = all_candidates()[candidate].order;
    settings().scalar_tolerance = all_candidates()[candidate].scalar_tolerance;
  }

  // Chooses the order, and how closely its segments are followed.
  void choose_order() {
    if (is_of_one_place(settings().mode)) {
      settings().order = ScalarOrder::adaptive;
      settings().scalar_tolerance = std::clamp(0.1 * asked_.max_error, 1e-6, 1e-4);
      plan_.reasons.push_back(fmt::format(
          "order of the scalar: adaptive, to {:.1g} of the field's range, as the error of a "
          "pixel is that of one place, and samples do not find the worst",
          settings().scalar_tolerance));
      return;
    }
    const RenderSettings reference = to_compare_with();
    std::optional<Pilot> kept_pilot;
    if (before_ != nullptr && still_does(reference, kept_pilot)) return;
    if (!kept_pilot) kept_pilot.emplace(scene_, camera_, reference);
    Pilot& pilot = *kept_pilot;
    std::string tried;
    double cheaper = kInfinite;
    for (const std::size_t candidate : candidates(reference.scalar_tolerance)) {
      take(candidate);
      const PilotError error = look(pilot, left_);
      const char* name = name_of(settings().order);
      if (error.estimate <= left_) {
        plan_.order = ChosenOrder{candidate, error.estimate, error.found, cheaper};
        left_ -= error.estimate;
        plan_.reasons.push_back(fmt::format("order of the scalar: {}, at an error of {:.1g} ({}){}",
                                            name, error.estimate, in_words(error), tried));
        return;
      }
      cheaper = error.estimate;
      tried += fmt::format("{} order {} has {}{:.1g}", tried.empty() ? ";" : ",", name,
                           error.found > left_ ? "at least " : "", error.estimate);
    }
    const RenderSettings last = reference_settings(settings(), asked_.max_error);
    settings().order = last.order;
    settings().scalar_tolerance = last.scalar_tolerance;
    if (asked_.choose_integrator) {
      settings().integrator = last.integrator;
      settings().scalar_twin = true;
    }
    plan_.reasons.push_back(
        fmt::format("order of the scalar{}: the reference's, as nothing cheaper will do{}",
                    asked_.choose_integrator ? " and integrator" : "", tried));
  }

  // Whether what was chosen for another picture does for this one. Of another look nothing is known
  // but where to begin: all is looked at, and the pilot kept, should it not do.
  bool still_does(const RenderSettings& reference, std::optional<Pilot>& pilot) {
    if (before_->candidate >= all_candidates().size()) return false;
    take(before_->candidate);
    const bool other_look = before_->of_other_look;
    pilot.emplace(scene_, camera_, reference, other_look ? Pilot::Look::full : Pilot::Look::brief);
    const PilotError error = look(*pilot, left_);
    const double estimate =
        other_look ? error.estimate : std::max(before_->estimate, error.estimate);
    // Errors of orders rise and fall together, more or less: enough to tell what is worth a try.
    if (estimate > left_ || 2 * before_->cheaper * error.found < before_->found * left_) {
      if (!other_look) pilot.reset();
      return false;
    }
    if (other_look)
      plan_.order = ChosenOrder{before_->candidate, estimate, error.found,
                                before_->cheaper * (error.found / std::max(before_->found, 1e-30))};
    else
      plan_.order = ChosenOrder{before_->candidate, estimate, before_->found, before_->cheaper};
    left_ -= estimate;
    plan_.reasons.push_back(
        fmt::format("order of the scalar: {}, as for an earlier picture{}, at an error of {:.1g} "
                    "{} (here {:.1g}, {})",
                    name_of(settings().order), other_look ? " of another look" : "", estimate,
                    other_look ? "here" : "on all since then", error.estimate, in_words(error)));
    return true;
  }

  // Whether something was forced that no bound above speaks of.
  bool is_to_be_measured() const {
    if (plan_.order) return false;  // with all that was forced besides
    const bool order = has_orders_ && !asked_.choose_order;
    const bool integrator =
        composites_ && scene_.classification().volume && !asked_.choose_integrator;
    const bool end = composites_ && !asked_.choose_early_termination &&
                     (measures_early_termination_ || asked_.max_error == 0);
    return order || integrator || end;
  }

  void measure_forced() {
    if (asked_.max_error == 0) measures_early_termination_ = true;
    Pilot pilot(scene_, camera_, reference_settings(settings(), asked_.max_error));
    const PilotError error = look(pilot);
    left_ -= error.estimate;
    std::vector<std::string> forced;
    if (!asked_.choose_order && has_orders_) forced.emplace_back("the order");
    if (!asked_.choose_integrator && composites_) forced.emplace_back("the integrator");
    if (!asked_.choose_early_termination && composites_) forced.emplace_back("early termination");
    std::string names;
    for (std::size_t i = 0; i < forced.size(); ++i)
      names += (i == 0 ? "" : i + 1 == forced.size() ? " and " : ", ") + forced[i];
    plan_.reasons.push_back(fmt::format(
        "forced: {}, at an error of {:.1g} ({}){}{}", names, error.estimate, in_words(error),
        is_of_one_place(settings().mode) && !error.all
            ? "; in this mode samples do not find the worst"
            : "",
        left_ >= 0 ? "" : fmt::format("; THIS DOES NOT KEEP TO {:g}", asked_.max_error)));
  }

  const Scene& scene_;
  const Camera& camera_;
  const Tolerance asked_;
  const ChosenOrder* const before_;
  const bool has_orders_, composites_;
  bool measures_early_termination_ = false;
  double left_;  // of the tolerance
  Plan plan_;
};

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

Plan plan_for(const Scene& scene, const Camera& camera, const RenderSettings& settings,
              const ChosenOrder* before) {
  return Planner(scene, camera, settings, before).make();
}

}  // namespace plume
