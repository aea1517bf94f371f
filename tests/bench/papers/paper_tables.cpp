#include "plume/tests/bench/papers/paper_tables.h"

namespace plume::bench {

const std::vector<PaperTable>& paper_tables() {
  static const std::vector<PaperTable> tables{
      {"thesis-4.5", "Thesis, table 4.5: intersecting a voxel with an isosurface",
       thesis_table_4_5},
      {"thesis-6.1", "Thesis, table 6.1: Plücker tests a tetrahedron", thesis_table_6_1},
      {"thesis-6.2", "Thesis, table 6.2: tetrahedra a second", thesis_table_6_2},
      {"thesis-6.3", "Thesis, table 6.3: isosurfaces of tetrahedra, frames a second",
       thesis_table_6_3},
      {"thesis-6.4", "Thesis, table 6.4: volumes of tetrahedra, frames a second", thesis_table_6_4},
      {"thesis-6.5", "Thesis, table 6.5: hexahedra a second", thesis_table_6_5},
      {"thesis-6.6", "Thesis, table 6.6: isosurfaces of hexahedra, frames a second",
       thesis_table_6_6},
      {"thesis-6.7", "Thesis, table 6.7: volumes of hexahedra, frames a second", thesis_table_6_7},
      {"thesis-6.8", "Thesis, table 6.8: the data sets", thesis_table_6_8},
      {"thesis-6.9", "Thesis, table 6.9: all kinds of pictures of tetrahedra, frames a second",
       thesis_table_6_9},
      {"thesis-6.10", "Thesis, table 6.10: all kinds of pictures of hexahedra, frames a second",
       thesis_table_6_10},
      {"el-hajjar-7", "El Hajjar et al., figure 7: first and second order, Neghip",
       el_hajjar_figure_7},
      {"el-hajjar-8", "El Hajjar et al., figure 8: first and second order, Fuel",
       el_hajjar_figure_8},
      {"el-hajjar-9", "El Hajjar et al., figure 9: first and second order, Bucky Ball",
       el_hajjar_figure_9},
      {"intervals-1", "Ament et al., table 1: a volume with interval volumes, frames a second",
       intervals_table_1},
  };
  return tables;
}

}  // namespace plume::bench
