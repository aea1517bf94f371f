/// The one type of exception that Plume throws.
#pragma once

#include <stdexcept>

namespace plume {

/// Bad input: a file, a mesh, a field, a setting. what() is one line that names the file, the cell
/// or the array, the value, and the remedy. Programming errors are asserted, not thrown.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plume
