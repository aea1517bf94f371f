// Small meshes that fill the unit cube, however tangled their inside, and rays aimed at their
// points: none is lost, what they cover is the chord, and packets meet the cells of their twin.

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bytes.h"
#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"
#include "plume/mesh/corner_cells.h"
#include "plume/mesh/validate.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/trace.h"

namespace plume::fuzz {
namespace {

using Place = std::array<double, 3>;

// Hexahedra of the unit cube whose inner points are anywhere in it, and those on its sides anywhere
// on them.
Mesh make_grid(Bytes& bytes) {
  Mesh mesh;
  for (auto& n : mesh.dimensions) n = static_cast<std::int64_t>(2 + bytes.below(3));
  std::vector<double> points;
  std::vector<float> values;
  for (std::int64_t k = 0; k < mesh.dimensions[2]; ++k)
    for (std::int64_t j = 0; j < mesh.dimensions[1]; ++j)
      for (std::int64_t i = 0; i < mesh.dimensions[0]; ++i) {
        const std::array<std::int64_t, 3> at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          const auto last = mesh.dimensions[a] - 1;
          double x = static_cast<double>(at[a]) / static_cast<double>(last);
          if (at[a] > 0 && at[a] < last) {
            const std::uint8_t how = bytes.take<std::uint8_t>();
            if (how % 4 == 1) x = bytes.take<std::uint8_t>() / 255.0;
            if (how % 4 == 2) x += (bytes.take<std::uint8_t>() - 128) * 1e-9;
            if (how % 4 == 3) x = static_cast<double>(how / 4 % 5) / 4;
          }
          points.push_back(std::min(1.0, std::max(0.0, x)));
        }
        values.push_back(static_cast<float>(bytes.take<std::uint8_t>()));
      }
  mesh.points = Array::own(std::move(points));
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  return mesh;
}

Mesh cells_of(const Mesh& grid, bool tetrahedra) {
  datasets::Box box;
  for (std::size_t a = 0; a < 3; ++a) box.cells[a] = static_cast<int>(grid.dimensions[a]) - 1;
  std::vector<std::int32_t> connectivity;
  datasets::for_each_cuboid(box, [&](int i, int j, int k) {
    const auto corners = box.corners(i, j, k);
    if (tetrahedra)
      datasets::append_kuhn_tetrahedra(corners, connectivity);
    else
      connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  });
  Mesh mesh;
  mesh.points = grid.points;
  mesh.fields = grid.fields;
  mesh.cells = datasets::cells_of(tetrahedra ? CellType::tetrahedron : CellType::hexahedron,
                                  std::move(connectivity));
  return mesh;
}

// From a point of the mesh, or any place, to another one.
Ray make_ray(const Mesh& mesh, Bytes& bytes) {
  auto place = [&] {
    Place p;
    if (bytes.below(2) == 0) {
      const std::size_t point = bytes.below(mesh.point_count());
      for (std::size_t a = 0; a < 3; ++a) p[a] = mesh.points.at<double>(3 * point + a);
    } else {
      for (double& x : p) x = 2 * bytes.coarse();
    }
    return p;
  };
  Ray ray;
  ray.origin = place();
  const Place to = place();
  double length2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    ray.direction[a] = to[a] - ray.origin[a];
    length2 += ray.direction[a] * ray.direction[a];
  }
  for (double& d : ray.direction) d /= std::sqrt(length2);
  ray.t_min = -std::numeric_limits<double>::infinity();
  return ray;
}

void check_chord(const Ray& ray, double sum, double slack) {
  const auto range =
      reference::box_chord_range({0, 0, 0}, {1, 1, 1}, ray.origin, ray.direction, slack);
  if (!(sum >= range[0] && sum <= range[1])) fail("segments do not sum up to the chord");
}

template <class Start>
class Starts : public PacketFeeder {
 public:
  std::vector<Start> list;
  const PacketStart* next(const PacketStart*) override {
    return at_ < list.size() ? &list[at_++] : nullptr;
  }

 private:
  std::size_t at_ = 0;
};
class Cells : public PacketSegmentSink {
 public:
  explicit Cells(std::size_t passages) : of(passages) {}
  std::vector<std::vector<std::uint32_t>> of;
  void take(const PacketSegment& s) override { of[s.ray].push_back(s.cell); }
};

template <class Walker>
void check_walker(const typename Walker::Mesh& mesh, const std::vector<Ray>& rays, bool packets) {
  using Form = typename Walker::Mesh;
  const BoundaryIndex<Walker> boundary(mesh);
  Starts<StartOf<Form>> starts[3];
  std::deque<ShearedFrame> frames;
  std::vector<std::vector<std::uint32_t>> expected;
  for (const Ray& ray : rays) {
    double sum = 0, until = -std::numeric_limits<double>::infinity();
    const TraceResult result = trace(mesh, boundary, ray, [&](const Segment& s) {
      if (!(s.t_in <= s.t_out) || s.t_in < until) fail("segments go back");
      until = s.t_out;
      sum += s.t_out - s.t_in;
      return true;
    });
    if (result.end != WalkEnd::left) fail("a ray is lost");
    ShearedFrame& frame = frames.emplace_back();
    if (!frame.set(ray, mesh.frame)) continue;
    check_chord(ray, sum, 2e-6 * std::sqrt(3.0));
    if (!packets) continue;
    Walker walker(mesh, frame);
    Entries<Walker> entries;
    for (auto entry = entries.first(boundary, walker, frame); entry;
         entry = entries.next(boundary, walker, frame)) {
      const auto& face = mesh.boundary[entry->boundary];
      walker.enter(face, entry->rank);
      starts[frame.axis()].list.push_back(make_start(mesh, frame, face, entry->place, entry->rank,
                                                     static_cast<std::uint32_t>(expected.size())));
      auto& cells = expected.emplace_back();
      do {
        cells.push_back(walker.cell());
        if (!walker.leave()) fail("the walker alone is lost");
      } while (walker.advance());
    }
  }
  Cells found(expected.size());
  for (int axis = 0; axis < 3 && packets; ++axis) walk_segments(mesh, axis, starts[axis], found);
  if (packets && found.of != expected) fail("packets meet other cells than their twin");
}

}  // namespace
}  // namespace plume::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plume;
  if (size > 2048) return 0;
  fuzz::Bytes bytes(data, size);
  const Mesh grid = fuzz::make_grid(bytes);
  std::vector<Ray> rays;
  do rays.push_back(fuzz::make_ray(grid, bytes));
  while (!bytes.empty() && rays.size() < 40);

  const Bounds bounds = check_structure(grid);
  const ScalarField field = select_field(grid);
  const WalkableGrid as_grid = make_walkable_grid(grid, field, bounds);
  fuzz::check_walker<GridWalker>(as_grid, rays, true);
  fuzz::check_walker<PluckerGridWalker>(as_grid, rays, false);
  fuzz::check_walker<HybridGridWalker>(as_grid, rays, false);
  const Mesh tetrahedra = fuzz::cells_of(grid, true), hexahedra = fuzz::cells_of(grid, false);
  fuzz::check_walker<TetWalker>(make_walkable_tets(tetrahedra, field, bounds, false), rays, true);
  WalkableCells cells = make_walkable_cells(hexahedra, field, bounds, false);
  cells.corner_cells = make_corner_cells(cells);
  fuzz::check_walker<CellWalker>(cells, rays, cells.has_packets());
  cells.corner_cells = {};
  cells.edge_cells = make_edge_cells(cells);
  fuzz::check_walker<CellWalker>(cells, rays, cells.has_packets());
  return 0;
}
