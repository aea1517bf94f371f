/// A Mesh as what VTK's writers take.
#pragma once

#include <vtkSmartPointer.h>

#include "plume/mesh/mesh.h"

class vtkDataSet;

namespace plume {

/// Both read the mesh's arrays where they are, so the mesh must outlive what they return. Hidden
/// cells are marked in VTK's ghost array.

/// A vtkStructuredGrid. Requires a grid.
vtkSmartPointer<vtkDataSet> structured_from(const Mesh& mesh);

/// A vtkUnstructuredGrid; a grid's cells become hexahedra.
vtkSmartPointer<vtkDataSet> unstructured_from(const Mesh& mesh);

}  // namespace plume
