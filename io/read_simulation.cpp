// The formats of simulation codes and of their preprocessors.
#include <vtkCGNSReader.h>
#include <vtkExodusIIReader.h>
#include <vtkFLUENTReader.h>
#include <vtkGenericEnSightReader.h>
#include <vtkOpenFOAMReader.h>

#include <string>
#include <vector>

#include "plume/io/read_ensight_case.h"
#include "plume/io/read_file.h"
#include "plume/io/read_fluent_case.h"
#include "plume/io/read_formats.h"
#include "plume/io/read_netcdf_length.h"
#include "plume/io/vtk_run_reader.h"
#include "plume/mesh/error.h"

namespace plume {

OpenedFile open_exodus(const std::filesystem::path& file, const ReadOptions&,
                       const Notice& notice) {
  const std::string start = first_bytes(file, 8);
  if (!looks_like_netcdf(start) && !looks_like_hdf5(start))
    throw Error(file.string() +
                ": no Exodus file, which starts as netCDF or HDF5 files do; check "
                "that it is what its name says");
  check_netcdf_or_hdf5_length(file);
  const auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(file.string().c_str());
  reader->GenerateObjectIdCellArrayOff();
  reader->GenerateGlobalElementIdArrayOff();
  reader->GenerateGlobalNodeIdArrayOff();
  return open_reader(reader, file, notice, [&] {
    // Results are off by default.
    reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
    reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
  });
}

OpenedFile open_ensight(const std::filesystem::path& file, const ReadOptions&,
                        const Notice& notice) {
  check_ensight_case(file);
  const auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
  reader->SetCaseFileName(file.string().c_str());
  return open_reader(reader, file, notice);
}

OpenedFile open_openfoam(const std::filesystem::path& file, const ReadOptions&,
                         const Notice& notice) {
  const auto directory = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::exists(directory / "system" / "controlDict"))
    throw Error(file.string() + ": " + directory.string() +
                " has no system/controlDict; put the .foam file into the case's directory");
  if (!std::filesystem::exists(directory / "constant" / "polyMesh") &&
      std::filesystem::exists(directory / "processor0"))
    throw Error(file.string() +
                ": a decomposed OpenFOAM case; put it together with reconstructPar first");
  const auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
  reader->SetFileName(file.string().c_str());
  reader->DecomposePolyhedraOff();
  // Point data made of cell data would blur what the solver computed.
  reader->CreateCellToPointOff();
  return open_reader(reader, file, notice, [&] {
    for (int i = 0; i < reader->GetNumberOfPatchArrays(); ++i) {
      const std::string name = reader->GetPatchArrayName(i);
      reader->SetPatchArrayStatus(name.c_str(), name.ends_with("internalMesh"));
    }
  });
}

OpenedFile open_cgns(const std::filesystem::path& file, const ReadOptions&, const Notice& notice) {
  const std::string start = first_bytes(file, 64);
  if (!looks_like_hdf5(start) && start.find("ADF Database") == std::string::npos)
    throw Error(file.string() +
                ": no CGNS file, which starts as HDF5 or ADF files do; check that "
                "it is what its name says");
  check_netcdf_or_hdf5_length(file);
  const auto reader = vtkSmartPointer<vtkCGNSReader>::New();
  reader->SetFileName(file.string().c_str());
  return open_reader(reader, file, notice, [&] {
    reader->EnableAllBases();
    reader->EnableAllFamilies();
    reader->EnableAllPointArrays();
    reader->EnableAllCellArrays();
  });
}

OpenedFile open_fluent(const std::filesystem::path& file, const ReadOptions&,
                       const Notice& notice) {
  const std::string start = first_bytes(file, 64);
  if (start.starts_with("$MeshFormat"))
    throw Error(file.string() + ": a Gmsh mesh, not a Fluent one; convert it to .vtk with gmsh");
  if (start.find('(') == std::string::npos)
    throw Error(file.string() +
                ": no Fluent case or mesh, which starts with '('; check that it is what its name "
                "says");
  check_fluent_case(file);
  const auto data_file = std::filesystem::path(file).replace_extension(".dat");
  std::vector<std::string> expected;
  if (!std::filesystem::exists(data_file)) {
    // VTK calls that an error.
    expected = {"Could not open data file", "Unable to open dat file"};
    if (notice)
      notice(file.string() + ": no " + data_file.filename().string() +
             " beside it, so that the mesh has no fields");
  }
  const auto reader = vtkSmartPointer<vtkFLUENTReader>::New();
  reader->SetFileName(file.string().c_str());
  return open_reader(
      reader, file, notice, [&] { reader->EnableAllCellArrays(); }, expected);
}

}  // namespace plume
