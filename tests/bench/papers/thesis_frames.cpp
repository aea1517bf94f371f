// The thesis' tables of frames a second, 6.3, 6.4, 6.6, 6.7, 6.9 and 6.10, and of its data
// sets, 6.8.

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/papers/frame_rates.h"
#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/thesis_meshes.h"

namespace plume::bench {
namespace {

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

// What the thesis has for a data set in pictures of 512 and of 1024 pixels along each side.
using Theirs = std::array<Row, 2>;

std::string fps(double rate) { return fmt::format("{:.2f}", rate); }
std::string times(double ratio) { return fmt::format("{:.2f}", ratio); }

Row pair_of(const std::array<double, 2>& rates) { return {fps(rates[0]), fps(rates[1])}; }

void append(Row& row, const Row& more) { row.insert(row.end(), more.begin(), more.end()); }

// A row for each data set and size of a picture: theirs, then what `ours(rates)` says.
template <class Ours>
std::string table(Family family, const PaperOptions& options, const Row& header,
                  const std::vector<Theirs>& theirs, const Ours& ours) {
  Rows rows{header};
  std::size_t at = 0;
  for (const ThesisMesh& source : thesis_meshes(family, options.quick)) {
    const Theirs& of_mesh = theirs[at++];
    const auto rates = frame_rates(source, options);
    for (std::size_t s = 0; s < 2; ++s) {
      Row row{s == 0 ? source.name : "", std::to_string(kThesisSizes[s])};
      append(row, of_mesh[s]);
      if (rates)
        append(row, ours((*rates)[s]));
      else
        row = without_data(row, header.size());
      rows.push_back(row);
    }
  }
  return markdown_table(rows);
}

std::string head(const char* page) {
  return std::string(page) +
         R"(Thesis: eight dual-core 2 GHz Opteron 870, 64 GB; numbers of cores as given. Here: one and two threads, one by
its time on the processor, two by the clock; more cores than two have no counterpart. Means of four views, along the axes
and from a corner; medians.

)";
}

}  // namespace

std::string thesis_table_6_3(const PaperOptions& options) {
  return head("Page 144. ") +
         R"(Here: an opaque isosurface half way through the field's values, of one colour without light, with first hits. Scalar: walked
ray by ray, which is what the thesis does; otherwise a hierarchy of cells is asked, as only the surface is to be seen.
The thesis says neither its isovalues nor, here, whether it computes normals. "2.32" stands there for two cores and 1024.

)" +
         table(Family::tetrahedra, options,
               {"data set", "size", "thesis, fps, cores: 1", "2", "4", "8", "12", "16",
                "Plume, scalar: 1 thread", "Plume: 1", "2 threads"},
               {{{{"1.13", "2.29", "4.59", "9.32", "12.86", "15.78"},
                  {"0.29", "2.32", "1.17", "2.34", "3.47", "4.61"}}},
                {{{"0.86", "1.72", "3.46", "6.91", "10.34", "13.86"},
                  {"0.22", "0.44", "0.87", "1.75", "2.61", "3.34"}}},
                {{{"0.77", "1.55", "3.10", "6.15", "9.24", "12.04"},
                  {"0.20", "0.39", "0.78", "1.57", "2.33", "2.87"}}}},
               [](const FrameRates& rates) {
                 Row row{fps(rates.isosurface_scalar)};
                 append(row, pair_of(rates.isosurface));
                 return row;
               });
}

std::string thesis_table_6_4(const PaperOptions& options) {
  return head("Page 145. ") +
         R"(Here: a volume of seven knots in closed form, first hits included, rays ended at a transmittance of 1e-4; in the thesis
"when the absorption reaches 100 %", which depends on its transfer functions: they are not given. Scalar: ray by ray;
otherwise packets.

)" +
         table(Family::tetrahedra, options,
               {"data set", "size", "thesis, fps, cores: 1", "2", "4", "8", "12", "16",
                "Plume, scalar: 1 thread", "Plume: 1", "2 threads"},
               {{{{"0.81", "1.62", "3.25", "6.47", "9.49", "11.69"},
                  {"0.20", "0.40", "0.81", "1.64", "2.44", "3.27"}}},
                {{{"0.59", "1.21", "2.45", "4.92", "7.32", "9.68"},
                  {"0.16", "0.31", "0.62", "1.24", "1.86", "2.44"}}},
                {{{"0.72", "1.48", "2.98", "5.95", "8.90", "11.94"},
                  {"0.19", "0.38", "0.76", "1.52", "2.26", "2.96"}}}},
               [](const FrameRates& rates) {
                 Row row{fps(rates.volume_scalar)};
                 append(row, pair_of(rates.volume));
                 return row;
               });
}

std::string thesis_table_6_6(const PaperOptions& options) {
  return head("Page 155. ") +
         R"(P: the thesis' Plücker walk, H: its hybrid. Here: an opaque isosurface half way through the field's values, of one colour,
without light. Scalar: ray by ray through bilinear patches with all their crossings; otherwise packets. The thesis' own
two walks, on this machine, are in table 6.5.

)" +
         table(
             Family::hexahedra, options,
             {"data set", "size", "thesis, fps, 1 core: P", "H", "2: P", "H", "4: P", "H", "8: P",
              "H", "16: P", "H", "Plume, scalar: 1 thread", "Plume: 1", "2 threads"},
             {{{{"0.97", "1.20", "1.91", "2.45", "3.82", "4.94", "7.57", "9.94", "12.24", "16.24"},
                {"0.24", "0.31", "0.48", "0.61", "0.92", "1.23", "1.91", "2.50", "3.74", "4.88"}}},
              {{{"1.24", "1.34", "2.47", "2.80", "4.97", "5.67", "9.86", "11.38", "18.85", "20.72"},
                {"0.31", "0.34", "0.63", "0.71", "1.25", "1.42", "2.49", "2.86", "4.91", "5.60"}}}},
             [](const FrameRates& rates) {
               Row row{fps(rates.isosurface_scalar)};
               append(row, pair_of(rates.isosurface));
               return row;
             });
}

std::string thesis_table_6_7(const PaperOptions& options) {
  return head("Page 155. ") +
         R"(P: the thesis' Plücker walk, H: its hybrid. Here: as in table 6.4, hexahedra of order 1.

)" +
         table(
             Family::hexahedra, options,
             {"data set", "size", "thesis, fps, 1 core: P", "H", "2: P", "H", "4: P", "H", "8: P",
              "H", "16: P", "H", "Plume, scalar: 1 thread", "Plume: 1", "2 threads"},
             {{{{"0.78", "1.01", "1.53", "2.01", "3.08", "4.09", "6.12", "8.10", "11.29", "14.82"},
                {"0.19", "0.25", "0.37", "0.51", "0.76", "1.02", "1.53", "2.03", "3.02", "3.94"}}},
              {{{"1.60", "1.77", "3.14", "3.62", "6.29", "7.26", "12.61", "14.45", "23.95",
                 "24.83"},
                {"0.41", "0.45", "0.77", "0.88", "1.58", "1.81", "2.92", "3.64", "6.26", "7.08"}}}},
             [](const FrameRates& rates) {
               Row row{fps(rates.volume_scalar)};
               append(row, pair_of(rates.volume));
               return row;
             });
}

namespace {

const Row kAllKinds{
    "data set", "size", "thesis, fps, initial: 1",  "2", "iso: 1",      "2", "mip: 1", "2",
    "semi: 1",  "2",    "Plume, initial: 1 thread", "2", "iso, lit: 1", "2", "mip: 1", "2",
    "semi: 1",  "2"};

Row all_kinds(const FrameRates& rates) {
  Row row;
  for (const auto& pair : {rates.initial, rates.lit, rates.maximum, rates.volume})
    append(row, pair_of(pair));
  return row;
}

}  // namespace

std::string thesis_table_6_9(const PaperOptions& options) {
  return head("Page 157. ") +
         R"(Initial: the first tetrahedra alone, through a kd-tree there, Embree's hierarchy here. The thesis' isosurfaces have
interpolated normals; here they are lit, as well. Isosurfaces and maxima go through a hierarchy of cells here, which the
thesis' incremental walk does without: as such they are no measure of it.

)" +
         table(Family::tetrahedra, options, kAllKinds,
               {{{{"14.23", "27.57", "0.57", "1.13", "1.02", "2.04", "0.81", "1.62"},
                  {"3.89", "7.00", "0.14", "0.28", "0.27", "0.53", "0.20", "0.40"}}},
                // The thesis has the bucky ball before the orbital.
                {{{"10.03", "20.19", "0.56", "1.14", "0.56", "1.13", "0.59", "1.21"},
                  {"2.77", "5.26", "0.27", "0.48", "0.14", "0.28", "0.16", "0.31"}}},
                {{{"10.45", "19.70", "0.42", "0.84", "0.48", "0.98", "0.72", "1.48"},
                  {"2.78", "5.13", "0.12", "0.24", "0.13", "0.25", "0.19", "0.38"}}}},
               all_kinds);
}

std::string thesis_table_6_10(const PaperOptions& options) {
  return head("Page 158. ") +
         R"(The thesis' hybrid. Initial: the first hexahedra alone. Isosurfaces of so few hexahedra are found by
packets, maxima through a hierarchy of cells.

)" +
         table(Family::hexahedra, options, kAllKinds,
               {{{{"14.23", "27.57", "1.20", "2.45", "1.23", "2.44", "1.01", "2.01"},
                  {"3.89", "7.00", "0.31", "0.61", "0.31", "0.61", "0.26", "0.51"}}},
                {{{"9.36", "18.31", "1.34", "2.80", "0.70", "1.39", "1.77", "3.62"},
                  {"2.60", "4.70", "0.34", "0.71", "0.17", "0.33", "0.45", "0.88"}}}},
               all_kinds);
}

std::string thesis_table_6_8(const PaperOptions& options) {
  struct Theirs {
    const char *primitives, *dimensions;
  };
  // The thesis has the bucky ball after the orbital, here as there.
  constexpr Theirs kTheirs[2][3] = {{{"224,873", "n/a"}, {"148,955", "n/a"}, {"176,856", "n/a"}},
                                    {{"40,960", "40x32x32"}, {"47,025", "57x33x25"}, {}}};
  Rows rows{{"data set", "type", "thesis: primitives", "dimensions", "here: cells", "points",
             "bytes a cell", "bytes a point", "thesis' form: bytes", "Plume's: bytes", "what"}};
  for (const Family family : {Family::tetrahedra, Family::hexahedra}) {
    const bool grids = family == Family::hexahedra;
    std::size_t at = 0;
    for (const ThesisMesh& source : thesis_meshes(family, options.quick)) {
      const Theirs& theirs = kTheirs[grids ? 1 : 0][at++];
      const auto mesh = source.load();
      const Row of_thesis{source.name, grids ? "hexahedral" : "tetrahedral", theirs.primitives,
                          theirs.dimensions};
      if (!mesh) {
        rows.push_back(without_data(of_thesis, rows.front().size()));
        continue;
      }
      const Scene scene(*mesh);
      const std::size_t thesis = 16 * scene.point_count() + (grids ? 0 : 32 * scene.cell_count());
      const auto each = [&](std::size_t of) {
        return times(static_cast<double>(scene.bytes()) / static_cast<double>(of));
      };
      rows.push_back(of_thesis);
      append(rows.back(), {with_commas(scene.cell_count()), with_commas(scene.point_count()),
                           each(scene.cell_count()), each(scene.point_count()), with_commas(thesis),
                           with_commas(scene.bytes()), source.what});
    }
  }
  return R"(Page 156. The thesis has 224,873 here and 224,874 in table 6.2, and counts a grid's points as its primitives. Memory is of
its sections 6.3.5 and 6.4.5: 32 bytes a tetrahedron and 16 a point, 16 a point of a grid, without normals; here of the
whole walkable form, boundary included, without gradients and the hierarchy over the boundary.

)" + markdown_table(rows);
}

}  // namespace plume::bench
