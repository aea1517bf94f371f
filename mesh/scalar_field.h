/// Which scalar is traced: chosen from a mesh's fields by name, component or magnitude.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// A request as users write it: "NAME", "NAME:0" (a component, from 0) or "NAME:magnitude".
struct FieldRequest {
  /// Empty: the mesh's active field, else its first.
  std::string name;
  /// Take this association where a point and a cell field share a name; point data first otherwise.
  std::optional<Association> association;
};

/// One number for every point or cell.
struct ScalarField {
  /// As users would ask for it: "velocity:magnitude".
  std::string name;
  Association association = Association::point;  ///< where the values are
  /// Values that are not finite are NaN here; they are transparent.
  std::vector<float> values;
  /// Least and greatest finite value; both 0 where there is none.
  float low = 0;
  float high = 0;  ///< see low
  /// How many values were NaN or infinite.
  std::size_t not_finite = 0;
};

/// Extracts the requested scalar. A vector without a component asked for gives its magnitude.
/// Throws Error, listing the fields there are, where the name is unknown, the component is out of
/// range, or the array's length is not that of the points or cells.
ScalarField select_field(const Mesh& mesh, const FieldRequest& request = {});

/// The fields of a mesh for messages: "Density (point), Velocity (point, 3 components)".
std::string list_fields(const Mesh& mesh);

}  // namespace plume
