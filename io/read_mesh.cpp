#include "plume/io/read_mesh.h"

#include <vtkDataObject.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "plume/io/read_file.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_to_mesh.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

using Reader = vtkSmartPointer<vtkDataObject> (*)(const std::filesystem::path&, const ReadOptions&,
                                                  const Notice&);

struct Format {
  std::string_view extension;
  Reader read;
};

// Both Plot3D and Exodus claim .g; the first bytes tell.
vtkSmartPointer<vtkDataObject> read_g(const std::filesystem::path& file, const ReadOptions& options,
                                      const Notice& notice) {
  const std::string start = first_bytes(file, 8);
  const bool exodus = looks_like_netcdf(start) || looks_like_hdf5(start);
  return (exodus ? read_exodus : read_plot3d)(file, options, notice);
}

constexpr std::array formats{
    Format{".vtu", read_vtk_file},  Format{".pvtu", read_vtk_file},
    Format{".vtk", read_vtk_file},  Format{".vts", read_vtk_file},
    Format{".pvts", read_vtk_file}, Format{".vti", read_vtk_file},
    Format{".pvti", read_vtk_file}, Format{".vtr", read_vtk_file},
    Format{".pvtr", read_vtk_file}, Format{".vtm", read_vtk_file},
    Format{".pvd", read_pvd},       Format{".xyz", read_xyz},
    Format{".x", read_plot3d},      Format{".g", read_g},
    Format{".p3d", read_plot3d},    Format{".bin", read_plot3d},
    Format{".fmt", read_plot3d},    Format{".grid", read_plot3d},
    Format{".e", read_exodus},      Format{".ex2", read_exodus},
    Format{".exo", read_exodus},    Format{".exii", read_exodus},
    Format{".case", read_ensight},  Format{".foam", read_openfoam},
    Format{".vtp", read_vtk_file},  Format{".csv", read_point_table},
    Format{".ply", read_ply},       Format{".stl", read_stl},
    Format{".obj", read_obj},       Format{".cgns", read_cgns},
    Format{".cas", read_fluent},    Format{".msh", read_fluent},
};

Reader reader_for(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  for (const Format& format : formats)
    if (format.extension == extension) return format.read;
  std::string known;
  for (const auto& name : mesh_file_extensions()) known += " " + name;
  throw Error(file.string() + ": " +
              (extension.empty() ? "no extension" : "unknown extension '" + extension + "'") +
              "; rename it to one of" + known);
}

bool is_openfoam_case(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / "system" / "controlDict");
}

}  // namespace

std::vector<std::string> mesh_file_extensions() {
  std::vector<std::string> extensions;
  for (const Format& format : formats) extensions.emplace_back(format.extension);
  return extensions;
}

vtkSmartPointer<vtkDataObject> read_data(const std::filesystem::path& file,
                                         const ReadOptions& options, const Notice& notice) {
  if (is_openfoam_case(file)) return read_openfoam(file / "case.foam", options, notice);
  if (std::filesystem::is_directory(file))
    throw Error(file.string() +
                ": is a directory and no OpenFOAM case (it has no system/controlDict); name a mesh "
                "file in it");
  const Reader read = reader_for(file);
  // OpenFOAM users mark a case with an empty file.
  check_readable(file, read == &read_openfoam);
  const bool plot3d = read == &read_plot3d || read == &read_g || read == &read_xyz;
  if (!plot3d && !options.solution.empty())
    throw Error(options.solution.string() + ": a solution file goes with a Plot3D grid, and " +
                file.string() + " is none; leave it out");
  return read(file, options, notice);
}

Mesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
               const Notice& notice) {
  const auto data = read_data(file, options, notice);
  return mesh_from_vtk(*data, file, options, notice);
}

}  // namespace plume
