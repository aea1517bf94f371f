#include "plume/tests/bench/bench_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>

#include "plume/datasets/generate.h"
#include "plume/datasets/grid.h"
#include "plume/io/read_mesh.h"
#include "plume/mesh/validate.h"

namespace plume::bench {
namespace {

void shuffle_cells(WalkableTets& tets, PluckerMesh& plucker) {
  std::vector<std::uint32_t> place(tets.cells.size());  // of each cell in the new order
  std::iota(place.begin(), place.end(), 0u);
  std::mt19937_64 random(1);
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random() % i]);

  std::vector<WalkableTets::Cell> cells(tets.cells.size());
  std::vector<PluckerMesh::Cell> records(tets.cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    WalkableTets::Cell& cell = cells[place[i]] = tets.cells[i];
    for (WalkableTets::Link& link : cell)
      if (link.cell != kNone) link.cell = place[link.cell];
    PluckerMesh::Cell& record = records[place[i]] = plucker.cells[i];
    for (std::uint32_t& next : record.neighbors)
      if (next != kNone) next = 4 * place[next / 4] + next % 4;
  }
  tets.cells = std::move(cells);
  plucker.cells = std::move(records);
  for (WalkableTets::Boundary& face : tets.boundary) face.cell = place[face.cell];
}

// In the order of the cells that the other walkers have.
WalkableTets compact(const WalkableTets& tets, const PluckerMesh& plucker) {
  WalkableTets compact;
  compact.frame = tets.frame;
  compact.points = tets.points;
  compact.boundary = tets.boundary;
  compact.compact_cells.resize(plucker.cells.size());
  for (std::size_t c = 0; c < plucker.cells.size(); ++c) {
    const PluckerMesh::Cell& from = plucker.cells[c];
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return from.points[a] < from.points[b]; });
    auto neighbor = [&](std::size_t rank) {
      const std::uint32_t next = from.neighbors[order[rank]];
      return next == kNone ? kNone : next / 4;
    };
    WalkableTets::CompactCell& cell = compact.compact_cells[c];
    cell.points = from.points[0] ^ from.points[1] ^ from.points[2] ^ from.points[3];
    for (std::size_t r = 1; r < 4; ++r) cell.neighbors[r - 1] = neighbor(r) ^ neighbor(0);
  }
  return compact;
}

float percentile(std::vector<float> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::filesystem::path dataset_directory() {
  const char* const given = std::getenv("PLUME_DATASETS");
  return given ? std::filesystem::path(given)
               : std::filesystem::path(PLUME_SOURCE_DIR) / ".." / "shared" / "datasets";
}

// A public grid of Plot3D, skipped loudly where it is absent.
std::optional<Mesh> public_grid(const char* directory, const char* points, const char* solution) {
  const auto folder = dataset_directory() / directory;
  ReadOptions options;
  options.solution = folder / solution;
  if (!std::filesystem::exists(folder / points) || !std::filesystem::exists(options.solution)) {
    std::fprintf(stderr,
                 "plume_bench: SKIPPED FOR LACK OF DATA: no %s and %s; set PLUME_DATASETS to the "
                 "directory that holds %s (datasets/CATALOGUE.md)\n",
                 (folder / points).c_str(), solution, directory);
    return std::nullopt;
  }
  return read_mesh(folder / points, options);
}

std::optional<Mesh> blunt_fin() {
  return public_grid("bluntfin", "bluntfinxyz.bin", "bluntfinq.bin");
}
std::optional<Mesh> combustor() { return public_grid("combustor", "combxyz.bin", "combq.bin"); }

std::optional<Mesh> blunt_fin_tetrahedra() {
  std::optional<Mesh> grid = blunt_fin();
  if (grid) grid = cut_into_tetrahedra(*grid);
  return grid;
}

// A grid's points and their fields, with cells of their own.
Mesh explicit_mesh(const Mesh& grid, CellType type, std::vector<std::int32_t> connectivity) {
  Mesh mesh;
  mesh.points = grid.points;
  mesh.cells = datasets::cells_of(type, std::move(connectivity));
  std::copy_if(grid.fields.begin(), grid.fields.end(), std::back_inserter(mesh.fields),
               [](const Field& field) { return field.association == Association::point; });
  mesh.active_field = grid.active_field;
  return mesh;
}

MeshSource box(const char* name, int size, int resolution, std::uint64_t quick_tiles,
               std::uint64_t tiles, CellOrder order = CellOrder::hilbert) {
  return {Family::tetrahedra,
          name,
          resolution,
          quick_tiles,
          tiles,
          order,
          [size]() -> std::optional<Mesh> {
            return generate("box-tetrahedra", {size, 0.2, 1});
          }};
}

MeshSource grid(const char* name, std::uint64_t quick_tiles, std::uint64_t tiles,
                std::function<std::optional<Mesh>()> load) {
  return {Family::hexahedra, name, 512, quick_tiles, tiles, CellOrder::hilbert, std::move(load)};
}

MeshSource box_of(Family family, const char* generator, int size) {
  return {family, generator, 512, 4, 1, CellOrder::hilbert, [=]() -> std::optional<Mesh> {
            return generate(generator, {size, 0.2, 1});
          }};
}

// Hexahedra as cells like any others.
Mesh without_indices(const Mesh& grid) {
  datasets::Box box;
  for (std::size_t a = 0; a < 3; ++a) box.cells[a] = static_cast<int>(grid.dimensions[a]) - 1;
  std::vector<std::int32_t> connectivity;
  datasets::for_each_cuboid(box, [&](int i, int j, int k) {
    const auto corners = box.corners(i, j, k);
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  });
  return explicit_mesh(grid, CellType::hexahedron, std::move(connectivity));
}

}  // namespace

const char* family_name(Family family) {
  constexpr const char* kNames[] = {"tetrahedra", "hexahedra", "cells"};
  return kNames[static_cast<std::size_t>(family)];
}

Mesh cut_into_tetrahedra(const Mesh& grid) {
  datasets::Box box;
  for (std::size_t a = 0; a < 3; ++a) box.cells[a] = static_cast<int>(grid.dimensions[a]) - 1;
  std::vector<std::int32_t> connectivity;
  datasets::for_each_cuboid(box, [&](int i, int j, int k) {
    datasets::append_kuhn_tetrahedra(box.corners(i, j, k), connectivity);
  });
  return explicit_mesh(grid, CellType::tetrahedron, std::move(connectivity));
}

BenchMesh make_bench_mesh(const Mesh& mesh, Family family, CellOrder order) {
  BenchMesh made;
  made.family = family;
  made.bounds = check_structure(mesh);
  const ScalarField field = select_field(mesh);
  made.scalar_size = std::max(std::abs(field.low), std::abs(field.high));
  switch (family) {
    case Family::tetrahedra:
      made.tets = make_walkable_tets(mesh, field, made.bounds, false);
      made.plucker = make_plucker_mesh(mesh, find_tet_adjacency(mesh, field, made.bounds));
      if (order == CellOrder::random) shuffle_cells(made.tets, made.plucker);
      made.compact_tets = compact(made.tets, made.plucker);
      made.cell_count = made.tets.cell_count();
      break;
    case Family::hexahedra:
      made.grid = make_walkable_grid(mesh, field, made.bounds);
      made.cell_count = made.grid.cell_count();
      break;
    case Family::cells:
      made.cells = make_walkable_cells(mesh, field, made.bounds, false);
      prepare_packets(made.cells);
      made.cell_count = made.cells.cell_count();
      break;
  }
  const float isovalue = 0.5f * (percentile(field.values, 0.01) + percentile(field.values, 0.99));
  made.optics =
      BenchOptics(isovalue, field.low, field.high, static_cast<float>(8 / made.bounds.diagonal()));
  return made;
}

const std::vector<MeshSource>& mesh_sources(Family family) {
  static const std::vector<MeshSource> tetrahedra{
      {Family::tetrahedra, "blunt-fin", 512, 1, 1, CellOrder::hilbert, blunt_fin_tetrahedra},
      box("box-1M", 55, 512, 4, 1),
      box("box-10M", 118, 1024, 0, 4),
      box("box-10M-random-order", 118, 1024, 0, 4, CellOrder::random),
      box("box-50M", 203, 1024, 0, 4)};
  static const std::vector<MeshSource> hexahedra{
      grid("blunt-fin", 8, 1, blunt_fin), grid("combustor", 8, 1, combustor),
      grid("twisted", 32, 4, []() -> std::optional<Mesh> { return generate("twisted", {56}); })};
  static const std::vector<MeshSource> cells{
      box_of(Family::tetrahedra, "box-tetrahedra", 20),
      box_of(Family::cells, "box-tetrahedra", 20),
      box_of(Family::cells, "box-wedges", 29),
      box_of(Family::cells, "box-mixed", 27),
      {Family::cells, "box-hexahedra", 512, 4, 1, CellOrder::hilbert,
       []() -> std::optional<Mesh> {
         return without_indices(generate("box-hexahedra", {36, 0.2, 1}));
       }},
      box_of(Family::cells, "box-polyhedra", 36)};
  return family == Family::tetrahedra  ? tetrahedra
         : family == Family::hexahedra ? hexahedra
                                       : cells;
}

}  // namespace plume::bench
