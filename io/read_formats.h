/// One function for each family of files; read_mesh.h chooses among them. All open a file and check
/// what can be checked without reading its arrays. They throw Error for what is wrong.
#pragma once

#include <filesystem>
#include <memory>

#include "plume/io/read_mesh.h"
#include "plume/io/step_reader.h"

namespace plume {

using OpenedFile = std::unique_ptr<StepReader>;

/// Any of those below, by the extension or as an OpenFOAM case's directory. Throws Error where the
/// file is missing, empty, or of no known format.
OpenedFile open_mesh(const std::filesystem::path& file, const ReadOptions& options,
                     const Notice& notice);

/// .vtu .pvtu .vts .pvts .vti .pvti .vtr .pvtr .vtp .vtm, and legacy .vtk.
OpenedFile open_vtk_file(const std::filesystem::path& file, const ReadOptions& options,
                         const Notice& notice);

/// ParaView's list of files by time step and part; the parts become blocks.
OpenedFile open_pvd(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice);

/// Plot3D grid, and solution file if the options name one, of any layout.
OpenedFile open_plot3d(const std::filesystem::path& file, const ReadOptions& options,
                       const Notice& notice);

OpenedFile open_exodus(const std::filesystem::path& file, const ReadOptions& options,
                       const Notice& notice);
OpenedFile open_ensight(const std::filesystem::path& file, const ReadOptions& options,
                        const Notice& notice);
/// `file` is any file in the case's directory, there or not: VTK wants only to know the directory.
OpenedFile open_openfoam(const std::filesystem::path& file, const ReadOptions& options,
                         const Notice& notice);
OpenedFile open_cgns(const std::filesystem::path& file, const ReadOptions& options,
                     const Notice& notice);
OpenedFile open_fluent(const std::filesystem::path& file, const ReadOptions& options,
                       const Notice& notice);

/// x, y, z and values of a point on each line (.csv, .xyz), separated by commas, semicolons, tabs
/// or blanks, with or without a header of names.
OpenedFile open_point_table(const std::filesystem::path& file, const ReadOptions& options,
                            const Notice& notice);
/// .xyz: a Plot3D grid where it is one, else a point table.
OpenedFile open_xyz(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice);
/// With all properties of vertices, and polygons where there are any.
OpenedFile open_ply(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice);
OpenedFile open_stl(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice);
OpenedFile open_obj(const std::filesystem::path& file, const ReadOptions& options,
                    const Notice& notice);

/// What the step that the options ask for holds, by default the last, of a file of any format.
/// Throws Error as open_mesh(), and where there is no such step.
vtkSmartPointer<vtkDataObject> read_data(const std::filesystem::path& file,
                                         const ReadOptions& options, const Notice& notice);

}  // namespace plume
