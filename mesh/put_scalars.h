/// New values for a walkable mesh that is there already.
#pragma once

#include "plume/mesh/scalar_field.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Replaces the scalars of a walkable mesh and nothing else: afterwards it is bit for bit what
/// would have been made of the user's mesh with that field. In parallel. Not to be called while
/// others read the mesh.
///
/// Requires a field of as many values as the user's mesh has points or cells, of the association
/// that the walkable mesh was made with; of tetrahedra and cells, `point_numbers` for a field of
/// points and `original_cells` for one of cells.
void put_scalars(WalkableTets& mesh, ScalarField scalar);
void put_scalars(WalkableCells& mesh, ScalarField scalar);
void put_scalars(WalkableGrid& mesh, ScalarField scalar);
void put_scalars(WalkableRectilinear& mesh, ScalarField scalar);

}  // namespace plume
