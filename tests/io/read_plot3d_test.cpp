// Plot3D: the public data sets, and every layout made from one small grid.
#include <algorithm>
#include <bit>
#include <cstring>

#include "read_test_files.h"

namespace plume::test {
namespace {

using Plot3dFile = FileTest;

TEST_F(Plot3dFile, ReadsTheBluntFin) {
  const auto grid = dataset("bluntfin/bluntfinxyz.bin");
  PLUME_SKIP_WITHOUT(grid);
  const Mesh mesh = read_mesh(grid, {.solution = dataset("bluntfin/bluntfinq.bin")});
  EXPECT_EQ(mesh.point_count(), 40960u);
  EXPECT_EQ(mesh.cell_count(), 37479u);
  EXPECT_EQ(mesh.dimensions, (std::array<std::int64_t, 3>{40, 32, 32}));
  EXPECT_EQ(mesh.points.type(), Array::Type::float32);
  EXPECT_TRUE(mesh.hidden_cells.empty());
  EXPECT_EQ(mesh.active_field, "Density");
  ASSERT_EQ(mesh.fields.size(), 18u);
  EXPECT_EQ(range(*field(mesh, "Density")), (std::array<double, 2>{0.1926f, 4.9775f}));
  EXPECT_EQ(field(mesh, "Momentum")->components, 3);
  EXPECT_EQ(range(*field(mesh, "StagnationEnergy")),
            (std::array<double, 2>{0.76895696f, 25.160999f}));
  EXPECT_NEAR(range(*field(mesh, "Pressure"))[1], 10.01268, 1e-5);
  EXPECT_NEAR(range(*field(mesh, "MachNumber"))[1], 3.3854456, 1e-6);
  EXPECT_NEAR(range(*field(mesh, "Temperature"))[0], 0.5987, 1e-6);
  EXPECT_EQ(field(mesh, "Velocity")->components, 3);
}

TEST_F(Plot3dFile, DerivesPressureFromDensityMomentumAndEnergy) {
  const auto grid = dataset("bluntfin/bluntfinxyz.bin");
  PLUME_SKIP_WITHOUT(grid);
  const Mesh mesh = read_mesh(grid, {.solution = dataset("bluntfin/bluntfinq.bin")});
  const auto density = values(field(mesh, "Density")->values);
  const auto momentum = values(field(mesh, "Momentum")->values);
  const auto energy = values(field(mesh, "StagnationEnergy")->values);
  const auto pressure = values(field(mesh, "Pressure")->values);
  for (std::size_t i = 0; i < density.size(); i += 97) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += momentum[3 * i + c] * momentum[3 * i + c];
    const double expected = 0.4 * (energy[i] - 0.5 * square / density[i]);
    ASSERT_NEAR(pressure[i], expected, 1e-5 * (1 + expected)) << "at point " << i;
  }
}

TEST_F(Plot3dFile, LeavesOutWhatNeedsEnergyWhereThereIsNone) {
  const auto grid = dataset("combustor/combxyz.bin");
  PLUME_SKIP_WITHOUT(grid);
  const Read result = read(grid, {.solution = dataset("combustor/combq.bin")});
  EXPECT_EQ(result.mesh.dimensions, (std::array<std::int64_t, 3>{57, 33, 25}));
  EXPECT_EQ(result.mesh.cell_count(), 43008u);
  EXPECT_EQ(range(*field(result.mesh, "Density")),
            (std::array<double, 2>{0.197813094f, 0.710419238f}));
  EXPECT_TRUE(result.was_told("energy is zero"));
  for (const Field& each : result.mesh.fields) {
    EXPECT_NE(each.name, "Pressure");
    EXPECT_NE(each.name, "MachNumber");
  }
  EXPECT_NE(field(result.mesh, "Velocity"), nullptr);
}

TEST_F(Plot3dFile, ReadsSeveralBlocksAndMergesTheirPoints) {
  const auto grid = dataset("formats/multi-bin.xyz");
  PLUME_SKIP_WITHOUT(grid);
  const auto solution = dataset("formats/multi-bin.q");
  const Mesh apart = read_mesh(grid, {.solution = solution});
  EXPECT_FALSE(apart.is_grid());
  EXPECT_EQ(apart.point_count(), 2u * 8 * 12 * 12);
  EXPECT_EQ(apart.cell_count(), 2u * 7 * 11 * 11);
  EXPECT_EQ(apart.points.type(), Array::Type::float64);
  EXPECT_EQ(apart.active_field, "Density");

  const Mesh merged = read_mesh(grid, {.solution = solution, .merge_points = true});
  EXPECT_EQ(merged.point_count(), apart.point_count() - 12 * 12);
  EXPECT_EQ(merged.cell_count(), apart.cell_count());
  EXPECT_EQ(field(merged, "Density")->values.size(), merged.point_count());
  // Every corner of every cell is where it was.
  for (std::size_t i = 0; i < apart.cells.connectivity.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(merged.points.at<double>(3 * merged.cells.connectivity.at<std::size_t>(i) + axis),
                apart.points.at<double>(3 * apart.cells.connectivity.at<std::size_t>(i) + axis));
}

// The bytes or the text of a Plot3D file in one of its layouts.
struct Layout {
  bool text = false, little_endian = false, marks = false, multi_block = false, is_double = false,
       blanking = false;
};

class Writer {
 public:
  explicit Writer(const Layout& layout) : layout_(layout) {}

  void begin_record() { record_.clear(); }
  void end_record() {
    const auto length = static_cast<std::int32_t>(record_.size());
    if (layout_.marks) put(file_, length);
    file_ += record_;
    if (layout_.marks) put(file_, length);
  }
  void integer(std::int32_t value) {
    if (layout_.text)
      record_ += std::to_string(value) + "\n";
    else
      put(record_, value);
  }
  void real(double value) {
    if (layout_.text)
      record_ += std::to_string(value) + " ";
    else if (layout_.is_double)
      put(record_, value);
    else
      put(record_, static_cast<float>(value));
  }
  const std::string& file() const { return file_; }

 private:
  template <class T>
  void put(std::string& to, T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    const bool native = (std::endian::native == std::endian::little) == layout_.little_endian;
    to += native ? bytes : swapped(bytes, sizeof(T));
  }

  Layout layout_;
  std::string record_, file_;
};

constexpr int ni = 3, nj = 4, nk = 5;

void write_header(Writer& writer, const Layout& layout, int blocks) {
  if (layout.multi_block) {
    writer.begin_record();
    writer.integer(blocks);
    writer.end_record();
  }
  writer.begin_record();
  for (int block = 0; block < blocks; ++block)
    for (const int n : {ni, nj, nk}) writer.integer(n);
  writer.end_record();
}

std::string grid_file(const Layout& layout, int blocks = 1) {
  Writer writer(layout);
  write_header(writer, layout, blocks);
  for (int block = 0; block < blocks; ++block) {
    writer.begin_record();
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
          for (int i = 0; i < ni; ++i) {
            const double point[] = {i + 2.0 * block, j * 0.5, k * 0.25};
            writer.real(point[axis]);
          }
    // One point in the corner is blanked: one cell.
    if (layout.blanking)
      for (int p = 0; p < ni * nj * nk; ++p) writer.integer(p == 0 ? 0 : 1);
    writer.end_record();
  }
  return writer.file();
}

std::string solution_file(const Layout& layout, int blocks = 1) {
  Writer writer(layout);
  write_header(writer, layout, blocks);
  for (int block = 0; block < blocks; ++block) {
    writer.begin_record();
    for (const double value : {0.5, 0.0, 1000.0, 0.0}) writer.real(value);
    writer.end_record();
    writer.begin_record();
    for (int variable = 0; variable < 5; ++variable)
      for (int p = 0; p < ni * nj * nk; ++p) writer.real(variable == 4 ? 10 : 1 + variable + p);
    writer.end_record();
  }
  return writer.file();
}

std::vector<Layout> layouts() {
  std::vector<Layout> all;
  for (int bits = 0; bits < 64; ++bits) {
    const Layout layout{(bits & 1) != 0, (bits & 2) != 0,  (bits & 4) != 0,
                        (bits & 8) != 0, (bits & 16) != 0, (bits & 32) != 0};
    if (layout.text && (layout.little_endian || layout.marks || layout.is_double)) continue;
    all.push_back(layout);
  }
  return all;
}

std::string name_of(const Layout& layout) {
  return std::string(layout.text            ? "text"
                     : layout.little_endian ? "little"
                                            : "big") +
         (layout.marks ? " marks" : "") + (layout.multi_block ? " multi" : "") +
         (layout.is_double ? " double" : "") + (layout.blanking ? " blanking" : "");
}

TEST_F(Plot3dFile, ReadsEveryLayoutOfOneBlock) {
  const auto all = layouts();
  ASSERT_EQ(all.size(), 36u);
  for (const Layout& layout : all) {
    SCOPED_TRACE(name_of(layout));
    const auto grid = write("small.xyz", grid_file(layout));
    const auto solution = write("small.q", solution_file(layout));
    const Mesh mesh = read_mesh(grid, {.solution = solution});
    ASSERT_EQ(mesh.dimensions, (std::array<std::int64_t, 3>{ni, nj, nk}));
    EXPECT_EQ(mesh.points.type(),
              layout.text || layout.is_double ? Array::Type::float64 : Array::Type::float32);
    // The last point, in the corner away from the origin.
    const std::size_t last = 3 * (ni * nj * nk - 1);
    EXPECT_EQ(mesh.points.at<double>(last), 2);
    EXPECT_EQ(mesh.points.at<double>(last + 1), 1.5);
    EXPECT_EQ(mesh.points.at<double>(last + 2), 1);
    EXPECT_EQ(field(mesh, "Density")->values.at<double>(7), 8);
    EXPECT_EQ(field(mesh, "Momentum")->values.at<double>(3 * 7 + 2), 11);
    EXPECT_EQ(field(mesh, "StagnationEnergy")->values.at<double>(7), 10);
    if (!layout.blanking) {
      EXPECT_TRUE(mesh.hidden_cells.empty());
      continue;
    }
    ASSERT_EQ(mesh.hidden_cells.size(), mesh.cell_count());
    const auto hidden = values(mesh.hidden_cells);
    EXPECT_EQ(hidden[0], 1);
    EXPECT_EQ(std::count(hidden.begin(), hidden.end(), 0), 2 * 3 * 4 - 1);
  }
}

TEST_F(Plot3dFile, ReadsEveryLayoutOfTwoBlocks) {
  for (Layout layout : layouts()) {
    if (!layout.multi_block) continue;
    SCOPED_TRACE(name_of(layout));
    const auto grid = write("two.xyz", grid_file(layout, 2));
    const auto solution = write("two.q", solution_file(layout, 2));
    const Mesh mesh = read_mesh(grid, {.solution = solution, .merge_points = true});
    EXPECT_FALSE(mesh.is_grid());
    EXPECT_EQ(mesh.point_count(), 2u * ni * nj * nk - nj * nk);
    EXPECT_EQ(mesh.cell_count(), 2u * 2 * 3 * 4 - (layout.blanking ? 2 : 0));
    EXPECT_EQ(field(mesh, "Density")->values.size(), mesh.point_count());
  }
}

TEST_F(Plot3dFile, BothByteOrdersOfTheBluntFinGiveTheSameMesh) {
  const auto grid = dataset("bluntfin/bluntfinxyz.bin");
  PLUME_SKIP_WITHOUT(grid);
  const auto solution = dataset("bluntfin/bluntfinq.bin");
  const Mesh big = read_mesh(grid, {.solution = solution});
  const Mesh little = read_mesh(write("little.xyz", swapped(contents_of(grid), 4)),
                                {.solution = write("little.q", swapped(contents_of(solution), 4))});
  EXPECT_EQ(little.dimensions, big.dimensions);
  EXPECT_EQ(values(little.points), values(big.points));
  ASSERT_EQ(little.fields.size(), big.fields.size());
  for (std::size_t i = 0; i < big.fields.size(); ++i)
    EXPECT_EQ(fingerprint(little.fields[i].values), fingerprint(big.fields[i].values))
        << big.fields[i].name;
}

TEST_F(Plot3dFile, AGridWithoutASolutionHasNoFields) {
  const Mesh mesh = read_mesh(write("grid.p3d", grid_file({})));
  EXPECT_EQ(mesh.cell_count(), 24u);
  EXPECT_TRUE(mesh.fields.empty());
  EXPECT_EQ(mesh.active_field, "");
}

TEST_F(Plot3dFile, TellsATruncatedGridAndSolution) {
  const std::string whole = grid_file({}), whole_solution = solution_file({});
  const auto cut = write("cut.xyz", whole.substr(0, whole.size() / 2));
  const std::string message = error_of(cut);
  EXPECT_NE(message.find("cut.xyz: truncated: 1 block of 3 x 4 x 5 points"), std::string::npos)
      << message;
  const auto grid = write("grid.xyz", whole);
  const auto solution = write("cut.q", whole_solution.substr(0, whole_solution.size() - 4));
  const std::string about_solution = error_of(grid, {.solution = solution});
  EXPECT_NE(about_solution.find("cut.q: truncated"), std::string::npos) << about_solution;
}

TEST_F(Plot3dFile, RefusesASolutionOfAnotherGridOrLayout) {
  const auto grid = write("grid.xyz", grid_file({}));
  EXPECT_NE(error_of(grid, {.solution = write("d.q", solution_file({.is_double = true}))})
                .find("d.q: is binary, big-endian, double"),
            std::string::npos);
  const Layout multi{.multi_block = true};
  EXPECT_NE(error_of(write("one.xyz", grid_file(multi)),
                     {.solution = write("two.q", solution_file(multi, 2))})
                .find("two.q: holds 2 blocks"),
            std::string::npos);
  EXPECT_NE(error_of(grid, {.solution = path("missing.q")}).find("missing.q: no such file"),
            std::string::npos);
}

TEST_F(Plot3dFile, RefusesA2dGridAndFortranShorthand) {
  EXPECT_NE(error_of(write("flat.xyz", "2 2\n0 1 0 1\n0 0 1 1\n")).find("2D Plot3D grid"),
            std::string::npos);
  EXPECT_NE(error_of(write("repeat.xyz", "2 2 2\n8*0.0 8*1.0 8*2.0\n")).find("line 2 has a '*'"),
            std::string::npos);
}

TEST_F(Plot3dFile, AHeaderThatPromisesTheWorldAllocatesNothing) {
  std::string bytes(4000, '\x7f');
  EXPECT_NE(error_of(write("world.xyz", bytes)).find("world.xyz: no Plot3D grid"),
            std::string::npos);
}

}  // namespace
}  // namespace plume::test
