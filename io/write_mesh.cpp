#include "plume/io/write_mesh.h"

#include <vtkDataSet.h>
#include <vtkDataSetWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <string>

#include "plume/io/read_file.h"
#include "plume/io/vtk_errors.h"
#include "plume/io/vtk_from_mesh.h"
#include "plume/io/whole_file.h"
#include "plume/mesh/error.h"
#include "plume/mesh/rectilinear_axes.h"

namespace plume {
namespace {

// Uncompressed and not encoded: exact, fast, and read without a copy.
bool write_xml(vtkXMLWriter& writer, const std::string& file, vtkDataSet& data) {
  writer.SetFileName(file.c_str());
  writer.SetInputData(&data);
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToNone();
  writer.SetHeaderTypeToUInt64();
  return writer.Write() == 1;
}

bool write_data(const std::string& extension, const std::string& file, vtkDataSet& data) {
  if (extension == ".vtu")
    return write_xml(*vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New(), file, data);
  if (extension == ".vts")
    return write_xml(*vtkSmartPointer<vtkXMLStructuredGridWriter>::New(), file, data);
  if (extension == ".vtr")
    return write_xml(*vtkSmartPointer<vtkXMLRectilinearGridWriter>::New(), file, data);
  const auto writer = vtkSmartPointer<vtkDataSetWriter>::New();
  writer->SetFileName(file.c_str());
  writer->SetInputData(&data);
  writer->SetFileTypeToBinary();
  return writer->Write() == 1 && writer->GetErrorCode() == 0;
}

void check_destination(const Mesh& mesh, const std::filesystem::path& file,
                       const std::string& extension) {
  if (extension != ".vtu" && extension != ".vts" && extension != ".vtr" && extension != ".vtk")
    throw Error(file.string() +
                ": not a format that can be written; name it .vtu, .vts, .vtr or .vtk");
  if (extension == ".vts" && !mesh.is_grid())
    throw Error(file.string() +
                ": .vts holds a structured grid, and the mesh has explicit cells; write .vtu");
  if (extension == ".vtr" && !mesh.is_rectilinear())
    throw Error(
        file.string() + ": .vtr holds a rectilinear grid, and the mesh " +
        (mesh.is_grid() ? "is a curvilinear one; write .vts" : "has explicit cells; write .vtu"));
  check_writable(file);
}

}  // namespace

void write_mesh(const Mesh& mesh, const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  check_destination(mesh, file, extension);
  WholeFile whole(file);
  bool written = false;
  with_vtk_errors(file, {}, "check the free space", [&] {
    const bool as_axes = mesh.is_rectilinear() && (extension == ".vtr" || extension == ".vtk");
    const bool as_grid = mesh.is_grid() && extension != ".vtu";
    // What VTK is lent must live until it is written.
    const Mesh given = mesh.is_rectilinear() && !as_axes ? with_points(mesh) : mesh;
    const auto data = as_axes   ? rectilinear_from(given)
                      : as_grid ? structured_from(given)
                                : unstructured_from(given);
    written = write_data(extension, whole.path().string(), *data);
  });
  if (!written)
    throw Error(file.string() + ": could not be written to its end; check the free space");
  whole.keep();
}

}  // namespace plume
