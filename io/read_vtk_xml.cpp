// VTK's own formats: the XML family and the legacy format.
#include <vtkGenericDataObjectReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPRectilinearGridReader.h>
#include <vtkXMLPStructuredGridReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "plume/io/read_file.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_run_reader.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

vtkSmartPointer<vtkXMLReader> xml_reader_for(const std::string& extension) {
  if (extension == ".vtu") return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  if (extension == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  if (extension == ".vts") return vtkSmartPointer<vtkXMLStructuredGridReader>::New();
  if (extension == ".vti") return vtkSmartPointer<vtkXMLImageDataReader>::New();
  if (extension == ".vtr") return vtkSmartPointer<vtkXMLRectilinearGridReader>::New();
  if (extension == ".pvtu") return vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
  if (extension == ".pvts") return vtkSmartPointer<vtkXMLPStructuredGridReader>::New();
  if (extension == ".pvti") return vtkSmartPointer<vtkXMLPImageDataReader>::New();
  if (extension == ".pvtr") return vtkSmartPointer<vtkXMLPRectilinearGridReader>::New();
  return vtkSmartPointer<vtkXMLMultiBlockDataReader>::New();
}

OpenedFile open_legacy(const std::filesystem::path& file, const Notice& notice) {
  if (!first_bytes(file, 32).starts_with("# vtk DataFile Version"))
    throw Error(file.string() +
                ": not a legacy VTK file, which starts with '# vtk DataFile Version'; check that "
                "it is what its name says");
  const auto reader = vtkSmartPointer<vtkGenericDataObjectReader>::New();
  reader->SetFileName(file.string().c_str());
  // By default only the first array of each kind is read.
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  return open_reader(reader, file, notice);
}

}  // namespace

OpenedFile open_vtk_file(const std::filesystem::path& file, const ReadOptions&,
                         const Notice& notice) {
  const std::string extension = lower_extension(file);
  if (extension == ".vtk") return open_legacy(file, notice);
  check_vtk_xml_end(file);
  const auto reader = xml_reader_for(extension);
  reader->SetFileName(file.string().c_str());
  return open_reader(reader, file, notice);
}

}  // namespace plume
