#include "scenes.h"

#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "plume/datasets/families.h"
#include "plume/datasets/generate.h"
#include "plume/datasets/grid.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/bench_meshes.h"
#include "scene_rays.h"

namespace plume::atlas {
namespace {

using test::Place;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kRays = 120;  // a mesh

// --- Meshes

template <class Map>
Mesh moved(Mesh mesh, const Map& map) {
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (const double x : map(p, point_at(mesh, p))) points.push_back(x);
  mesh.points = Array::own(std::move(points));
  return mesh;
}

Mesh scaled(Mesh mesh, double scale, double offset) {
  return moved(std::move(mesh), [&](std::size_t, const Place& p) {
    return Place{p[0] * scale + offset, p[1] * scale + offset, p[2] * scale + offset};
  });
}

// A grid's cells that `keep` accepts, as hexahedra.
Mesh hexahedra_of(const Mesh& grid, const std::function<bool(int, int, int)>& keep) {
  datasets::Box box;
  for (std::size_t a = 0; a < 3; ++a) box.cells[a] = static_cast<int>(grid.dimensions[a]) - 1;
  std::vector<std::int32_t> connectivity;
  datasets::for_each_cuboid(box, [&](int i, int j, int k) {
    if (!keep(i, j, k)) return;
    const auto corners = box.corners(i, j, k);
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  });
  Mesh mesh;
  mesh.points = grid.points;
  mesh.cells = datasets::cells_of(CellType::hexahedron, std::move(connectivity));
  return mesh;
}
Mesh hexahedra_of(const Mesh& grid) {
  return hexahedra_of(grid, [](int, int, int) { return true; });
}

// Hexahedra cut into six tetrahedra each, alike on both sides of a face.
Mesh tetrahedra_of(const Mesh& hexahedra) {
  const CellReader reader(hexahedra);
  std::vector<std::int32_t> connectivity;
  std::vector<std::uint32_t> ids;
  for (std::size_t c = 0; c < reader.size(); ++c) {
    if (reader.hidden(c)) continue;
    reader.points(c, ids);
    std::array<std::int32_t, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = static_cast<std::int32_t>(ids[i]);
    datasets::append_kuhn_tetrahedra(corners, connectivity);
  }
  Mesh mesh;
  mesh.points = hexahedra.points;
  mesh.cells = datasets::cells_of(CellType::tetrahedron, std::move(connectivity));
  return mesh;
}

Mesh with_hidden(Mesh grid, const std::function<bool(int, int, int)>& keep) {
  std::vector<std::uint8_t> hidden;
  for (int k = 0; k + 1 < grid.dimensions[2]; ++k)
    for (int j = 0; j + 1 < grid.dimensions[1]; ++j)
      for (int i = 0; i + 1 < grid.dimensions[0]; ++i) hidden.push_back(keep(i, j, k) ? 0 : 1);
  grid.hidden_cells = Array::own(std::move(hidden));
  return grid;
}

Mesh box(const char* name, int size, double jitter) { return generate(name, {size, jitter, 7}); }

// A box whose planes along z (and along x) come in pairs that are that close together.
Mesh layered(double thickness, bool along_x) {
  const double planes[] = {0, 0.25, 0.25 + thickness, 0.5, 0.75 - thickness, 0.75, 1};
  const auto at = [&](double x) { return planes[static_cast<std::size_t>(std::lround(6 * x))]; };
  return moved(box("box-hexahedra", 6, 0), [&](std::size_t, const Place& p) {
    return Place{along_x ? at(p[0]) : p[0], p[1], at(p[2])};
  });
}

// Every second layer of points lies on the one below: cells of no volume between.
Mesh flat_layers(Mesh mesh, int size) {
  return moved(std::move(mesh), [&](std::size_t, const Place& p) {
    const double layer = std::round(p[2] * size);
    const bool down = std::fmod(layer, 2) == 1 && layer < size;
    return Place{p[0], p[1], down ? (layer - 1) / size : p[2]};
  });
}

// Points on a coarse lattice: many coincide.
Mesh snapped(Mesh mesh, double lattice) {
  return moved(std::move(mesh), [&](std::size_t, const Place& p) {
    Place q;
    for (std::size_t a = 0; a < 3; ++a) q[a] = std::round(p[a] * lattice) / lattice;
    return q;
  });
}

// Two boxes of hexahedra that meet in the plane x = 1/2, with points of their own.
Mesh hanging(int left, int right) {
  std::vector<float> points;
  std::vector<std::int32_t> connectivity;
  for (const auto& [size, low] : {std::pair{left, 0.0}, {right, 0.5}}) {
    const datasets::Box part{{size / 2, size, size}, {low, 0, 0}, {low + 0.5, 1, 1}};
    const auto first = static_cast<std::int32_t>(points.size() / 3);
    datasets::append_box_points(part, 0, 1, points);
    datasets::for_each_cuboid(part, [&](int i, int j, int k) {
      for (auto corner : part.corners(i, j, k)) connectivity.push_back(first + corner);
    });
  }
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells = datasets::cells_of(CellType::hexahedron, std::move(connectivity));
  return mesh;
}

// A box of 3 x 3 x 3 hexahedra, one inner point of which is pushed past the middle of a cell.
Mesh dented() {
  return moved(box("box-hexahedra", 3, 0), [](std::size_t i, const Place& p) {
    return i == 21 ? Place{0.52, 0.54, 0.5} : p;
  });
}

// Two points that are joined by an edge change places: the faces at that edge become bow-ties.
Mesh bow_ties() {
  return moved(box("box-hexahedra", 3, 0), [](std::size_t i, const Place& p) {
    return i == 21 || i == 22 ? Place{1 - p[0], p[1], p[2]} : p;
  });
}

Mesh uneven_rectilinear(double scale, double offset) {
  Mesh mesh;
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.dimensions[a] = 5;
    std::vector<double> axis;
    for (const double x : {0.0, 0.2, 0.55, 0.6, 1.0}) axis.push_back(x * scale + offset);
    mesh.axes[a] = Array::own(std::move(axis));
  }
  return mesh;
}

// --- Scenes

Mesh with_field(Mesh mesh) {
  const LinearField field(mesh);
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    values.push_back(static_cast<float>(field.at(point_at(mesh, p).data())));
  mesh.fields = {{"linear", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "linear";
  return mesh;
}

struct Named {
  std::string cells;
  Mesh mesh;
};

AtlasScene scene(const char* group, const char* name, std::vector<Named> meshes,
                 const std::vector<Aim>& aims, Oracle oracle = Oracle::cells) {
  AtlasScene made{group, name, oracle, {}};
  for (Named& named : meshes) {
    SceneMesh& one =
        made.meshes.emplace_back(SceneMesh{named.cells, with_field(std::move(named.mesh)), {}});
    const Bounds bounds = check_structure(one.mesh);
    one.rays = SceneRays(one.mesh, bounds, 1 + made.meshes.size())(aims, kRays);
  }
  return made;
}

// The unit cube in every form, its points on a lattice that floats hold exactly.
std::vector<Named> clean_forms() {
  const Mesh grid = box("box-hexahedra", 4, 0);
  return {{"tetrahedra", tetrahedra_of(grid)},       {"grid", grid},
          {"hexahedra", hexahedra_of(grid)},         {"mixed cells", box("box-mixed", 4, 0)},
          {"polyhedra", box("box-polyhedra", 3, 0)}, {"rectilinear", box("box-rectilinear", 4, 0)}};
}

std::vector<Named> jittered_forms(double jitter) {
  const Mesh grid = box("box-hexahedra", 4, jitter);
  return {{"tetrahedra", box("box-tetrahedra", 4, jitter)},
          {"grid", grid},
          {"mixed cells", box("box-mixed", 4, jitter)},
          {"polyhedra", box("box-polyhedra", 3, jitter)}};
}

// A grid as it is, as hexahedra and as tetrahedra.
std::vector<Named> forms_of(const Mesh& grid) {
  return {{"tetrahedra", tetrahedra_of(grid)}, {"grid", grid}, {"hexahedra", hexahedra_of(grid)}};
}
std::vector<Named> hexahedral_forms_of(const Mesh& grid) {
  return {{"grid", grid}, {"hexahedra", hexahedra_of(grid)}};
}

// What is left of the unit cube where `keep` accepts a cell; points are shared.
std::vector<Named> forms_with_holes(int size, const std::function<bool(int, int, int)>& keep) {
  const Mesh grid = box("box-hexahedra", size, 0);
  const Mesh hexahedra = hexahedra_of(grid, keep);
  return {{"tetrahedra", tetrahedra_of(hexahedra)},
          {"grid", with_hidden(grid, keep)},
          {"hexahedra", hexahedra},
          {"rectilinear", with_hidden(box("box-rectilinear", size, 0), keep)}};
}

std::vector<Named> scaled_forms(double scale, double offset) {
  std::vector<Named> forms = jittered_forms(0.2);
  for (Named& form : forms) form.mesh = scaled(std::move(form.mesh), scale, offset);
  forms.push_back({"rectilinear", uneven_rectilinear(scale, offset)});
  return forms;
}

const std::vector<Aim> kEverything{Aim::inside,     Aim::vertex,       Aim::edge,   Aim::along_edge,
                                   Aim::along_axis, Aim::two_vertices, Aim::in_face};

// Cameras in the mesh: rays from a place inside, from a vertex, from a face.
AtlasScene camera_inside() {
  std::vector<Named> forms = clean_forms();
  AtlasScene made =
      scene("domains", "a camera inside", std::move(forms), {Aim::inside}, Oracle::box);
  for (SceneMesh& one : made.meshes) {
    const Bounds bounds = check_structure(one.mesh);
    test::MeshSpots spots(one.mesh, bounds, 5);
    for (std::size_t i = 0; i < one.rays.size(); ++i) {
      Place from = spots.inside();
      if (i % 3 == 1) from = spots.vertex();
      if (i % 3 == 2) {
        const auto edge = spots.edge();
        from = test::middle(edge[0], edge[1]);
      }
      do one.rays[i] = test::ray_towards(from, i % 2 == 0 ? spots.inside() : spots.vertex());
      while (!(one.rays[i].direction[0] == one.rays[i].direction[0]));
    }
  }
  return made;
}

AtlasScene no_direction() {
  AtlasScene made =
      scene("rays", "without a direction", clean_forms(), {Aim::inside}, Oracle::none);
  const double nan = std::nan("");
  const std::array<std::array<double, 3>, 6> directions{{{0, 0, 0},
                                                         {nan, 0, 1},
                                                         {0, 0, kInfinity},
                                                         {0, 1e-320, 0},
                                                         {-kInfinity, nan, 0},
                                                         {-0., 0, 0}}};
  for (SceneMesh& one : made.meshes)
    for (std::size_t i = 0; i < one.rays.size(); ++i)
      one.rays[i].direction = directions[i % directions.size()];
  return made;
}

}  // namespace

LinearField::LinearField(const Mesh& mesh) {
  const Bounds bounds = check_structure(mesh);
  double range = 0;
  for (std::size_t a = 0; a < 3; ++a)
    range += (static_cast<double>(a) + 1) * (bounds.high[a] - bounds.low[a]);
  for (std::size_t a = 0; a < 3; ++a) {
    slope[a] = range > 0 ? (static_cast<double>(a) + 1) / range : 0;
    at_origin -= slope[a] * bounds.low[a];
  }
}

std::vector<AtlasScene> atlas_scenes() {
  std::vector<AtlasScene> all;
  auto add = [&all](AtlasScene made) { all.push_back(std::move(made)); };
  add(scene("rays", "anywhere (the control)", jittered_forms(0.2), {Aim::inside}));
  add(scene("rays", "through vertices", clean_forms(), {Aim::vertex}));
  add(scene("rays", "through edges", clean_forms(), {Aim::edge}));
  add(scene("rays", "along edges", clean_forms(), {Aim::along_edge}));
  add(scene("rays", "in the planes of faces", clean_forms(), {Aim::in_face}));
  add(scene("rays", "along grid lines", clean_forms(), {Aim::along_axis, Aim::two_vertices}));
  add(scene("rays", "tangent to the boundary", clean_forms(), {Aim::tangent}));
  add(scene("rays", "at vertices and edges, jittered", jittered_forms(0.2), kEverything));
  add(no_direction());

  add(scene("cells", "slivers, aspect 1e6", forms_of(layered(1e-6, false)), kEverything));
  add(scene("cells", "slivers, aspect 1e9", forms_of(layered(1e-9, false)), kEverything));
  add(scene("cells", "needles, aspect 1e6", forms_of(layered(1e-6, true)), kEverything));
  add(scene("cells", "zero volume", forms_of(flat_layers(box("box-hexahedra", 4, 0), 4)),
            kEverything));
  add(scene("cells", "inverted", jittered_forms(3), kEverything, Oracle::box));
  {
    std::vector<Named> forms = jittered_forms(0.6);
    for (Named& form : forms) form.mesh = snapped(std::move(form.mesh), 6);
    add(scene("cells", "duplicate points", std::move(forms), kEverything, Oracle::box));
  }
  add(scene("cells", "twisted hexahedra", hexahedral_forms_of(generate("twisted", {4, 0, 1})),
            kEverything));
  add(scene("cells", "concave hexahedra", hexahedral_forms_of(dented()), kEverything));
  add(scene("cells", "bow-tie hexahedra", hexahedral_forms_of(bow_ties()), kEverything,
            Oracle::box));
  add(scene("cells", "poles (collapsed hexahedra)", forms_of(generate("sphere", {3, 0, 1})),
            kEverything));
  add(scene("cells", "an O-grid's axis (collapsed)", forms_of(generate("o-grid", {3, 0, 1})),
            kEverything));

  add(scene("domains", "non-convex",
            forms_with_holes(4, [](int i, int j, int k) { return (i + j + k) % 3 != 0; }),
            kEverything));
  add(scene("domains", "a hole",
            forms_with_holes(5,
                             [](int i, int j, int k) {
                               return !(i > 0 && i < 4 && j > 0 && j < 4 && k > 0 && k < 4);
                             }),
            kEverything));
  add(scene("domains", "blocks that touch at an edge",
            forms_with_holes(4, [](int i, int j, int) { return (i < 2) == (j < 2); }),
            kEverything));
  add(scene("domains", "blocks that touch at a vertex",
            forms_with_holes(
                4, [](int i, int j, int k) { return (i < 2) == (j < 2) && (j < 2) == (k < 2); }),
            kEverything));
  {
    const Mesh blocks = generate("two-blocks", {4, 0, 1});
    add(scene("domains", "blocks with duplicated points",
              {{"tetrahedra", tetrahedra_of(blocks)}, {"hexahedra", blocks}}, kEverything));
    const Mesh nodes = hanging(4, 6);
    add(scene("domains", "hanging nodes",
              {{"tetrahedra", tetrahedra_of(nodes)}, {"hexahedra", nodes}}, kEverything));
  }
  add(camera_inside());

  add(scene("numbers", "scaled by 1e-9", scaled_forms(1e-9, 0), kEverything));
  add(scene("numbers", "scaled by 1e9", scaled_forms(1e9, 0), kEverything));
  add(scene("numbers", "shifted by 1e7", scaled_forms(1, 1e7), kEverything));
  return all;
}

}  // namespace plume::atlas
