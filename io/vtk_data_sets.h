/// The data sets in what a reader gives.
#pragma once

#include <vtkSmartPointer.h>

#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace plume {

/// The data set itself, or the leaves of a composite one in their order.
std::vector<vtkSmartPointer<vtkDataSet>> data_sets_in(vtkDataObject& data);

}  // namespace plume
