#include "plume/datasets/generate.h"

#include <algorithm>
#include <cmath>

#include "plume/datasets/families.h"
#include "plume/mesh/error.h"

namespace plume {

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all{
      {"blunt-body", "blunt fin in a supersonic flow, curvilinear", datasets::blunt_body},
      {"box-tetrahedra", "unit cube of tetrahedra", datasets::box_tetrahedra},
      {"box-hexahedra", "unit cube of hexahedra, curvilinear", datasets::box_hexahedra},
      {"box-rectilinear", "unit cube of cuboids, rectilinear", datasets::box_rectilinear},
      {"box-wedges", "unit cube of wedges", datasets::box_wedges},
      {"box-mixed", "unit cube of hexahedra, wedges, pyramids and tetrahedra", datasets::box_mixed},
      {"box-polyhedra", "unit cube as a honeycomb of polyhedra", datasets::box_polyhedra},
      {"twisted", "unit cube of hexahedra whose interior faces are all twisted", datasets::twisted},
      {"o-grid", "cylinder, curvilinear, with a collapsed axis and a seam", datasets::o_grid},
      {"sphere", "ball, curvilinear, with a collapsed centre, poles and a seam", datasets::sphere},
      {"ball-tetrahedra", "ball of tetrahedra", datasets::ball_tetrahedra},
      {"two-blocks", "two blocks of hexahedra that meet with duplicated points",
       datasets::two_blocks},
      {"nested-shell", "head of nested shells, tetrahedra", datasets::nested_shell},
      {"vortex-street", "wake of a cylinder, curvilinear; changes in time", datasets::vortex_street,
       datasets::vortex_street_period},
  };
  return all;
}

const Generator& generator_named(const std::string& name) {
  const auto& all = generators();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Generator& g) { return g.name == name; });
  if (found == all.end()) {
    std::string names;
    for (const Generator& g : all) names += (names.empty() ? "" : ", ") + g.name;
    throw Error("generate: no mesh is called '" + name + "'; choose one of " + names);
  }
  return *found;
}

Mesh generate(const std::string& name, const GenerateOptions& options) {
  if (options.size < 0) {
    throw Error("generate: size " + std::to_string(options.size) +
                " is negative; give at least 1, or 0 for the default");
  }
  if (!(options.jitter >= 0) || !std::isfinite(options.jitter)) {
    throw Error("generate: jitter " + std::to_string(options.jitter) +
                " is no displacement; give a number of cell edges, at least 0");
  }
  if (!std::isfinite(options.time))
    throw Error("generate: time " + std::to_string(options.time) + " is none; give a number");
  return generator_named(name).make(options);
}

}  // namespace plume
