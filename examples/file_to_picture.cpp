// A file that VTK reads becomes a picture: with plume::io.

#include <cstdio>

#include "plume/io/image_file.h"
#include "plume/io/read_mesh.h"
#include "plume/lib/plume.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: file_to_picture MESH PICTURE\n");
    return 2;
  }
  try {
    plume::check_image_path(argv[2]);  // before the work, not after
    const plume::Mesh mesh = plume::read_mesh(argv[1]);
    const plume::Scene scene(mesh);
    const plume::Camera camera = plume::named_view("iso", scene.bounds(), 4.0 / 3);
    plume::RenderSettings settings;
    settings.width = 320;
    settings.height = 240;
    const plume::RenderResult result = plume::render(scene, camera, settings);
    plume::write_image(result.image, argv[2]);
    std::printf("%zu cells, %llu of %llu rays hit\n", scene.cell_count(),
                static_cast<unsigned long long>(result.statistics.rays_hit),
                static_cast<unsigned long long>(result.statistics.rays));
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
