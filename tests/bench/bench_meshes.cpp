#include "plume/tests/bench/bench_meshes.h"

#include <algorithm>
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

std::optional<Mesh> blunt_fin() {
  const auto points = dataset_directory() / "bluntfin" / "bluntfinxyz.bin";
  ReadOptions options;
  options.solution = dataset_directory() / "bluntfin" / "bluntfinq.bin";
  if (!std::filesystem::exists(points) || !std::filesystem::exists(options.solution)) {
    std::fprintf(stderr,
                 "plume_bench: BLUNT FIN SKIPPED FOR LACK OF DATA: no %s; set PLUME_DATASETS to "
                 "the directory that holds bluntfin (datasets/CATALOGUE.md)\n",
                 points.c_str());
    return std::nullopt;
  }
  return cut_into_tetrahedra(read_mesh(points, options));
}

MeshSource box(const char* name, int size, int resolution, std::uint64_t quick_tiles,
               std::uint64_t tiles, CellOrder order = CellOrder::hilbert) {
  return {name, resolution, quick_tiles, tiles, order, [size]() -> std::optional<Mesh> {
            return generate("box-tetrahedra", {size, 0.2, 1});
          }};
}

}  // namespace

Mesh cut_into_tetrahedra(const Mesh& grid) {
  datasets::Box box;
  for (std::size_t a = 0; a < 3; ++a) box.cells[a] = static_cast<int>(grid.dimensions[a]) - 1;
  std::vector<std::int32_t> connectivity;
  datasets::for_each_cuboid(box, [&](int i, int j, int k) {
    datasets::append_kuhn_tetrahedra(box.corners(i, j, k), connectivity);
  });
  Mesh mesh;
  mesh.points = grid.points;
  mesh.cells = datasets::cells_of(CellType::tetrahedron, std::move(connectivity));
  std::copy_if(grid.fields.begin(), grid.fields.end(), std::back_inserter(mesh.fields),
               [](const Field& field) { return field.association == Association::point; });
  mesh.active_field = grid.active_field;
  return mesh;
}

BenchMesh make_bench_mesh(const Mesh& mesh, CellOrder order) {
  BenchMesh made;
  made.bounds = check_structure(mesh);
  const ScalarField field = select_field(mesh);
  made.scalar_size = std::max(std::abs(field.low), std::abs(field.high));
  made.tets = make_walkable_tets(mesh, field, made.bounds, false);
  made.plucker = make_plucker_mesh(mesh, find_tet_adjacency(mesh, field, made.bounds));
  if (order == CellOrder::random) shuffle_cells(made.tets, made.plucker);
  const float isovalue = 0.5f * (percentile(field.values, 0.01) + percentile(field.values, 0.99));
  made.optics =
      BenchOptics(isovalue, field.low, field.high, static_cast<float>(8 / made.bounds.diagonal()));
  return made;
}

const std::vector<MeshSource>& mesh_sources() {
  static const std::vector<MeshSource> sources{
      {"blunt-fin", 512, 1, 1, CellOrder::hilbert, blunt_fin},
      box("box-1M", 55, 512, 4, 1),
      box("box-10M", 118, 1024, 0, 4),
      box("box-10M-random-order", 118, 1024, 0, 4, CellOrder::random),
      box("box-50M", 203, 1024, 0, 4)};
  return sources;
}

}  // namespace plume::bench
