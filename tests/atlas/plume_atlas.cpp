// The atlas of failures: plume_atlas. See --help.

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "optics.h"
#include "walk_table.h"

namespace {

using namespace plume::atlas;

constexpr const char* kHelp =
    R"(plume_atlas: the scenes on which methods fail, by every walker and integrator

  plume_atlas               prints the page docs/atlas.md
  plume_atlas --check PAGE  says where the page is not what would be printed

Ends with 1 where one of ours fails, where an old method fails nowhere, or the page differs.
)";

constexpr const char* kIntroduction = R"(# The atlas of failures

Made by `build/bin/plume_atlas`; do not edit. `./dev test` checks that this page is what that prints, that Plume's
columns are zeros, and that each of the other methods fails somewhere. The scenes are small generated meshes and seeded
rays (`tests/atlas/scenes.cpp`); the truth is found without any walker, by intersecting every face of every cell in
extended precision (`tests/reference/line_lengths.cpp`), or is the chord of a box where cells overlap.

- *Lost*: no way out of a cell, by the method's own account. *Looping*: stopped by a limit on steps.
- *Gaps*: the ray's stretches cover less of it than there is of the mesh. *Overlaps*: more, or something twice.
- *Wrong cells*: a stretch is taken for the inside of a cell that is not there.
- All of that beyond what moving the ray by 5e-7 of the mesh's diagonal changes, which is what rounding to single
  precision does, and a millionth of the diagonal; for point sampling, beyond four steps.
- *Chord error*, *integral error* (of a linear field): in diagonals (times the field's range), where moving the ray does
  not change them; rounded up to a power of ten.

The other methods are written as plainly as they are described (`tests/atlas/old_methods.h`): Plücker products
(Marmitt 2008), the ray-triangle test of Möller and Trumbore, face planes (Garrity 1990), barycentric coordinates with
a tolerance, and the bump by 1e-3 of the bounds by which VTK-m's and Viskores' ConnectivityTracer heals lost rays; and
200 samples a diagonal through VTK's cell locator (not on polyhedra, where it takes minutes). A grid is hexahedra to them, and a
quadrilateral two triangles, by which they are judged.

)";

std::string page(const std::vector<WalkRow>& walks, const std::vector<OpticsRow>& optics,
                 const std::vector<SurfaceRow>& surfaces) {
  return std::string(kIntroduction) + "## Plume's walkers, all scenes\n\n" + walker_table(walks) +
         R"(
HybridGridWalker is there to compare with: the thesis' patches, whose grazes count as missed. TetWalker's meshes
are walked as cells by CellWalker, too. A ray along an edge of a *twisted* face may still be put on the wrong side
of the face, by the one bit that edges have in single precision: of a thousand rays aimed from a corner or an
edge's middle to another edge of the same twisted face, up to two (tests/traverse/twisted_faces_test.cpp).

## Scene by scene: rays with any failure

)" + scene_table(walks) +
         R"(
## What a segment looks like

Pictures of 24 x 24 pixels, early termination off, of four kinds of meshes on which the field is linear; largest error
of a pixel in linear RGBA, against adaptive quadrature along the whole ray.

)" + optics_table(optics) +
         R"(
Rays through four kinds of meshes whose vertices have exactly the value in question.

)" + surface_table(surfaces) +
         "\n## Everything\n\n" + full_table(walks);
}

int check(const std::string& made, const char* name) {
  std::ifstream file(name);
  std::istringstream expected(made);
  std::string line, other;
  for (int number = 1;; ++number) {
    const bool more = static_cast<bool>(std::getline(file, line));
    const bool wanted = static_cast<bool>(std::getline(expected, other));
    if (!more && !wanted) return 0;
    if (more == wanted && line == other) continue;
    std::fprintf(stderr, "%s:%d is\n  %s\nand should be\n  %s\nMake it anew: plume_atlas > %s\n",
                 name, number, more ? line.c_str() : "(the end)",
                 wanted ? other.c_str() : "(the end)", name);
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool checks = argc == 3 && std::string(argv[1]) == "--check";
  if (argc != 1 && !checks) {
    const bool asked = argc == 2 && std::string(argv[1]) == "--help";
    std::fputs(kHelp, asked ? stdout : stderr);
    return asked ? 0 : 2;
  }
  const auto walks = run_walks();
  auto optics = run_transfer_functions();
  for (const OpticsRow& row : run_turning_points()) optics.push_back(row);
  const auto surfaces = run_surfaces();
  const std::string made = page(walks, optics, surfaces);

  std::vector<std::string> problems = problems_of(walks);
  for (const auto& more : {problems_of(optics), problems_of(surfaces)})
    problems.insert(problems.end(), more.begin(), more.end());
  for (const std::string& problem : problems) std::fprintf(stderr, "%s\n", problem.c_str());
  int status = problems.empty() ? 0 : 1;
  if (checks)
    status = check(made, argv[2]) == 0 ? status : 1;
  else
    std::fputs(made.c_str(), stdout);
  return status;
}
