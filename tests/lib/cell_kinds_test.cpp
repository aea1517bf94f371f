// One grid as cells of every kind: of a linear field, all make the same picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"

namespace plume::test {
namespace {

// The points of cell (i, j, k) of a grid in VTK's order of a hexahedron.
std::array<std::int64_t, 8> corners(const Mesh& grid, std::size_t cell) {
  const std::int64_t ni = grid.dimensions[0], nij = ni * grid.dimensions[1];
  const auto c = static_cast<std::int64_t>(cell);
  const std::int64_t ci = ni - 1, cj = grid.dimensions[1] - 1;
  const std::int64_t first = c % ci + ni * (c / ci % cj) + nij * (c / ci / cj);
  return {first,       first + 1,       first + 1 + ni,       first + ni,
          first + nij, first + 1 + nij, first + 1 + ni + nij, first + ni + nij};
}

Mesh with_cells_of(const Mesh& grid, Cells cells) {
  Mesh mesh;
  mesh.points = grid.points;
  mesh.cells = std::move(cells);
  std::copy_if(grid.fields.begin(), grid.fields.end(), std::back_inserter(mesh.fields),
               [](const Field& field) { return field.association == Association::point; });
  return mesh;
}

Array type_of_all(CellType type) {
  return Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(type)});
}

Mesh as_hexahedra(const Mesh& grid) {
  std::vector<std::int64_t> ids;
  for (std::size_t c = 0; c < grid.cell_count(); ++c)
    for (const std::int64_t id : corners(grid, c)) ids.push_back(id);
  Cells cells;
  cells.types = type_of_all(CellType::hexahedron);
  cells.connectivity = Array::own(std::move(ids));
  return with_cells_of(grid, std::move(cells));
}

Mesh as_polyhedra(const Mesh& grid) {
  constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<std::int64_t> offsets{0}, ids, locations, faces;
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const auto corner = corners(grid, c);
    ids.insert(ids.end(), corner.begin(), corner.end());
    offsets.push_back(static_cast<std::int64_t>(ids.size()));
    locations.push_back(static_cast<std::int64_t>(faces.size()));
    faces.push_back(6);
    for (const auto& face : kFaces) {
      faces.push_back(4);
      for (const int i : face) faces.push_back(corner[static_cast<std::size_t>(i)]);
    }
  }
  Cells cells;
  cells.types = type_of_all(CellType::polyhedron);
  cells.offsets = Array::own(std::move(offsets));
  cells.connectivity = Array::own(std::move(ids));
  cells.polyhedron_locations = Array::own(std::move(locations));
  cells.polyhedron_faces = Array::own(std::move(faces));
  return with_cells_of(grid, std::move(cells));
}

std::vector<float> picture(const Mesh& mesh, const RenderSettings& settings) {
  Scene scene(mesh, {{"linear", {}}});
  scene.set_transfer_function({{{0, {0, {0, 0, 1}}},
                                {1, {3, {0, 1, 0}}},
                                {2, {0.5f, {1, 1, 0}}},
                                {3.5f, {4, {1, 0, 0}}},
                                {6, {1, {1, 1, 1}}}}});
  const Camera camera = fitted_camera(scene.bounds(), {-0.6, 0.5, -0.62});
  const RenderResult result = render(scene, camera, settings);
  EXPECT_EQ(result.statistics.lost_rays, 0u);
  return result.image.rgba;
}

double difference(const std::vector<float>& a, const std::vector<float>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(a[i]) - b[i]));
  return worst;
}

// Jittered: the faces between hexahedra are twisted, where tetrahedra have two triangles.
void expect_one_picture(double jitter, const RenderSettings& settings) {
  const GenerateOptions options{8, jitter, 3};
  const Mesh grid = generate("box-hexahedra", options);
  const std::vector<float> expected = picture(grid, settings);
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.5f);
  const std::pair<const char*, Mesh> others[] = {
      {"hexahedra", as_hexahedra(grid)},
      {"polyhedra", as_polyhedra(grid)},
      {"tetrahedra", generate("box-tetrahedra", options)},
      {"wedges", generate("box-wedges", options)},
      {"mixed", generate("box-mixed", options)},
      {"honeycomb", generate("box-polyhedra", options)}};
  for (const auto& [name, mesh] : others)
    EXPECT_LE(difference(picture(mesh, settings), expected), 1e-5) << name;
  if (jitter == 0) {
    const Mesh regular = generate("box-rectilinear", options);
    EXPECT_LE(difference(picture(regular, settings), expected), 1e-5) << "rectilinear";
  }
}

TEST(CellsOfEveryKind, MakeOnePictureOfALinearField) {
  RenderSettings settings;
  settings.width = 71;
  settings.height = 53;
  settings.early_termination = 0;
  for (const double jitter : {0.0, 0.2})
    for (const bool twin : {false, true})
      for (const ScalarOrder order :
           {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic}) {
        SCOPED_TRACE(testing::Message() << "jitter " << jitter << ", order "
                                        << static_cast<int>(order) << (twin ? ", scalar" : ""));
        settings.scalar_twin = twin;
        settings.order = order;
        expect_one_picture(jitter, settings);
      }
}

}  // namespace
}  // namespace plume::test
