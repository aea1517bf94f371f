// From what a user has to what a walker needs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "plume/datasets/generate.h"
#include "plume/mesh/closed_cell.h"
#include "plume/mesh/connected_parts.h"
#include "plume/mesh/error.h"
#include "plume/mesh/validate.h"
#include "test_meshes.h"

namespace plume::test {
namespace {

WalkableTets tets_of(const Mesh& mesh) {
  return make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), true);
}
WalkableCells cells_of(const Mesh& mesh) {
  return make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), true);
}

TEST(WalkableTets, TakeThirtyTwoBytesACellAndSixteenAPoint) {
  EXPECT_EQ(sizeof(WalkableTets::Cell), 32u);
  EXPECT_EQ(sizeof(WalkablePoint), 16u);
  const Mesh mesh = generate("box-tetrahedra", {4, 0.2, 1});
  const WalkableTets tets =
      make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), false);
  // And a bit a cell.
  EXPECT_EQ(tets.bytes(), 32 * mesh.cell_count() + 16 * mesh.point_count() +
                              sizeof(WalkableTets::Boundary) * tets.boundary.size() +
                              8 * ((mesh.cell_count() + 63) / 64));
}

// The points of every cell, which the walkable form does not store: found by following the links
// from the boundary. Fails where two ways to a cell disagree.
std::vector<std::set<std::uint32_t>> points_of_cells(const WalkableTets& tets) {
  std::vector<std::set<std::uint32_t>> points(tets.cells.size());
  std::vector<std::uint32_t> open;
  auto reach = [&](std::uint32_t cell, const std::set<std::uint32_t>& four) {
    EXPECT_EQ(four.size(), 4u) << "cell " << cell;
    if (points[cell].empty())
      open.push_back(cell);
    else
      EXPECT_EQ(points[cell], four) << "cell " << cell;
    points[cell] = four;
  };
  for (const auto& face : tets.boundary)
    reach(face.cell, {face.apex, face.loop[0], face.loop[1], face.loop[2]});
  while (!open.empty()) {
    const std::uint32_t cell = open.back();
    open.pop_back();
    std::size_t rank = 0;
    for (const std::uint32_t left_out : points[cell]) {
      const WalkableTets::Link link = tets.cells[cell][rank++];
      if (link.cell == kNone) continue;
      std::set<std::uint32_t> four = points[cell];
      four.erase(left_out);
      four.insert(link.apex);
      reach(link.cell, four);
    }
  }
  return points;
}

TEST(WalkableTets, LinksLeadToTheNeighborsAndBack) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 1});
  const WalkableTets tets = tets_of(mesh);
  ASSERT_EQ(tets.cells.size(), mesh.cell_count());
  const auto points = points_of_cells(tets);
  std::size_t boundary = 0;
  for (std::uint32_t c = 0; c < tets.cells.size(); ++c) {
    ASSERT_EQ(points[c].size(), 4u) << "cell " << c;
    for (const WalkableTets::Link& link : tets.cells[c]) {
      if (link.cell == kNone) {
        ++boundary;
        continue;
      }
      EXPECT_TRUE(std::any_of(tets.cells[link.cell].begin(), tets.cells[link.cell].end(),
                              [c](const WalkableTets::Link& back) { return back.cell == c; }));
    }
    // The same cell of the user's mesh, point by point.
    std::multiset<float> mine, theirs;
    const float scale = static_cast<float>(tets.frame.scale);
    for (const std::uint32_t p : points[c])
      mine.insert(tets.points[p].position[0] / scale + static_cast<float>(tets.frame.center[0]));
    for (std::size_t v = 0; v < 4; ++v)
      theirs.insert(mesh.points.at<float>(
          3 * mesh.cells.connectivity.at<std::size_t>(4 * tets.original_cell(c) + v)));
    auto other = theirs.begin();
    for (const float x : mine) EXPECT_NEAR(x, *other++, 1e-6) << "cell " << c;
  }
  EXPECT_EQ(boundary, 6u * 6 * 6 * 2);
  EXPECT_EQ(tets.boundary.size(), boundary);
  EXPECT_EQ(connected_parts(tets), 1u);
  EXPECT_TRUE(tets.findings.empty());
}

// Six times the volume that the boundary encloses, in local coordinates.
double enclosed(const WalkableTets& tets) {
  double sum = 0;
  for (const auto& face : tets.boundary) {
    double p[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 3; ++a)
        p[i][a] = static_cast<double>(tets.points[face.loop[i]].position[a]);
    sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
           p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return sum;
}

// For every cell, from each of its faces: across every other face lies the neighbour that the whole
// links name, and the apex is the point that they name.
TEST(WalkableTets, CompactCellsSayOfTheirNeighborsWhatWholeLinksSay) {
  for (const char* name : {"box-tetrahedra", "ball-tetrahedra"}) {
    const Mesh mesh = generate(name, {5, 0.2, 1});
    const WalkableTets tets = tets_of(mesh);
    const WalkableTets compact = make_walkable_tets(mesh, select_field(mesh), check_structure(mesh),
                                                    false, false, TetLinks::compact);
    EXPECT_EQ(sizeof(WalkableTets::CompactCell), 16u);
    EXPECT_TRUE(compact.cells.empty());
    ASSERT_EQ(compact.cell_count(), tets.cell_count());
    EXPECT_EQ(compact.bytes(), 16 * tets.cell_count() + 16 * tets.points.size() +
                                   sizeof(WalkableTets::Boundary) * tets.boundary.size());
    EXPECT_EQ(connected_parts(compact), connected_parts(tets));
    for (std::uint32_t c = 0; c < tets.cell_count(); ++c) {
      const auto ids = tets.points_of(c);
      const WalkableTets::CompactCell& cell = compact.compact_cells[c];
      const std::uint32_t all = ids[0] ^ ids[1] ^ ids[2] ^ ids[3];
      for (std::size_t in = 0; in < 4; ++in) {
        EXPECT_EQ(cell.apex(all ^ ids[in]), ids[in]);
        for (std::size_t out = 0; out < 4; ++out)
          EXPECT_EQ(cell.neighbor(out, in, tets.cells[c][in].cell), tets.cells[c][out].cell);
      }
    }
  }
}

TEST(WalkableTets, CellsListedBackwardsAreTurnedAround) {
  Mesh mesh = generate("box-tetrahedra", {4, 0.2, 1});
  std::vector<std::int32_t> ids;
  std::size_t reversed = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    std::int32_t cell[4];
    for (std::size_t v = 0; v < 4; ++v)
      cell[v] = mesh.cells.connectivity.at<std::int32_t>(4 * c + v);
    if (c % 3 == 0) {
      std::swap(cell[1], cell[2]);
      ++reversed;
    }
    ids.insert(ids.end(), cell, cell + 4);
  }
  mesh.cells.connectivity = Array::own(std::move(ids));
  const WalkableTets tets = tets_of(mesh);
  ASSERT_EQ(tets.findings.size(), 1u);
  EXPECT_EQ(tets.findings[0].count, reversed);
  EXPECT_NEAR(enclosed(tets) / 6, std::pow(tets.frame.scale, 3), 1e-5);
}

TEST(WalkableTets, ALeftHandedMeshIsTurnedAround) {
  const Mesh mesh =
      make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 3});
  EXPECT_GT(enclosed(tets_of(mesh)), 0);
}

TEST(WalkableTets, ACellInsideOutIsNotTurned) {
  // Point 0 is pulled through the common face: the first cell is inside out, but both still agree
  // on who is on which side.
  Mesh mesh = two_tetrahedra();
  mesh.points = Array::own(std::vector<double>{0.4, 0.4, 0.4, 1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 3, 3});
  const WalkableTets tets = tets_of(mesh);
  EXPECT_TRUE(tets.findings.empty());
}

TEST(WalkableTets, AFaceOfThreeCellsIsNamed) {
  const Mesh mesh =
      make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2},
                {0, 1, 2, 3, 4, 1, 3, 2, 5, 1, 3, 2});
  const WalkableTets tets = tets_of(mesh);
  ASSERT_EQ(tets.findings.size(), 1u);
  EXPECT_EQ(tets.findings[0].what, "faces shared by more than two cells");
  EXPECT_EQ(tets.findings[0].count, 1u);
}

TEST(WalkableTets, ACellWithARepeatedPointIsLeftOutAndItsNeighborsJoined) {
  // Between the two cells lies a third of no thickness: 1, 2, 3 and 3 again.
  const Mesh mesh = make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
                              {0, 1, 2, 3, 1, 2, 3, 3, 4, 1, 3, 2});
  const WalkableTets tets = tets_of(mesh);
  ASSERT_EQ(tets.cells.size(), 2u);
  EXPECT_EQ(tets.boundary.size(), 6u);
  ASSERT_EQ(tets.findings.size(), 1u);
  EXPECT_EQ(tets.findings[0].examples, std::vector<std::size_t>{1});
}

TEST(WalkableGrid, StoresNoConnectivity) {
  const Mesh mesh = generate("box-hexahedra", {8, 0.2, 1});
  const WalkableGrid grid = make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
  EXPECT_EQ(grid.bytes(), 16 * mesh.point_count() + sizeof(BoundaryFace) * 6 * 8 * 8);
  EXPECT_EQ(grid.neighbor(0, 0), kNone);
  EXPECT_EQ(grid.neighbor(0, 1), 1u);
  EXPECT_EQ(grid.neighbor(0, 3), 8u);
  EXPECT_EQ(grid.neighbor(0, 5), 64u);
  EXPECT_EQ(grid.neighbor(511, 1), kNone);
  EXPECT_FALSE(grid.left_handed);
}

// A box of cells one of whose points is moved off the planes of the faces around it.
Mesh dented_box(std::size_t i, std::size_t j, std::size_t k, double by) {
  Mesh mesh = generate("box-hexahedra", {4, 0, 1});
  std::vector<double> points(mesh.points.size());
  for (std::size_t p = 0; p < points.size(); ++p) points[p] = mesh.points.at<double>(p);
  const std::size_t moved = i + 5 * (j + 5 * k);
  for (std::size_t a = 0; a < 3; ++a) points[3 * moved + a] += by;
  mesh.points = Array::own(std::move(points));
  return mesh;
}

TEST(WalkableGrid, KnowsWhereItsTwistedFacesAre) {
  auto grid_of = [](const Mesh& mesh) {
    return make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
  };
  using Triple = std::array<std::uint32_t, 3>;
  for (const char* name : {"box-hexahedra", "o-grid", "sphere"}) {
    const WalkableGrid grid = grid_of(generate(name, {6, 0, 1}));
    EXPECT_EQ(grid.twisted.cell_count(), 0u) << name;
    EXPECT_EQ(grid.bytes(), 16 * grid.points.size() + sizeof(BoundaryFace) * grid.boundary.size());
  }
  const WalkableGrid twisted = grid_of(generate("twisted", {6, 0, 1}));
  EXPECT_EQ(twisted.twisted.cell_count(), twisted.cell_count());

  // By less than counts, and by more.
  for (const double by : {1e-7, 1e-6}) {
    const WalkableGrid grid = grid_of(dented_box(2, 2, 2, by));
    EXPECT_EQ(grid.twisted.cell_count(), by < 5e-7 ? 0u : 8u);
    EXPECT_EQ(grid.bytes(), 16 * grid.points.size() + sizeof(BoundaryFace) * grid.boundary.size());
  }
  const WalkableGrid inner = grid_of(dented_box(1, 2, 3, 0.05));
  EXPECT_EQ(inner.twisted.first, (Triple{0, 1, 2}));
  EXPECT_EQ(inner.twisted.size, (Triple{2, 2, 2}));
  const WalkableGrid corner = grid_of(dented_box(4, 4, 0, 0.05));
  EXPECT_EQ(corner.twisted.first, (Triple{3, 3, 0}));
  EXPECT_EQ(corner.twisted.size, (Triple{1, 1, 1}));
}

TEST(WalkableGrid, TakesAFaceForPlanarFromBothSidesOrFromNone) {
  for (const std::array<std::uint32_t, 3>& point :
       {std::array<std::uint32_t, 3>{2, 2, 2}, {1, 2, 3}, {0, 2, 4}, {4, 0, 3}}) {
    const Mesh mesh = dented_box(point[0], point[1], point[2], 0.05);
    const WalkableGrid grid = make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
    std::size_t twisted = 0;
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
      for (std::uint32_t face = 0; face < 6; ++face) {
        const bool planar = grid.is_planar(grid.cell_index(cell), face);
        const std::uint32_t other = grid.neighbor(cell, face);
        if (other != kNone) {
          EXPECT_EQ(planar, grid.is_planar(grid.cell_index(other), face ^ 1));
        }
        // Those with the moved point as a corner are twisted; of others only their box knows.
        const auto index = grid.cell_index(cell);
        bool has_it = true;
        for (std::size_t a = 0; a < 3; ++a)
          has_it = has_it &&
                   (a == face / 2 ? index[a] + face % 2 == point[a] : point[a] - index[a] <= 1);
        if (has_it) {
          EXPECT_FALSE(planar) << "cell " << cell << ", face " << face;
        }
        twisted += planar ? 0 : 1;
      }
    EXPECT_LE(twisted, 48u);
  }
}

TEST(WalkableGrid, HiddenCellsAreBoundary) {
  Mesh mesh = generate("box-hexahedra", {4, 0, 1});
  std::vector<std::uint8_t> hidden(64, 0);
  hidden[21] = 1;  // (1, 1, 1): inside
  mesh.hidden_cells = Array::own(std::move(hidden));
  const WalkableGrid grid = make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
  EXPECT_EQ(grid.boundary.size(), 6u * 16 + 6);
  EXPECT_EQ(grid.neighbor(20, 1), kNone);
  EXPECT_EQ(connected_parts(grid), 1u);
}

TEST(WalkableCells, ACollapsedHexahedronIsAWedge) {
  // Points 4 and 7 are 0 and 3: the face between them is gone, two others are triangles.
  Mesh mesh = make_mesh(CellType::hexahedron, cube_points(), {0, 1, 2, 3, 0, 5, 6, 3});
  const WalkableCells cells = cells_of(mesh);
  EXPECT_EQ(cells.cell_count(), 1u);
  std::multiset<std::size_t> sizes;
  for (std::uint32_t f = 0; f < cells.face_sides.size(); ++f) sizes.insert(cells.loop(f).size());
  EXPECT_EQ(sizes, (std::multiset<std::size_t>{3, 3, 4, 4, 4}));
}

TEST(WalkableCells, EachInteriorFaceIsStoredOnce) {
  const Mesh mesh = generate("box-mixed", {4, 0.2, 1});
  const WalkableCells cells = cells_of(mesh);
  std::size_t interior = 0;
  for (const auto& sides : cells.face_sides) interior += sides.neighbor != kNone;
  EXPECT_EQ(cells.cell_faces.size(), 2 * interior + cells.boundary.size());
  EXPECT_EQ(connected_parts(cells), 1u);
  EXPECT_TRUE(cells.findings.empty());
}

// The unit cube as a polyhedron, two of its faces listed the wrong way round.
const std::vector<std::int32_t> kCubeFaces{6, 4, 0, 4, 7, 3, 4, 1, 2, 6, 5, 4, 4, 5, 1, 0,
                                           4, 3, 7, 6, 2, 4, 0, 3, 2, 1, 4, 7, 6, 5, 4};

TEST(WalkableCells, APolyhedronsFacesAreMadeToAgree) {
  const Mesh mesh = one_polyhedron(cube_points(), kCubeFaces);
  const WalkableCells cells = cells_of(mesh);
  EXPECT_EQ(cells.cell_count(), 1u);
  EXPECT_TRUE(cells.findings.empty());
  CellFaces faces;
  for (std::uint32_t f = 0; f < 6; ++f) {
    faces.sizes.push_back(4);
    for (const std::uint32_t id : cells.loop(f)) faces.ids.push_back(id);
  }
  EXPECT_TRUE(is_closed(faces));
}

TEST(WalkableCells, APolyhedronWithAGapIsNamedAndLeftOut) {
  std::vector<std::int32_t> faces = kCubeFaces;
  faces[0] = 5;
  faces.resize(faces.size() - 5);
  const Mesh mesh = one_polyhedron(cube_points(), faces);
  const WalkableCells cells = cells_of(mesh);
  EXPECT_EQ(cells.cell_count(), 0u);
  ASSERT_EQ(cells.findings.size(), 1u);
  EXPECT_EQ(describe(cells.findings[0]), "1 cells whose faces leave a gap, left out: 0");
}

TEST(LocalFrame, ScalesByPowersOfTwoAndKeepsDistantMeshes) {
  const LocalFrame frame = LocalFrame::of({{1e7, 1e7, 1e7}, {1e7 + 3, 1e7 + 1, 1e7 + 2}});
  EXPECT_EQ(frame.scale, 0.5);
  const WalkablePoint p = frame.local(1e7 + 3, 1e7, 1e7 + 1, 7);
  EXPECT_EQ(p.position[0], 0.75f);
  EXPECT_EQ(p.position[1], -0.25f);
  EXPECT_EQ(p.position[2], 0.0f);
  EXPECT_EQ(p.scalar, 7.0f);
}

TEST(SelectField, TakesComponentsMagnitudesAndDefaults) {
  Mesh mesh = two_tetrahedra();
  mesh.fields.push_back(
      {"vel", Association::point, 3,
       Array::own(std::vector<float>{3, 4, 0, 0, 0, 1, 1, 2, 2, 0, 0, 0, 6, 0, 8})});
  mesh.fields.push_back({"vel", Association::cell, 1, Array::own(std::vector<double>{5, 6})});
  EXPECT_EQ(select_field(mesh).name, "x");
  mesh.active_field = "vel";
  const ScalarField magnitude = select_field(mesh);
  EXPECT_EQ(magnitude.name, "vel:magnitude");
  EXPECT_EQ(magnitude.values, (std::vector<float>{5, 1, 3, 0, 10}));
  EXPECT_EQ(magnitude.high, 10);
  EXPECT_EQ(select_field(mesh, {"vel:0", {}}).values, (std::vector<float>{3, 0, 1, 0, 6}));
  EXPECT_EQ(select_field(mesh, {"vel", Association::cell}).values, (std::vector<float>{5, 6}));
}

TEST(SelectField, CountsWhatIsNotFinite) {
  Mesh mesh = two_tetrahedra();
  mesh.fields[0].values = Array::own(std::vector<double>{1, NAN, INFINITY, 1e300, -2});
  const ScalarField field = select_field(mesh);
  EXPECT_EQ(field.not_finite, 3u);
  EXPECT_EQ(field.low, -2);
  EXPECT_EQ(field.high, 1);
  EXPECT_TRUE(std::isnan(field.values[2]));
}

TEST(SelectField, ListsWhatThereIs) {
  Mesh mesh = two_tetrahedra();
  auto error_of = [&](const char* name) -> std::string {
    try {
      select_field(mesh, {name, {}});
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("pressure"), "no field 'pressure'; there are: x (point)");
  EXPECT_EQ(error_of("x:1"), "field 'x' has no component '1': ask for 0 to 0 or 'magnitude'");
  mesh.fields[0].values = Array::own(std::vector<float>{1, 2});
  EXPECT_NE(error_of("x").find("holds 2 values where 5 points"), std::string::npos);
}

}  // namespace
}  // namespace plume::test
