// Volumes and intervals past the cells in which nothing is to be seen: the walker's pictures, bit
// for bit.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/plume.h"
#include "plume/lib/search_choice.h"
#include "plume/lib/tiles.h"
#include "plume/preint/integrator.h"
#include "searched_picture.h"

namespace plume::test {
namespace {

RenderSettings small() {
  RenderSettings settings;
  settings.width = 64;
  settings.height = 56;
  return settings;
}

RenderStatistics expect_same(const Scene& scene, const Camera& camera, RenderSettings settings,
                             const std::string& which) {
  EXPECT_EQ(cannot_search(scene, settings), std::nullopt) << which;
  const RenderResult searched = search(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult walked = render(scene, camera, settings);
  EXPECT_TRUE(same(searched.image.rgba, walked.image.rgba)) << which;
  EXPECT_EQ(searched.image.channels.size(), walked.image.channels.size()) << which;
  for (std::size_t c = 0; c < walked.image.channels.size(); ++c)
    EXPECT_TRUE(same(searched.image.channels[c].values, walked.image.channels[c].values))
        << which << ", " << walked.image.channels[c].name;
  EXPECT_EQ(searched.statistics.surfaces, walked.statistics.surfaces) << which;
  EXPECT_EQ(searched.statistics.visits, walked.statistics.visits) << which;
  EXPECT_EQ(searched.statistics.rays_hit, walked.statistics.rays_hit) << which;
  EXPECT_EQ(searched.statistics.lost_rays, 0u) << which;
  return searched.statistics;
}

// Values between the least and the greatest.
float at(const Scene& scene, float share) {
  return scene.field().low + share * (scene.field().high - scene.field().low);
}

Classification volume(const Scene& scene,
                      const std::vector<std::pair<float, float>>& extinction_at_share) {
  Classification classification;
  classification.volume.emplace();
  float red = 0;
  for (const auto& [share, extinction] : extinction_at_share) {
    red = 1 - red;
    classification.volume->knots.push_back({at(scene, share), {extinction, {red, 0.5f, 1 - red}}});
  }
  return classification;
}

struct Look {
  const char* name;
  Classification shown;
};

// Narrow, empty at the ends or in the middle, with steps, so dense that rays end in it; and with
// what else there may be.
std::vector<Look> looks(const Scene& scene) {
  std::vector<Look> all{
      {"narrow", volume(scene, {{0.45f, 0}, {0.5f, 40}, {0.55f, 0}})},
      {"ends", volume(scene, {{0.2f, 3}, {0.25f, 0}, {0.75f, 0}, {0.8f, 5}})},
      {"steps", volume(scene, {{0.3f, 0}, {0.3f, 4}, {0.4f, 4}, {0.4f, 0}, {0.7f, 0}, {0.7f, 2}})},
      {"dense", volume(scene, {{0.55f, 0}, {0.6f, 3000}, {0.65f, 0}, {0.8f, 0}, {0.9f, 1}})}};
  Classification intervals;
  intervals.intervals = {{at(scene, 0.3f), at(scene, 0.34f), even_profile(0.5f, {1, 0, 0})},
                         {at(scene, 0.6f), at(scene, 0.7f), even_profile(0.7f, {0, 1, 0})}};
  all.push_back({"intervals", intervals});
  Classification together = volume(scene, {{0.3f, 0}, {0.4f, 20}, {0.5f, 0}});
  together.intervals = intervals.intervals;
  together.isosurfaces = {{at(scene, 0.42f), 0.3f, {0, 0, 1}}, {at(scene, 0.8f), 1, {1, 1, 1}}};
  all.push_back({"together", together});
  return all;
}

struct Case {
  const char* name;
  int size;
  double jitter, least_searched;  // a share of the rays
};

void expect_all_same(const Case& c) {
  SceneOptions lit;
  lit.keep_gradients = true;
  Scene scene(generate(c.name, {c.size, c.jitter, 3}), lit);
  for (const Look& look : looks(scene)) {
    scene.set_classification(look.shown);
    for (const char* view : {"iso", "+x"})
      for (const Mode mode : {Mode::volume, Mode::depth}) {
        Camera camera = named_view(view, scene.bounds());
        camera.parallel = mode == Mode::volume;
        RenderSettings settings = small();
        settings.mode = mode;
        if (mode == Mode::volume) settings.channels = {"depth", "cell_id"};
        if (!scene.classification().is_plain_volume()) settings.lighting.emplace();
        const std::string which = std::string(c.name) + ", " + look.name + ", " + view;
        const RenderStatistics statistics = expect_same(scene, camera, settings, which);
        EXPECT_GE(static_cast<double>(statistics.rays_searched),
                  c.least_searched * static_cast<double>(statistics.rays))
            << which;
      }
  }
}

TEST(SearchedVolumes, OfTetrahedraAreTheWalkers) {
  for (const Case& c : {Case{"box-tetrahedra", 12, 0.2, 0.9}, Case{"box-tetrahedra", 8, 0, 0},
                        Case{"ball-tetrahedra", 6, 0.1, 0.9}, Case{"box-tetrahedra", 8, 0.6, 0},
                        Case{"box-tetrahedra", 6, 3, 0}})
    expect_all_same(c);
}

TEST(SearchedVolumes, OfOtherCellsAreTheWalkers) {
  for (const Case& c : {Case{"twisted", 8, 0.4, 0.9}, Case{"box-hexahedra", 8, 0.2, 0.9},
                        Case{"box-hexahedra", 6, 3, 0}, Case{"box-hexahedra", 6, 0, 0},
                        Case{"box-mixed", 6, 0.2, 0.9}, Case{"box-mixed", 5, 2, 0},
                        Case{"box-polyhedra", 4, 0.2, 0.9}, Case{"box-wedges", 6, 0.2, 0.9},
                        Case{"o-grid", 8, 0.2, 0.5}, Case{"two-blocks", 5, 0.2, 0.3}})
    expect_all_same(c);
}

// Of integrators, with and without early termination, along grid lines and from inside.
TEST(SearchedVolumes, AreTheWalkersWhateverTheSettings) {
  for (const char* name : {"box-tetrahedra", "box-hexahedra"}) {
    Scene scene(generate(name, {10, 0.1, 3}));
    for (const IntegratorKind kind :
         {IntegratorKind::closed_form, IntegratorKind::midpoint, IntegratorKind::reference})
      for (const double early_termination : {0.0, 1e-3, 0.3})
        for (const Look& look : looks(scene)) {
          scene.set_classification(look.shown);
          RenderSettings settings = small();
          settings.width = settings.height = 24;
          settings.integrator.kind = kind;
          settings.early_termination = early_termination;
          Camera camera = named_view("iso", scene.bounds());
          expect_same(scene, camera, settings, look.name);
          camera.position = scene.bounds().center();
          camera.focal_point = scene.bounds().high;
          expect_same(scene, camera, settings, look.name);
        }
  }
}

// Where a table's entries blur what is empty, what is skipped would be seen.
TEST(SearchedVolumes, OfTablesAreWalked) {
  Scene scene(generate("box-tetrahedra", {10, 0.2, 3}));
  scene.set_classification(looks(scene)[0].shown);
  RenderSettings settings = small();
  settings.integrator.kind = IntegratorKind::table;
  EXPECT_TRUE(cannot_search(scene, settings));
}

bool says(const RenderStatistics& statistics, const std::string& words) {
  for (const std::string& line : statistics.plan)
    if (line.find(words) != std::string::npos) return true;
  return false;
}

// By counts of cells that may be seen; the hierarchy stays when the transfer function changes.
TEST(SearchedVolumes, AreMadeWhereLittleIsToBeSeen) {
  Scene scene(generate("box-tetrahedra", {24, 0.2, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  auto with = [&](const Classification& classification) {
    scene.set_classification(classification);
    return render(scene, camera, small()).statistics;
  };
  EXPECT_EQ(with(volume(scene, {{0, 1}, {1, 2}})).rays_searched, 0u);
  RenderStatistics statistics = with(volume(scene, {{0.3f, 0}, {0.4f, 2}}));
  EXPECT_EQ(statistics.rays_searched, 0u);
  EXPECT_FALSE(statistics.hierarchy_made);
  EXPECT_TRUE(says(statistics, "too much for it to pay"));
  int made = 0;
  for (const float share : {0.995f, 0.99f, 0.9975f}) {
    statistics = with(volume(scene, {{share, 0}, {share + 0.001f, 9}, {share + 0.002f, 0}}));
    EXPECT_GT(statistics.rays_searched, statistics.rays * 9 / 10);
    EXPECT_TRUE(says(statistics, "of the cells may be seen"));
    made += statistics.hierarchy_made ? 1 : 0;
    EXPECT_GT(expect_same(scene, camera, small(), "changed").rays_searched, 0u);
  }
  EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace plume::test
