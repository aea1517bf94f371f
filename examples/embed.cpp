// A host program: arrays that it already has, a picture of its own pixels, and its own consumer of
// segments. Nothing here reads or writes a file, and VTK is not needed.

#include <cstdint>
#include <cstdio>
#include <vector>

#include "plume/lib/plume.h"

int main() {
  // Two tetrahedra and a pressure on their points, as a solver might hold them.
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const std::vector<std::int32_t> tetrahedra{0, 1, 2, 3, 4, 1, 3, 2};
  const std::vector<float> pressure{1, 2, 3, 4, 5};

  plume::Mesh mesh;
  mesh.points = plume::Array::borrow<double>(points);
  mesh.cells.types = plume::Array::own(
      std::vector<std::uint8_t>{static_cast<std::uint8_t>(plume::CellType::tetrahedron)});
  mesh.cells.connectivity = plume::Array::borrow<std::int32_t>(tetrahedra);
  mesh.fields.push_back(
      {"pressure", plume::Association::point, 1, plume::Array::borrow<float>(pressure)});

  try {
    const plume::Scene scene(mesh);

    plume::RenderSettings settings;
    settings.width = settings.height = 64;
    const plume::Camera camera = plume::named_view("iso", scene.bounds());
    const plume::RenderResult result = plume::render(scene, camera, settings);
    std::printf("%llu of %llu rays hit, %llu lost; the middle pixel is %.3f opaque\n",
                static_cast<unsigned long long>(result.statistics.rays_hit),
                static_cast<unsigned long long>(result.statistics.rays),
                static_cast<unsigned long long>(result.statistics.lost_rays),
                static_cast<double>(result.image.pixel(32, 32)[3]));

    // The integral of the pressure along the diagonal: exact, as it is linear in each cell.
    const double third = 0.57735026918962576;
    double integral = 0;
    scene.trace({{-1, -1, -1}, {third, third, third}}, [&](const plume::Segment& segment) {
      integral += 0.5 * (segment.s_in + segment.s_out) * (segment.t_out - segment.t_in);
      return true;
    });
    std::printf("integral of the pressure along the diagonal: %.6f\n", integral);
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
