// A tolerance is kept to, and what a plan is made of.

#include "plume/lib/planner.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/lib/spikes.h"
#include "plume/mesh/error.h"

namespace plume::test {
namespace {

RenderSettings settings_of(Mode mode) {
  RenderSettings settings;
  settings.width = 64;
  settings.height = 45;
  settings.mode = mode;
  return settings;
}

std::string text_of(const std::vector<std::string>& plan) {
  std::string text;
  for (const std::string& line : plan) text += line + "\n";
  return text;
}

TEST(Planner, KeepsToTheToleranceInEveryMode) {
  for (const char* form : {"twisted", "box-tetrahedra", "box-mixed", "box-rectilinear"}) {
    const Scene scene(generate(form, {4, 0.3, 3}));
    const Camera camera = named_view("iso", scene.bounds());
    for (const ModeInWords& words : modes_in_words()) {
      SCOPED_TRACE(std::string(form) + ", " + words.name);
      RenderSettings settings = settings_of(words.mode);
      const RenderResult right = render(scene, camera, reference_settings(settings));
      const Image& reference = right.image;
      const double width = shade_width(right.statistics);
      for (const double asked : {1e-2, 1e-4}) {
        settings.tolerance = Tolerance{asked};
        const RenderResult result = render(scene, camera, settings);
        EXPECT_LE(greatest_difference(result.image, reference, words.mode, width), asked)
            << text_of(result.statistics.plan);
        EXPECT_EQ(result.statistics.plan.front().rfind("tolerance", 0), 0u);
      }
    }
  }
}

TEST(Planner, TakesTheCheapestOrderThatWillDo) {
  const Scene scene(generate("twisted", {6, 0.3, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  ScalarOrder before = ScalarOrder::linear;
  for (const double asked : {0.5, 1e-2, 1e-4, 1e-6}) {
    RenderSettings settings = settings_of(Mode::volume);
    settings.tolerance = Tolerance{asked};
    const Plan plan = plan_for(scene, camera, settings);
    EXPECT_FALSE(plan.settings.tolerance);
    EXPECT_GE(plan.settings.order, before) << text_of(plan.reasons);
    EXPECT_TRUE(plan.keeps);
    EXPECT_LE(plan.error, asked);
    before = plan.settings.order;
    if (asked == 1e-6) {
      EXPECT_EQ(plan.settings.integrator.kind, IntegratorKind::reference);
    }
    if (asked == 0.5) {
      EXPECT_EQ(plan.settings.order, ScalarOrder::linear) << text_of(plan.reasons);
      EXPECT_FALSE(plan.settings.scalar_twin);
    }
  }
  EXPECT_GT(before, ScalarOrder::linear);
}

TEST(Planner, LooksForNoOrderWhereCellsAreLinear) {
  const Scene scene(generate("box-tetrahedra", {4, 0.2, 1}));
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = settings_of(Mode::volume);
  settings.tolerance = Tolerance{1e-3};
  const Plan plan = plan_for(scene, camera, settings);
  EXPECT_EQ(plan.settings.order, ScalarOrder::linear);
  EXPECT_GT(plan.settings.early_termination, 1e-4);
  EXPECT_EQ(text_of(plan.reasons).find("order"), std::string::npos);
  // Half of a tolerance that packets' rounding would use up.
  settings.tolerance = Tolerance{1e-5};
  EXPECT_TRUE(plan_for(scene, camera, settings).settings.scalar_twin);
}

TEST(Planner, NoToleranceAtAllIsTheReference) {
  const Scene scene(generate("twisted", {4, 0.3, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = settings_of(Mode::volume);
  const Image reference = render(scene, camera, reference_settings(settings)).image;
  settings.tolerance = Tolerance{0};
  EXPECT_EQ(render(scene, camera, settings).image.rgba, reference.rgba);
}

TEST(Planner, LeavesWhatIsGiven) {
  const Scene scene(generate("twisted", {4, 0.3, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = settings_of(Mode::volume);
  settings.order = ScalarOrder::quadratic;
  settings.integrator = {IntegratorKind::midpoint, 3, {}};
  settings.early_termination = 0.03;
  for (const double asked : {0.0, 1e-4}) {
    settings.tolerance = Tolerance{asked, false, false, false};
    const RenderSettings plan = plan_for(scene, camera, settings).settings;
    EXPECT_EQ(plan.order, ScalarOrder::quadratic);
    EXPECT_EQ(plan.integrator.kind, IntegratorKind::midpoint);
    EXPECT_EQ(plan.integrator.samples, 3);
    EXPECT_EQ(plan.early_termination, 0.03);
  }
}

TEST(Planner, SaysTheErrorOfWhatIsForced) {
  const Scene twisted(generate("twisted", {6, 0.3, 3}));
  const Scene tetrahedra(generate("box-tetrahedra", {6, 0.3, 3}));
  struct Forced {
    const Scene* scene;
    Mode mode;
    ScalarOrder order;
    IntegratorSettings integrator;
    Tolerance tolerance;  // which of them are forced
  };
  const IntegratorSettings midpoint{IntegratorKind::midpoint, 1, {}, {}};
  const IntegratorSettings closed{};
  const ScalarOrder linear = ScalarOrder::linear;
  for (const Forced& forced :
       {Forced{&twisted, Mode::volume, linear, closed, {1e-3, false, true, true}},
        Forced{&twisted, Mode::integral, linear, closed, {1e-3, false, true, true}},
        Forced{&twisted, Mode::volume, linear, midpoint, {1e-3, true, false, true}},
        Forced{&twisted, Mode::volume, linear, midpoint, {1e-3, false, false, true}},
        Forced{&tetrahedra, Mode::volume, linear, midpoint, {1e-3, true, false, true}},
        Forced{&tetrahedra, Mode::volume, linear, closed, {1e-3, true, true, false}},
        Forced{&twisted, Mode::volume, ScalarOrder::adaptive, closed, {0.1, false, true, true}},
        Forced{&tetrahedra, Mode::volume, linear, closed, {1e-2, true, false, true}}}) {
    const Scene& scene = *forced.scene;
    const Camera camera = named_view("iso", scene.bounds());
    RenderSettings settings = settings_of(forced.mode);
    settings.width = 96;  // more than a pilot looks at
    settings.height = 72;
    settings.order = forced.order;
    settings.integrator = forced.integrator;
    settings.early_termination = 0.05;
    settings.tolerance = forced.tolerance;
    const RenderResult result = render(scene, camera, settings);
    const RenderResult right = render(scene, camera, reference_settings(settings));
    const double error =
        greatest_difference(result.image, right.image, forced.mode, shade_width(right.statistics));
    const double estimate = result.statistics.error_estimate.value();
    const double asked = forced.tolerance.max_error;
    SCOPED_TRACE(text_of(result.statistics.plan));
    EXPECT_EQ(result.statistics.keeps_tolerance, estimate <= asked);
    EXPECT_EQ(result.statistics.keeps_tolerance, error <= asked);
    EXPECT_LE(error, estimate);
    EXPECT_LE(estimate, 10 * error + asked);
    EXPECT_NE(text_of(result.statistics.plan).find("forced"), std::string::npos);
    EXPECT_EQ(text_of(result.statistics.plan).find("DOES NOT KEEP") == std::string::npos,
              error <= asked);
  }
}

// Narrow spikes, each as narrow as 1% of the field's range.
TransferFunction narrow_spikes(const Scene& scene, unsigned seed) {
  const auto& colors = scene.default_color_map().colors;
  const double low = colors.front().x, range = colors.back().x - low;
  TransferFunction made;
  std::uint32_t random = seed;
  auto next = [&] {
    random = 1664525 * random + 1013904223;
    return static_cast<float>(random >> 8) / static_cast<float>(1 << 24);
  };
  auto add = [&](double at, double depth) {
    made.knots.push_back(
        {static_cast<float>(low + range * at),
         {static_cast<float>(depth / scene.bounds().diagonal()), {next(), next(), next()}}});
  };
  add(0, 0);
  for (const double at : {0.2, 0.5, 0.8}) {
    const double middle = at + 0.1 * next();
    add(middle - 0.005, 0);
    add(middle, 200);
    add(middle + 0.005, 0);
  }
  add(1, 0);
  return made;
}

TEST(Planner, KnowsNarrowSpikes) {
  auto of = [](const std::vector<std::array<float, 2>>& knots) {
    TransferFunction made;
    for (const auto& [scalar, extinction] : knots) made.knots.push_back({scalar, {extinction, {}}});
    return narrowest_spike(made);
  };
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(of({{0, 1}}), never);
  EXPECT_EQ(of({{0, 1}, {1, 5}, {2, 5}}), never);
  EXPECT_EQ(of({{0, 5}, {1, 0}, {2, 4}}), never);                            // a valley
  EXPECT_EQ(of({{0, 0}, {1, 0}, {1.25f, 8}, {1.5f, 0}, {9, 0}}), 0.5);       // a spike
  EXPECT_EQ(of({{0, 0}, {2, 0}, {2, 8}, {2.25f, 8}, {2.25f, 0}}), 0.25);     // with steps
  EXPECT_EQ(of({{0, 0}, {1, 0}, {1.5f, 0.5f}, {2, 0}, {4, 8}, {8, 0}}), 6);  // one too low to count
}

TEST(Planner, IsNotFooledByNarrowSpikes) {
  Scene scene(generate("twisted", {12, 0.3, 3}));
  scene.set_transfer_function(narrow_spikes(scene, 1));
  const Camera camera = named_view("iso", scene.bounds());
  for (const Mode mode : {Mode::volume, Mode::optical_depth}) {
    RenderSettings settings = settings_of(mode);
    settings.width = settings.height = 96;
    const RenderResult right = render(scene, camera, reference_settings(settings, 1e-2));
    const double width = shade_width(right.statistics);
    for (const double asked : {0.3, 0.03}) {
      settings.tolerance = Tolerance{asked};
      const RenderResult result = render(scene, camera, settings);
      EXPECT_LE(greatest_difference(result.image, right.image, mode, width), asked)
          << text_of(result.statistics.plan);
    }
  }
}

TEST(Planner, RefusesTolerancesThatAreNone) {
  const Scene scene(generate("box-tetrahedra", {1, 0, 1}));
  const Camera camera = named_view("iso", scene.bounds());
  for (const double wrong : {-1e-3, 1.0, std::nan("")}) {
    RenderSettings settings = settings_of(Mode::volume);
    settings.tolerance = Tolerance{wrong};
    EXPECT_THROW(render(scene, camera, settings), Error) << wrong;
  }
  RenderSettings settings = settings_of(Mode::volume);
  settings.scalar_tolerance = 0;
  EXPECT_THROW(render(scene, camera, settings), Error);
}

TEST(Window, IsThatPartOfThePicture) {
  for (const char* form : {"box-tetrahedra", "twisted", "box-rectilinear"}) {
    const Scene scene(generate(form, {5, 0.3, 3}));
    const Camera camera = named_view("iso", scene.bounds());
    for (const Mode mode : {Mode::volume, Mode::maximum}) {
      RenderSettings settings = settings_of(mode);
      const Image whole = render(scene, camera, settings).image;
      settings.window = PixelWindow{11, 5, 37, 39};
      const Image part = render(scene, camera, settings).image;
      ASSERT_EQ(part.width, 37);
      ASSERT_EQ(part.height, 39);
      ASSERT_EQ(part.rgba.size(), 4u * 37 * 39);
      for (int y = 0; y < 39; ++y)
        for (int x = 0; x < 37; ++x)
          for (int c = 0; c < 4; ++c)
            ASSERT_EQ(part.pixel(x, y)[c], whole.pixel(x + 11, y + 5)[c]) << x << ", " << y;
    }
    RenderSettings settings = settings_of(Mode::volume);
    for (const PixelWindow wrong : {PixelWindow{-1, 0, 4, 4}, PixelWindow{0, 0, 65, 4},
                                    PixelWindow{60, 0, 5, 4}, PixelWindow{0, 0, 0, 4}}) {
      settings.window = wrong;
      EXPECT_THROW(render(scene, camera, settings), Error);
    }
  }
}

}  // namespace
}  // namespace plume::test
