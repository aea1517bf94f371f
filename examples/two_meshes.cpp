// Two meshes of different kinds in one picture: tetrahedra that turn within a grid, each a scene of
// its own.

#include <cstdint>
#include <cstdio>
#include <vector>

#include "plume/lib/plume.h"

namespace {

plume::Mesh with_pressure(plume::Mesh mesh, std::vector<float> values) {
  mesh.fields.push_back(
      {"pressure", plume::Association::point, 1, plume::Array::own(std::move(values))});
  return mesh;
}

// Two tetrahedra.
plume::Mesh make_rotor() {
  plume::Mesh mesh;
  mesh.points = plume::Array::own(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  mesh.cells.types = plume::Array::own(
      std::vector<std::uint8_t>{static_cast<std::uint8_t>(plume::CellType::tetrahedron)});
  mesh.cells.connectivity = plume::Array::own(std::vector<std::int32_t>{0, 1, 2, 3, 4, 1, 3, 2});
  return with_pressure(std::move(mesh), {1, 2, 3, 4, 5});
}

// A curvilinear grid of one cell around them, twice as wide.
plume::Mesh make_stator() {
  plume::Mesh mesh;
  mesh.dimensions = {2, 2, 2};
  std::vector<double> points;
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4}) points.push_back((i & bit) != 0 ? 1.5 : -0.5);
  mesh.points = plume::Array::own(std::move(points));
  return with_pressure(std::move(mesh), {0, 0, 0, 0, 2, 2, 2, 2});
}

}  // namespace

int main() {
  try {
    const plume::Mesh rotor = make_rotor(), stator = make_stator();
    plume::RenderSettings settings;
    settings.width = settings.height = 64;

    plume::SceneOptions options;
    options.frame_bounds =
        plume::united(plume::bounds_of(rotor.points), plume::bounds_of(stator.points));
    const plume::Scene turning(rotor, options), standing(stator, options);
    const std::vector<const plume::Scene*> both{&turning, &standing};
    const plume::Camera camera = plume::named_view("iso", plume::visible_bounds(both));

    // The rotor's place in the stator is the rotor's alone.
    settings.overlap = plume::Overlap::first;
    const plume::RenderResult result = plume::render(both, camera, settings);
    std::printf("%llu rays hit, %llu of them both meshes; the middle pixel is %.3f opaque\n",
                static_cast<unsigned long long>(result.statistics.rays_hit),
                static_cast<unsigned long long>(result.statistics.rays_overlapping),
                static_cast<double>(result.image.pixel(32, 32)[3]));
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
