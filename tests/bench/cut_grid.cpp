// A curvilinear grid of Plot3D, its hexahedra cut into six tetrahedra each, as a file.

#include <cstdio>

#include "plume/io/read_mesh.h"
#include "plume/io/write_mesh.h"
#include "plume/mesh/error.h"
#include "plume/tests/bench/bench_meshes.h"

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fputs("usage: plume_cut_grid GRID [SOLUTION] TETRAHEDRA.vtu\n", stderr);
    return 2;
  }
  try {
    plume::ReadOptions options;
    if (argc == 4) options.solution = argv[2];
    const plume::Mesh grid = plume::read_mesh(argv[1], options);
    if (!grid.is_grid() || grid.is_rectilinear())
      throw plume::Error(std::string(argv[1]) + ": no curvilinear grid");
    plume::write_mesh(plume::bench::cut_into_tetrahedra(grid), argv[argc - 1]);
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_cut_grid: %s\n", error.what());
    return 1;
  }
  return 0;
}
