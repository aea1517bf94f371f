// A plan is kept while nothing that it depends on changes, and looked at again where the view does.

#include "plume/lib/kept_plans.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/scene_body.h"

namespace plume::test {
namespace {

enum class Way { anew, checked, kept };

// How the plan was come by; with it, whether the picture is the one of that plan.
Way way_of(const RenderResult& result) {
  bool looked = false, kept = false, checked = false;
  for (const std::string& line : result.statistics.plan) {
    looked = looked || line.rfind("order of the scalar", 0) == 0;
    kept = kept || line.find("of which nothing has changed") != std::string::npos;
    checked = checked || line.find("as for an earlier picture") != std::string::npos;
  }
  EXPECT_TRUE(looked);
  return kept ? Way::kept : checked ? Way::checked : Way::anew;
}

SceneOptions keep_field() {
  SceneOptions options;
  options.keep_field_order = true;
  return options;
}

struct Shown {
  Mesh mesh = generate("twisted", {5, 0.3, 3});
  Scene scene{mesh, keep_field()};
  Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = [] {
    RenderSettings made;
    made.width = 80;
    made.height = 60;
    made.tolerance = Tolerance{4e-2};
    return made;
  }();

  RenderResult picture() const { return render(scene, camera, settings); }
};

TEST(KeptPlans, AreTakenAsTheyAreWhereNothingChanges) {
  Shown shown;
  const RenderResult first = shown.picture();
  EXPECT_EQ(way_of(first), Way::anew);
  // Of these it does not depend on any.
  const std::function<void()> changes[] = {
      [] {}, [&] { shown.settings.threads = 1; },
      [&] { shown.scene.set_transfer_function(shown.scene.transfer_function()); },
      [&] { shown.settings.channels = {"depth"}; },
      [&] {
        shown.settings.window = PixelWindow{0, 0, 30, 20};
      }};
  for (const auto& change : changes) {
    change();
    const RenderResult again = shown.picture();
    EXPECT_EQ(way_of(again), Way::kept);
    EXPECT_EQ(again.statistics.order, first.statistics.order);
    EXPECT_EQ(again.statistics.error_estimate, first.statistics.error_estimate);
    EXPECT_EQ(again.image.rgba.size(), 4 * again.statistics.rays);
  }
  EXPECT_EQ(shown.settings.window->width, 30);
}

TEST(KeptPlans, AreThePlansThatWouldBeMade) {
  Shown shown;
  const RenderResult first = shown.picture();
  const RenderResult kept = shown.picture();
  shown.settings.tolerance->keep_plans = false;
  const RenderResult anew = shown.picture();
  EXPECT_EQ(way_of(kept), Way::kept);
  EXPECT_EQ(way_of(anew), Way::anew);
  EXPECT_EQ(kept.image.rgba, first.image.rgba);
  EXPECT_EQ(anew.image.rgba, first.image.rgba);
}

TEST(KeptPlans, AreLookedAtAgainWhereTheViewOrTheValuesChange) {
  Shown shown;
  EXPECT_EQ(way_of(shown.picture()), Way::anew);
  const std::function<void()> changes[] = {
      [&] { orbit(shown.camera, 5, 0); },
      [&] { shown.settings.width = 90; },
      [&] { shown.settings.depth_limit.assign(90 * 60, 1e9f); },
      [&] { shown.scene.set_field(shown.mesh); },
      [&] {
        shown.scene.add_surface(
            {{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {{{0, 1, 2}}}, {1, 1, 1}, {}, {}});
      },
      [&] { shown.scene.remove_surfaces(); }};
  double estimate = 0;
  for (const auto& change : changes) {
    change();
    const RenderResult result = shown.picture();
    EXPECT_EQ(way_of(result), Way::checked);
    EXPECT_GE(*result.statistics.error_estimate, estimate);  // over all that were looked at
    EXPECT_LE(*result.statistics.error_estimate, shown.settings.tolerance->max_error);
    estimate = *result.statistics.error_estimate;
    EXPECT_EQ(way_of(shown.picture()), Way::kept);
  }
}

// The last order is tried first, on all pixels that a plan made anew looks at.
TEST(KeptPlans, BeginWithTheLastOrderForAnotherTransferFunction) {
  Shown shown;
  const RenderResult first = shown.picture();
  TransferFunction other = shown.scene.transfer_function();
  other.knots[3].optics.extinction *= 1.01f;
  shown.scene.set_transfer_function(other);
  const RenderResult result = shown.picture();
  EXPECT_EQ(way_of(result), Way::checked);
  EXPECT_EQ(result.statistics.order, first.statistics.order);
  const RenderResult right = render(shown.scene, shown.camera, reference_settings(shown.settings));
  EXPECT_LE(greatest_difference(result.image, right.image, Mode::volume, 0),
            shown.settings.tolerance->max_error);
}

TEST(KeptPlans, AreMadeAnewForAnotherLookOrTolerance) {
  Shown shown;
  EXPECT_EQ(way_of(shown.picture()), Way::anew);
  const std::function<void()> changes[] = {
      [&] {
        Classification other = shown.scene.classification();
        other.isosurfaces.push_back({shown.scene.transfer_function().knots[50].scalar, 0.5f, {}});
        shown.scene.set_classification(other);
      },
      [&] { shown.settings.tolerance->max_error = 3.1e-2; },
      [&] { shown.settings.mode = Mode::integral; },
      [&] {
        const Bounds& bounds = shown.scene.bounds();
        shown.settings.clip_planes = {{bounds.low, {1, 1, 1}}};
      }};
  for (const auto& change : changes) {
    change();
    EXPECT_EQ(way_of(shown.picture()), Way::anew);
  }
}

TEST(KeptPlans, OfSeveralViewsInTurnsStay) {
  Shown shown;
  const char* views[] = {"+x", "+y", "+z", "iso"};
  for (int round = 0; round < 3; ++round)
    for (const char* view : views) {
      shown.camera = named_view(view, shown.scene.bounds());
      const Way way = way_of(shown.picture());
      if (round > 0) {
        EXPECT_EQ(way, Way::kept) << view;
      }
    }
}

// An order that does for one field is not kept for another that bends more.
TEST(KeptPlans, AreGivenUpWhereTheyDoNotDo) {
  Shown shown;
  std::vector<float> smooth, rough;
  const std::size_t points = shown.mesh.point_count();
  for (std::size_t i = 0; i < points; ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(points);
    smooth.push_back(static_cast<float>(along));
    rough.push_back(static_cast<float>(along + 0.2 * (i % 2 == 0 ? 1 : -1)));
  }
  auto show = [&](const std::vector<float>& values) {
    shown.mesh.fields.clear();
    shown.mesh.fields.push_back({"values", Association::point, 1, Array::own(values)});
  };
  show(smooth);
  shown.scene = Scene(shown.mesh, keep_field());
  const ScalarOrder order = shown.picture().statistics.order;
  show(rough);
  shown.scene.set_field(shown.mesh);
  const RenderResult result = shown.picture();
  EXPECT_EQ(way_of(result), Way::anew);
  EXPECT_GE(result.statistics.order, order);
  const RenderResult right = render(shown.scene, shown.camera, reference_settings(shown.settings));
  EXPECT_LE(greatest_difference(result.image, right.image, Mode::volume, 0),
            shown.settings.tolerance->max_error);
}

}  // namespace
}  // namespace plume::test
