/// Meshes from files: whatever VTK reads that a CFD user has.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"
#include "plume/mesh/tetrahedralize.h"

namespace plume {

/// What a file's name does not say.
struct ReadOptions {
  /// Plot3D: the q file that belongs to the grid.
  std::filesystem::path solution{};
  /// Merge points of neighbouring blocks that have the same coordinates, bit for bit.
  bool merge_points = false;
  /// Which time step of a file that holds several (.pvd, Exodus, EnSight, OpenFOAM, CGNS); the last
  /// by default. 0 is the first.
  std::optional<int> time_step{};
  /// What makes tetrahedra of points without cells.
  TetrahedralizationEngine engine = TetrahedralizationEngine::automatic;
};

/// Something the user should know though it is no error: "12 triangles dropped: not volume cells".
using Notice = std::function<void(const std::string&)>;

/// Reads a mesh with all of its fields, converting as little as it can: arrays are borrowed from
/// VTK where the types allow it.
///
/// Formats, by extension: .vtu .pvtu .vtk .vts .pvts .vti .pvti .vtr .pvtr .vtm .pvd, Plot3D (.xyz
/// .x .g .p3d .bin .fmt .grid, binary or text, either byte order, one block or several), Exodus II
/// (.e .ex2 .exo .exii .g where it is no Plot3D), EnSight Gold (.case), OpenFOAM (.foam, or a case
/// directory), CGNS (.cgns), Fluent (.cas, .msh); points without cells: .csv, .xyz, .ply, .vtp.
///
/// Points without cells (VTK's files may hold them, too: data sets whose cells are vertices, or
/// that have fields and no cells) become tetrahedra (tetrahedralize.h), and a notice says so.
/// Closed surfaces do not: see read_surface.h.
///
/// One block of a structured grid stays a grid (`Mesh::dimensions`), one of a rectilinear grid or
/// an image a rectilinear one (`Mesh::axes`) unless the image is turned; several blocks, and
/// everything else, become explicit cells. Cells that are not volumes are dropped and counted in a
/// notice, quadratic cells are represented by their corners.
///
/// Throws Error where the file is missing, truncated, of no known format, or without volume cells.
Mesh read_mesh(const std::filesystem::path& file, const ReadOptions& options = {},
               const Notice& notice = {});

/// The extensions read_mesh() knows, for messages.
std::vector<std::string> mesh_file_extensions();

}  // namespace plume
