/// Meshes made on the spot: for the demo, the tests and the benchmarks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

struct GenerateOptions {
  /// Cells along an edge of the mesh, >= 1; each generator says what it makes of it. 0: its
  /// default.
  int size = 0;
  /// Displacement of interior points, in cell edges; above about 0.3 cells turn inside out.
  double jitter = 0.2;
  std::uint64_t seed = 1;
  /// Of meshes that change in time, in their own unit.
  double time = 0;
};

struct Generator {
  std::string name;
  std::string description;
  Mesh (*make)(const GenerateOptions&);
  /// After this time a mesh that changes in time is as it was; 0 for those that do not change.
  double period = 0;
};

/// All generators, in the order in which they are listed to users.
const std::vector<Generator>& generators();

/// Throws Error, listing those there are, for an unknown name.
const Generator& generator_named(const std::string& name);

/// Makes a mesh. Throws Error for an unknown name (listing those there are) or a size < 0, or a
/// time that is not finite.
Mesh generate(const std::string& name, const GenerateOptions& options = {});

}  // namespace plume
