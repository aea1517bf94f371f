/// Whether a mesh stays from one time step to the next.
#pragma once

#include "plume/mesh/mesh.h"

namespace plume {

/// True where two meshes have the same points and cells (types, connectivity, polyhedra, hidden
/// cells), bit for bit and in arrays of the same types: what is made of one holds for the other.
/// Fields are not looked at. Arrays that share their memory are the same without a look, others
/// cost one pass over them.
bool same_points_and_cells(const Mesh& a, const Mesh& b);

}  // namespace plume
