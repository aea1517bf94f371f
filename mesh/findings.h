/// What building a walkable mesh found: nothing that stops a ray, but what a user should know.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plume {

/// One kind of problem, with the first few cells (numbers of the user's mesh) as examples.
struct Finding {
  std::string what;                   ///< in words, to follow a number
  std::size_t count = 0;              ///< how many there are
  std::vector<std::size_t> examples;  ///< the first few
};

/// "12 cells inside out, among them 5, 17, 23"
std::string describe(const Finding& finding);

/// Adds a cell to a finding, keeping the smallest few numbers as examples.
void add_example(Finding& finding, std::size_t cell);

}  // namespace plume
