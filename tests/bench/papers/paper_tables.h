/// The tables of the papers that Plume builds on, theirs beside ours: plume_papers.
#pragma once

#include <string>
#include <vector>

namespace plume::bench {

struct PaperOptions {
  /// Tiny pictures and meshes, each measured once: to see that all of it runs. The numbers say
  /// nothing.
  bool quick = false;
  /// How often each is measured, in turns; medians are reported.
  int rounds = 3;
};

struct PaperTable {
  std::string name;   ///< as the command takes it
  std::string title;  ///< of its heading
  /// Measures and returns markdown: what theirs is, on what hardware, what corresponds in ours and
  /// what does not, and the table. Throws Error where ours is not of the same thing as what it is
  /// compared with.
  std::string (*make)(const PaperOptions& options);
};

/// All of them, in the order of the papers.
const std::vector<PaperTable>& paper_tables();

/// G. Marmitt, "Interactive Volume Ray Tracing" (Saarland University, 2008). The last three are
/// tables of frames a second.
std::string thesis_table_4_5(const PaperOptions& options);
std::string thesis_table_6_1(const PaperOptions& options);   ///< Plücker tests and cells a second
std::string thesis_table_6_2(const PaperOptions& options);   ///< tetrahedra a second
std::string thesis_table_6_3(const PaperOptions& options);   ///< frames: isosurface, tetrahedra
std::string thesis_table_6_4(const PaperOptions& options);   ///< frames: volume, tetrahedra
std::string thesis_table_6_5(const PaperOptions& options);   ///< hexahedra a second
std::string thesis_table_6_6(const PaperOptions& options);   ///< frames: isosurface, hexahedra
std::string thesis_table_6_7(const PaperOptions& options);   ///< frames: volume, hexahedra
std::string thesis_table_6_8(const PaperOptions& options);   ///< the data sets
std::string thesis_table_6_9(const PaperOptions& options);   ///< frames of all kinds, tetrahedra
std::string thesis_table_6_10(const PaperOptions& options);  ///< frames of all kinds, hexahedra

/// El Hajjar, Marchesin, Dischler and Mongenet, "Second Order Pre-Integrated Volume Rendering"
/// (PacificVis 2008).
std::string el_hajjar_figure_7(const PaperOptions& options);
std::string el_hajjar_figure_8(const PaperOptions& options);
std::string el_hajjar_figure_9(const PaperOptions& options);

/// Ament, Weiskopf and Carr, "Direct Interval Volume Visualization" (TVCG 2010).
std::string intervals_table_1(const PaperOptions& options);

}  // namespace plume::bench
