/// One function for each family of files; read_mesh.h chooses among them.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>

#include "plume/io/read_mesh.h"

class vtkDataObject;

namespace plume {

/// .vtu .pvtu .vts .pvts .vti .pvti .vtr .pvtr .vtp .vtm, and legacy .vtk.
vtkSmartPointer<vtkDataObject> read_vtk_file(const std::filesystem::path& file,
                                             const ReadOptions& options, const Notice& notice);

/// ParaView's list of files by time step and part; the parts become blocks.
vtkSmartPointer<vtkDataObject> read_pvd(const std::filesystem::path& file,
                                        const ReadOptions& options, const Notice& notice);

/// Plot3D grid, and solution file if the options name one, of any layout.
vtkSmartPointer<vtkDataObject> read_plot3d(const std::filesystem::path& file,
                                           const ReadOptions& options, const Notice& notice);

vtkSmartPointer<vtkDataObject> read_exodus(const std::filesystem::path& file,
                                           const ReadOptions& options, const Notice& notice);
vtkSmartPointer<vtkDataObject> read_ensight(const std::filesystem::path& file,
                                            const ReadOptions& options, const Notice& notice);
/// `file` is any file in the case's directory, there or not: VTK wants only to know the directory.
vtkSmartPointer<vtkDataObject> read_openfoam(const std::filesystem::path& file,
                                             const ReadOptions& options, const Notice& notice);
vtkSmartPointer<vtkDataObject> read_cgns(const std::filesystem::path& file,
                                         const ReadOptions& options, const Notice& notice);
vtkSmartPointer<vtkDataObject> read_fluent(const std::filesystem::path& file,
                                           const ReadOptions& options, const Notice& notice);

/// x, y, z and values of a point on each line (.csv, .xyz), separated by commas, semicolons, tabs
/// or blanks, with or without a header of names.
vtkSmartPointer<vtkDataObject> read_point_table(const std::filesystem::path& file,
                                                const ReadOptions& options, const Notice& notice);
/// .xyz: a Plot3D grid where it is one, else a point table.
vtkSmartPointer<vtkDataObject> read_xyz(const std::filesystem::path& file,
                                        const ReadOptions& options, const Notice& notice);
/// With all properties of vertices, and polygons where there are any.
vtkSmartPointer<vtkDataObject> read_ply(const std::filesystem::path& file,
                                        const ReadOptions& options, const Notice& notice);
vtkSmartPointer<vtkDataObject> read_stl(const std::filesystem::path& file,
                                        const ReadOptions& options, const Notice& notice);
vtkSmartPointer<vtkDataObject> read_obj(const std::filesystem::path& file,
                                        const ReadOptions& options, const Notice& notice);

/// A file of any known format, chosen by its extension (read_mesh.h).
vtkSmartPointer<vtkDataObject> read_data(const std::filesystem::path& file,
                                         const ReadOptions& options, const Notice& notice);

}  // namespace plume
