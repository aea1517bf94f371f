/// The thesis' data sets (table 6.8), or what stands in for them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/tests/bench/bench_meshes.h"

namespace plume::bench {

struct ThesisMesh {
  /// As the thesis calls it; with an asterisk where another stands in for it.
  std::string name;
  Family family;
  std::size_t thesis_cells;  ///< as its table 6.2 or 6.8 counts them
  std::string what;          ///< in words, what is taken here
  /// Nothing where the file is absent: that is said on stderr, loudly.
  std::function<std::optional<Mesh>()> load;
};

/// Blunt-fin, Orbital* and Bucky-ball*: tetrahedra; Blunt-fin and Combustion: grids. Stand-ins are
/// of a few cells where `quick`.
std::vector<ThesisMesh> thesis_meshes(Family family, bool quick);

/// "224,874".
std::string with_commas(std::size_t number);

/// A row of what the thesis has, made full with dashes: its data set is absent.
std::vector<std::string> without_data(std::vector<std::string> row, std::size_t columns);

}  // namespace plume::bench
