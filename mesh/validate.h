/// Whether a mesh can be walked at all, and which of its cells are poor.
#pragma once

#include <vector>

#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"

namespace plume {

/// Checks what every later step relies on: finite coordinates, known cell types, offsets in order,
/// point ids in range, arrays of fitting lengths, axes in order (see rectilinear_axes.h), at least
/// one cell. Returns the mesh's bounds.
/// Throws Error naming the first point or cell that is wrong, the value and the remedy.
Bounds check_structure(const Mesh& mesh);

/// Cells with a signed volume below zero (inside out), of zero volume, or with repeated points, for
/// every type of cell. None of these stops a ray. Requires check_structure().
std::vector<Finding> find_poor_cells(const Mesh& mesh);

}  // namespace plume
