// A rectilinear grid as a scene: the same pictures as the curvilinear grid of the same points.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/rectilinear_axes.h"

namespace plume::test {
namespace {

constexpr double kBound = 1e-5;  // linear RGBA, as for closed forms

enum class Axes { as_they_are, descending, uneven };

// Of a smooth field on points and one on cells, in a box of edges 1, 1 and 0.7.
Mesh grid(Axes axes, bool hidden = false) {
  Mesh mesh = generate("box-rectilinear", {9, axes == Axes::uneven ? 0.4 : 0.0, 5});
  for (std::size_t a = 0; a < 3; ++a) {
    auto axis = mesh.axes[a].visit(
        [](auto values) { return std::vector<double>(values.begin(), values.end()); });
    if (a == 2)
      for (double& z : axis) z *= 0.7;
    if (axes == Axes::descending && a != 1) std::reverse(axis.begin(), axis.end());
    mesh.axes[a] = Array::own(std::move(axis));
  }
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const auto [x, y, z] = point_at(mesh, p);
    values.push_back(static_cast<float>(std::sin(4 * x) * std::cos(3 * y) + x * z));
  }
  mesh.fields[0].values = Array::own(std::move(values));
  if (hidden) {
    std::mt19937 random(3);
    std::vector<std::uint8_t> cells(mesh.cell_count());
    for (auto& cell : cells) cell = random() % 4 == 0 ? 1 : 0;
    mesh.hidden_cells = Array::own(std::move(cells));
  }
  return mesh;
}

struct Pair {
  Scene ours, theirs;
  Camera camera;
  RenderSettings settings;

  explicit Pair(const Mesh& mesh, const std::string& field = "linear")
      : ours(mesh, {{field, {}}, true}), theirs(with_points(mesh), {{field, {}}, true}) {
    camera = fitted_camera(ours.bounds(), {-0.62, 0.45, -0.64});
    settings.width = 72;
    settings.height = 56;
    const float low = ours.field().low, high = ours.field().high;
    const TransferFunction bumpy{{{low, {0.2f, {0, 0, 1}}},
                                  {0.6f * low + 0.4f * high, {4, {0, 1, 0}}},
                                  {0.3f * low + 0.7f * high, {0.5f, {1, 1, 0}}},
                                  {high, {3, {1, 0, 0}}}}};
    ours.set_transfer_function(bumpy);
    theirs.set_transfer_function(bumpy);
  }

  void expect_same(const std::string& which) const {
    const RenderResult a = render(ours, camera, settings), b = render(theirs, camera, settings);
    EXPECT_EQ(a.statistics.lost_rays, 0u) << which;
    EXPECT_GT(a.statistics.rays_hit, 500u) << which;
    for (std::size_t i = 0; i < a.image.rgba.size(); ++i)
      ASSERT_NEAR(a.image.rgba[i], b.image.rgba[i], kBound) << which << " pixel " << i / 4;
    ASSERT_EQ(a.image.channels.size(), b.image.channels.size());
    for (std::size_t c = 0; c < a.image.channels.size(); ++c) {
      const Channel &mine = a.image.channels[c], &other = b.image.channels[c];
      ASSERT_EQ(mine.name, other.name);
      std::size_t differ = 0;
      const bool counts = mine.name == "cell_id" || mine.name == "cell_count";
      for (std::size_t i = 0; i < mine.values.size(); ++i) {
        const float x = mine.values[i], y = other.values[i];
        if (x == y || (std::isnan(x) && std::isnan(y))) continue;
        if (counts)
          ++differ;
        else
          ASSERT_NEAR(x, y, kBound) << which << ' ' << mine.name << " pixel " << i;
      }
      // Rounding moves a ray across an edge of the grid here and there.
      EXPECT_LE(differ, mine.values.size() / 200) << which << ' ' << mine.name;
    }
  }
};

TEST(RectilinearScene, LooksAsTheCurvilinearGridInEveryMode) {
  for (const Axes axes : {Axes::as_they_are, Axes::descending, Axes::uneven}) {
    Pair pair(grid(axes));
    for (const Mode mode : {Mode::volume, Mode::maximum, Mode::integral, Mode::depth}) {
      pair.settings.mode = mode;
      pair.settings.channels.clear();
      pair.expect_same("mode " + std::to_string(static_cast<int>(mode)));
      if (HasFatalFailure()) return;
      pair.settings.channels = {"depth", "optical_depth", "cell_id", "cell_count"};
      pair.expect_same("channels, mode " + std::to_string(static_cast<int>(mode)));
      if (HasFatalFailure()) return;
    }
    pair.settings = {};
    pair.settings.width = pair.settings.height = 48;
    for (const auto kind :
         {IntegratorKind::midpoint, IntegratorKind::table, IntegratorKind::closed_form}) {
      pair.settings.integrator.kind = kind;
      pair.expect_same("integrator " + std::to_string(static_cast<int>(kind)));
    }
  }
}

TEST(RectilinearScene, LooksTheSameFromInside) {
  Pair pair(grid(Axes::uneven));
  pair.camera.position = {0.41, 0.52, 0.31};
  pair.camera.focal_point = {1, 0.7, 0.2};
  pair.camera.view_angle = 80;
  pair.expect_same("inside");
}

TEST(RectilinearScene, LooksTheSameWithHiddenCellsAndCellData) {
  for (const char* field : {"linear", "cell_radius"}) {
    const Pair pair(grid(Axes::uneven, true), field);
    pair.expect_same(field);
    EXPECT_EQ(pair.ours.connected_part_count(), pair.theirs.connected_part_count());
    EXPECT_EQ(pair.ours.boundary_face_count(), pair.theirs.boundary_face_count());
  }
}

TEST(RectilinearScene, SaysWhatItIs) {
  const Pair pair(grid(Axes::uneven, true));
  EXPECT_STREQ(pair.ours.form(), "rectilinear grid");
  EXPECT_STREQ(pair.theirs.form(), "grid");
  EXPECT_EQ(pair.ours.cell_count(), 729u);
  EXPECT_EQ(pair.ours.point_count(), 1000u);
  EXPECT_EQ(pair.ours.bytes(), 4u * 1000 + 16 * 27 + 3 * 8 + (729 + 7) / 8);
  EXPECT_EQ(pair.ours.bounds().high, (std::array<double, 3>{1, 1, 0.7}));
  ASSERT_EQ(pair.ours.findings().size(), pair.theirs.findings().size());
  for (std::size_t i = 0; i < pair.ours.findings().size(); ++i)
    EXPECT_EQ(describe(pair.ours.findings()[i]), describe(pair.theirs.findings()[i]));
  const auto plan = render(pair.ours, pair.camera, pair.settings).statistics.plan;
  EXPECT_NE(plan.at(0).find("rectilinear grid"), std::string::npos);
}

TEST(RectilinearScene, FitsItsFirstPictureAsTheCurvilinearGridDoes) {
  const Mesh mesh = grid(Axes::as_they_are);
  const Scene ours(mesh), theirs(with_points(mesh));
  EXPECT_NEAR(ours.default_unit_distance(), theirs.default_unit_distance(),
              1e-5 * theirs.default_unit_distance());
  const Camera camera = named_view("iso", ours.bounds());
  RenderSettings settings;
  settings.width = settings.height = 64;
  const Image a = render(ours, camera, settings).image, b = render(theirs, camera, settings).image;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) ASSERT_NEAR(a.rgba[i], b.rgba[i], 1e-4) << i;
}

TEST(RectilinearScene, ScaledAndMovedLooksTheSame) {
  const Mesh mesh = grid(Axes::uneven);
  auto picture = [&](double scale, double offset) {
    Mesh moved = mesh;
    for (Array& axis : moved.axes) {
      std::vector<double> values(axis.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = axis.at<double>(i) * scale + offset;
      axis = Array::own(std::move(values));
    }
    const Scene scene(moved, {{"linear", {}}, false});
    RenderSettings settings;
    settings.width = settings.height = 48;
    return render(scene, named_view("iso", scene.bounds()), settings).image;
  };
  const Image plain = picture(1, 0);
  for (const auto& [scale, offset] :
       {std::pair{1e-9, 0.0}, {1e-6, 0.0}, {1e6, 0.0}, {1e9, 1e9}, {1.0, 1e7}}) {
    const Image other = picture(scale, offset);
    for (std::size_t i = 0; i < plain.rgba.size(); ++i)
      ASSERT_NEAR(plain.rgba[i], other.rgba[i], 1e-4) << scale << ' ' << offset << ' ' << i;
  }
}

}  // namespace
}  // namespace plume::test
