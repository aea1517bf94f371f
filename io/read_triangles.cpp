// Formats of surfaces, by VTK's readers.
#include <vtkDataObject.h>
#include <vtkOBJReader.h>
#include <vtkSTLReader.h>

#include "plume/io/read_formats.h"
#include "plume/io/vtk_run_reader.h"

namespace plume {

OpenedFile open_stl(const std::filesystem::path& file, const ReadOptions&, const Notice& notice) {
  const auto reader = vtkSmartPointer<vtkSTLReader>::New();
  reader->SetFileName(file.string().c_str());
  return open_reader(reader, file, notice);
}

OpenedFile open_obj(const std::filesystem::path& file, const ReadOptions&, const Notice& notice) {
  const auto reader = vtkSmartPointer<vtkOBJReader>::New();
  reader->SetFileName(file.string().c_str());
  return open_reader(reader, file, notice);
}

}  // namespace plume
