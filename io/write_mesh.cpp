#include "plume/io/write_mesh.h"

#include <vtkDataSet.h>
#include <vtkDataSetWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
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
  if (extension == ".vti")
    return write_xml(*vtkSmartPointer<vtkXMLImageDataWriter>::New(), file, data);
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
  constexpr std::array kExtensions{".vtu", ".vts", ".vtr", ".vti", ".vtk"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
    throw Error(file.string() +
                ": not a format that can be written; name it .vtu, .vts, .vtr, .vti or .vtk");
  if (extension == ".vts" && !mesh.is_grid())
    throw Error(file.string() +
                ": .vts holds a structured grid, and the mesh has explicit cells; write .vtu");
  if (mesh.is_rectilinear()) try {
      check_axes(mesh);
    } catch (const Error& error) {
      throw Error(file.string() + ": " + error.what());
    }
  const bool holds_axes = extension == ".vtr" || extension == ".vti";
  if (holds_axes && !mesh.is_rectilinear())
    throw Error(
        file.string() + ": " + extension + " holds a rectilinear grid, and the mesh " +
        (mesh.is_grid() ? "is a curvilinear one; write .vts" : "has explicit cells; write .vtu"));
  if (extension == ".vti")
    for (std::size_t a = 0; a < 3; ++a)
      if (const auto place = uneven_place(mesh.axes[a]))
        throw Error(file.string() + ": .vti holds a regular grid, and the " + "xyz"[a] +
                    " coordinates are not equidistant at " + std::to_string(*place) +
                    "; write .vtr");
  check_writable(file);
}

vtkSmartPointer<vtkDataSet> data_for(const Mesh& mesh, const std::string& extension) {
  if (extension == ".vtu") return unstructured_from(mesh);
  if (extension == ".vti") return image_from(mesh);
  if (mesh.is_rectilinear()) return rectilinear_from(mesh);
  return mesh.is_grid() ? structured_from(mesh) : unstructured_from(mesh);
}

}  // namespace

void write_mesh(const Mesh& mesh, const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  check_destination(mesh, file, extension);
  WholeFile whole(file);
  bool written = false;
  with_vtk_errors(file, {}, "check the free space", [&] {
    // VTK is lent the mesh's arrays, so what is lent lives until it is written.
    const bool points_wanted = extension == ".vtu" || extension == ".vts";
    const Mesh lent = mesh.is_rectilinear() && points_wanted ? with_points(mesh) : mesh;
    const auto data = data_for(lent, extension);
    written = write_data(extension, whole.path().string(), *data);
  });
  if (!written)
    throw Error(file.string() + ": could not be written to its end; check the free space");
  whole.keep();
}

}  // namespace plume
