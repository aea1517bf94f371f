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

using Opener = OpenedFile (*)(const std::filesystem::path&, const ReadOptions&, const Notice&);

struct Format {
  std::string_view extension;
  Opener open;
};

// Both Plot3D and Exodus claim .g; the first bytes tell.
OpenedFile open_g(const std::filesystem::path& file, const ReadOptions& options,
                  const Notice& notice) {
  const std::string start = first_bytes(file, 8);
  const bool exodus = looks_like_netcdf(start) || looks_like_hdf5(start);
  return (exodus ? open_exodus : open_plot3d)(file, options, notice);
}

constexpr std::array formats{
    Format{".vtu", open_vtk_file},  Format{".pvtu", open_vtk_file},
    Format{".vtk", open_vtk_file},  Format{".vts", open_vtk_file},
    Format{".pvts", open_vtk_file}, Format{".vti", open_vtk_file},
    Format{".pvti", open_vtk_file}, Format{".vtr", open_vtk_file},
    Format{".pvtr", open_vtk_file}, Format{".vtm", open_vtk_file},
    Format{".pvd", open_pvd},       Format{".xyz", open_xyz},
    Format{".x", open_plot3d},      Format{".g", open_g},
    Format{".p3d", open_plot3d},    Format{".bin", open_plot3d},
    Format{".fmt", open_plot3d},    Format{".grid", open_plot3d},
    Format{".e", open_exodus},      Format{".ex2", open_exodus},
    Format{".exo", open_exodus},    Format{".exii", open_exodus},
    Format{".case", open_ensight},  Format{".foam", open_openfoam},
    Format{".vtp", open_vtk_file},  Format{".csv", open_point_table},
    Format{".ply", open_ply},       Format{".stl", open_stl},
    Format{".obj", open_obj},       Format{".cgns", open_cgns},
    Format{".cas", open_fluent},    Format{".msh", open_fluent},
};

Opener opener_for(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  for (const Format& format : formats)
    if (format.extension == extension) return format.open;
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

OpenedFile open_mesh(const std::filesystem::path& file, const ReadOptions& options,
                     const Notice& notice) {
  if (is_openfoam_case(file)) return open_openfoam(file / "case.foam", options, notice);
  if (std::filesystem::is_directory(file))
    throw Error(file.string() +
                ": is a directory and no OpenFOAM case (it has no system/controlDict); name a mesh "
                "file in it");
  const Opener open = opener_for(file);
  // OpenFOAM users mark a case with an empty file.
  check_readable(file, open == &open_openfoam);
  const bool plot3d = open == &open_plot3d || open == &open_g || open == &open_xyz;
  if (!plot3d && !options.solution.empty())
    throw Error(options.solution.string() + ": a solution file goes with a Plot3D grid, and " +
                file.string() + " is none; leave it out");
  return open(file, options, notice);
}

vtkSmartPointer<vtkDataObject> read_data(const std::filesystem::path& file,
                                         const ReadOptions& options, const Notice& notice) {
  const OpenedFile opened = open_mesh(file, options, notice);
  const int last = static_cast<int>(opened->step_count()) - 1;
  const int step = options.time_step.value_or(last);
  if (step < 0 || step > last)
    throw Error(file.string() + ": there is no time step " + std::to_string(step) +
                "; choose one from 0 to " + std::to_string(last));
  return opened->read(static_cast<std::size_t>(step), notice);
}

Mesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
               const Notice& notice) {
  return mesh_from_vtk(*read_data(file, options, notice), file, options, notice);
}

}  // namespace plume
