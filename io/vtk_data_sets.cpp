#include "plume/io/vtk_data_sets.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>

namespace plume {

std::vector<vtkSmartPointer<vtkDataSet>> data_sets_in(vtkDataObject& data) {
  std::vector<vtkSmartPointer<vtkDataSet>> found;
  if (auto* const set = vtkDataSet::SafeDownCast(&data)) {
    found.emplace_back(set);
  } else if (auto* const composite = vtkCompositeDataSet::SafeDownCast(&data)) {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
      if (auto* const part = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()))
        found.emplace_back(part);
  }
  return found;
}

}  // namespace plume
