// CGAL's Delaunay triangulation, with exact predicates. This file alone includes CGAL. One thread:
// CGAL's parallel insertion is slower on two cores (docs/evidence.md).
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

#include "plume/mesh/tetrahedralization_engines.h"

namespace plume {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

}  // namespace

bool has_cgal() { return true; }

Array cgal_delaunay(std::span<const double> points) {
  std::vector<std::pair<Kernel::Point_3, std::int32_t>> numbered;
  numbered.reserve(points.size() / 3);
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    numbered.emplace_back(Kernel::Point_3(points[i], points[i + 1], points[i + 2]),
                          static_cast<std::int32_t>(i / 3));
  const Triangulation triangulation(numbered.begin(), numbered.end());
  std::vector<std::int32_t> corners;
  if (triangulation.dimension() == 3) {
    corners.reserve(4 * triangulation.number_of_cells());
    // CGAL's cells are positively oriented, as VTK's are.
    for (const auto cell : triangulation.finite_cell_handles())
      for (int c = 0; c < 4; ++c) corners.push_back(cell->vertex(c)->info());
  }
  return Array::own(std::move(corners));
}

}  // namespace plume
