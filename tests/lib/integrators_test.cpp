// Integrators in pictures: tables are built once, quadratics are taken whole, and what is wrong is
// said.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/scene_body.h"
#include "plume/mesh/error.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::test {
namespace {

// Hexahedra, few enough for the scalar to bend within them.
Mesh hexahedra() {
  Mesh mesh = generate("box-hexahedra", {4, 0.2, 3});
  std::vector<double> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const auto at = point_at(mesh, p);
    values.push_back(0.5 + 0.5 * std::sin(5 * at[0] + 2) * std::cos(4 * at[1] - 5 * at[2]));
  }
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

TransferFunction colors() {
  return {{{0.0f, {1, {1, 0, 0}}},
           {0.3f, {0, {0, 1, 1}}},
           {0.6f, {6, {0, 1, 0}}},
           {1.0f, {2, {1, 1, 0}}}}};
}

RenderSettings settings_of(IntegratorKind kind, ScalarOrder order) {
  RenderSettings settings;
  settings.width = settings.height = 32;
  settings.early_termination = 0;
  settings.order = order;
  settings.integrator.kind = kind;
  settings.integrator.table = {32, 8};
  settings.integrator.second_order_table = {24, 12, std::array{0.0f, 1.0f},
                                            std::array{0.002f, 1.0f}};
  return settings;
}

struct Difference {
  float largest = 0;
  double rms = 0;
};

Difference difference(const Image& a, const Image& b) {
  Difference result;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const float off = std::abs(a.rgba[i] - b.rgba[i]);
    result.largest = std::max(result.largest, off);
    result.rms += static_cast<double>(off) * static_cast<double>(off);
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(a.rgba.size()));
  return result;
}

TEST(Integrators, TakeQuadraticsAndCubicsWhole) {
  Scene scene(hexahedra());
  scene.set_transfer_function(colors());
  const Camera camera = named_view("iso", scene.bounds());
  auto picture = [&](IntegratorKind kind, ScalarOrder order) {
    return render(scene, camera, settings_of(kind, order)).image;
  };
  for (const ScalarOrder order : {ScalarOrder::quadratic, ScalarOrder::cubic}) {
    const Image reference = picture(IntegratorKind::reference, order);
    const Image linear = picture(IntegratorKind::reference, ScalarOrder::linear);
    // There is something to see, and the order matters.
    ASSERT_GT(difference(reference, linear).largest, 0.05f);
    // The closed form sees parts that are linear within 1e-4 of the field's range, of which the
    // steepest optics make 3e-3 (20 a unit of the scalar, over 1.7 of length) at the most.
    EXPECT_LT(difference(picture(IntegratorKind::closed_form, order), reference).largest, 3e-3f);
    // The table's own error, for some ten cells along a ray.
    const Difference by_table =
        difference(picture(IntegratorKind::second_order_table, order), reference);
    EXPECT_LT(by_table.rms, 5e-3);
    EXPECT_LT(by_table.largest, 0.05f);
    EXPECT_GT(by_table.largest, 1e-5f);  // or something else made the picture
  }
  // Linear segments are the closed form's, and no table is built for them.
  EXPECT_LT(difference(picture(IntegratorKind::second_order_table, ScalarOrder::linear),
                       picture(IntegratorKind::reference, ScalarOrder::linear))
                .largest,
            2e-6f);
  const auto plan =
      render(scene, camera, settings_of(IntegratorKind::second_order_table, ScalarOrder::linear))
          .statistics.plan;
  EXPECT_EQ(std::count(plan.begin(), plan.end(), "integrator: closed form (4 knots)"), 1);
}

TEST(Integrators, AFrameWithoutANewTransferFunctionBuildsNoTable) {
  Scene scene(hexahedra());
  scene.set_transfer_function(colors());
  const Camera camera = named_view("iso", scene.bounds());
  const RenderSettings settings = settings_of(IntegratorKind::table, ScalarOrder::linear);
  auto kept = [&] {
    return scene.body().integrators.get(scene.transfer_function(), settings.integrator).get();
  };
  const RenderResult first = render(scene, camera, settings);
  const Integrator* const table = kept();
  const RenderResult second = render(scene, camera, settings);
  EXPECT_EQ(kept(), table);
  // The time to build is the same because it is the same table.
  auto line = [](const RenderResult& result) {
    const auto& plan = result.statistics.plan;
    const auto found = std::find_if(plan.begin(), plan.end(), [](const std::string& text) {
      return text.rfind("table: 0.1 MB, built in ", 0) == 0;
    });
    return found == plan.end() ? std::string("none") : *found;
  };
  EXPECT_EQ(line(first), line(second));
  EXPECT_NE(line(first), "none");

  // Nor does a frame from elsewhere, of another size, mode, order, light or field.
  const std::size_t built = scene.body().integrators.built();
  Camera elsewhere = camera;
  orbit(elsewhere, 40, 10);
  RenderSettings others = settings;
  others.width = 30;
  render(scene, elsewhere, others);
  others.order = ScalarOrder::cubic;
  render(scene, elsewhere, others);
  others.mode = Mode::integral;
  render(scene, elsewhere, others);
  EXPECT_EQ(scene.body().integrators.built(), built);
  EXPECT_EQ(built, 1u);

  // A new one has its own table, at once: the picture is that of a new scene.
  TransferFunction other = colors();
  other.knots[2].optics.color = {0, 0, 1};
  scene.set_transfer_function(other);
  const RenderResult changed = render(scene, camera, settings);
  EXPECT_GT(difference(changed.image, first.image).largest, 0.1f);
  Scene fresh(hexahedra());
  fresh.set_transfer_function(other);
  EXPECT_EQ(render(fresh, camera, settings).image.rgba, changed.image.rgba);
  // And back to the first, whose table is still there.
  scene.set_transfer_function(colors());
  EXPECT_EQ(render(scene, camera, settings).image.rgba, first.image.rgba);
  EXPECT_EQ(scene.body().integrators.built(), 2u);
}

TEST(Integrators, SayWhatIsWrongWithTheirSettings) {
  Scene scene(hexahedra());
  const Camera camera = named_view("iso", scene.bounds());
  auto message = [&](const RenderSettings& settings) -> std::string {
    try {
      render(scene, camera, settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  RenderSettings settings = settings_of(IntegratorKind::table, ScalarOrder::linear);
  settings.integrator.table.scalar_count = 1;
  EXPECT_EQ(message(settings), "a table of 1 scalars and 8 lengths: at least 2 of each");
  settings = settings_of(IntegratorKind::second_order_table, ScalarOrder::quadratic);
  settings.integrator.second_order_table.length_range = std::array{1.0f, 0.5f};
  EXPECT_EQ(message(settings),
            "a table of lengths from 1 to 0.5: both must be finite, above 0, and ascend");
  settings = settings_of(IntegratorKind::reference, ScalarOrder::linear);
  settings.integrator.tolerance = -1;
  EXPECT_EQ(message(settings), "a reference to a tolerance of -1: it must be 1e-13 to 1");
}

TEST(Integrators, BadTransferFunctionsNameTheKnot) {
  Scene scene(hexahedra());
  const TransferFunction before = scene.transfer_function();
  auto message = [&](TransferFunction function) -> std::string {
    try {
      scene.set_transfer_function(std::move(function));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message({}), "transfer function: a transfer function needs at least one knot");
  EXPECT_EQ(message({{{0, {1, {}}}, {1, {infinity, {}}}}}),
            "transfer function: knot 1 (scalar 1): the extinction is inf, but must be finite and "
            "not negative");
  EXPECT_EQ(message({{{0, {-2, {}}}}}),
            "transfer function: knot 0 (scalar 0): the extinction is -2, but must be finite and "
            "not negative");
  EXPECT_EQ(message({{{0, {}}, {0, {}}, {0, {}}}}),
            "transfer function: knot 2 (scalar 0): the scalar of the two knots before it is 0 as "
            "well, but a step has two knots");
  EXPECT_EQ(scene.transfer_function(), before);
  // A step is allowed, and exact by every integrator that is: below 0.5 nothing, from there on red.
  ASSERT_EQ(message({{{0.5f, {0, {}}}, {0.5f, {3, {1, 0, 0}}}}}), "");
  const Camera camera = named_view("iso", scene.bounds());
  const Image closed_form =
      render(scene, camera, settings_of(IntegratorKind::closed_form, ScalarOrder::linear)).image;
  const Image reference =
      render(scene, camera, settings_of(IntegratorKind::reference, ScalarOrder::linear)).image;
  EXPECT_GT(*std::max_element(reference.rgba.begin(), reference.rgba.end()), 0.5f);
  EXPECT_LT(difference(closed_form, reference).rms, 1e-6);
}

}  // namespace
}  // namespace plume::test
