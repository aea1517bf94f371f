/// A Mesh as what VTK's writers take.
#pragma once

#include <vtkSmartPointer.h>

#include "plume/mesh/mesh.h"

class vtkDataSet;

namespace plume {

/// Both read the mesh's arrays where they are, so the mesh must outlive what they return. Hidden
/// cells are marked in VTK's ghost array.

/// A vtkRectilinearGrid. Requires a rectilinear grid.
vtkSmartPointer<vtkDataSet> rectilinear_from(const Mesh& mesh);

/// A vtkImageData between the ends of the axes. Requires a regular grid (see uneven_place()).
vtkSmartPointer<vtkDataSet> image_from(const Mesh& mesh);

/// A vtkStructuredGrid. Requires a curvilinear grid.
vtkSmartPointer<vtkDataSet> structured_from(const Mesh& mesh);

/// A vtkUnstructuredGrid; a curvilinear grid's cells become hexahedra. Requires points.
vtkSmartPointer<vtkDataSet> unstructured_from(const Mesh& mesh);

}  // namespace plume
