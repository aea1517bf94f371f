#include "plume/tests/bench/papers/naive_plucker.h"

#include <array>

#include "plume/tests/bench/plucker_walker.h"

namespace plume::bench {
namespace {

struct Vector {
  float x, y, z;
};

// The permuted inner product (6.3) of the ray {d : d x o} and an edge, as in walk_plucker().
class Products {
 public:
  Products(const PluckerMesh& mesh, const PluckerRay& ray)
      : points_(mesh.points.data()),
        d_{ray.d[0], ray.d[1], ray.d[2]},
        d_x_o_(cross(d_, {ray.o[0], ray.o[1], ray.o[2]})) {}

  float operator()(std::uint32_t from, std::uint32_t to) const {
    const Vector a = at(from), b = at(to);
    const Vector edge{b.x - a.x, b.y - a.y, b.z - a.z};
    return dot(d_, cross(edge, a)) + dot(d_x_o_, edge);
  }

 private:
  static Vector cross(const Vector& p, const Vector& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  }
  static float dot(const Vector& p, const Vector& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
  Vector at(std::uint32_t id) const {
    const auto& p = points_[id].position;
    return {p[0], p[1], p[2]};
  }

  const WalkablePoint* points_;
  Vector d_, d_x_o_;
};

// The face opposite to each point, all seen from the same side, be it inside or outside.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

template <class Audit>
std::uint32_t walk(const PluckerMesh& mesh, const PluckerRay& ray,
                   const WalkableTets::Boundary& entry, Audit& audit) {
  const Products product(mesh, ray);
  std::uint32_t cell = entry.cell;
  std::size_t way_in = 0;
  while (mesh.cells[cell].points[way_in] != entry.apex) ++way_in;
  // On which side the ray passes the edges of a face by which it leaves.
  float in = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const auto& face = kFaces[way_in];
    const auto& points = mesh.cells[cell].points;
    in += product(points[face[e]], points[face[(e + 1) % 3]]);
  }
  const float sign = in > 0 ? -1.0f : 1.0f;
  for (std::uint32_t cells = 1;; ++cells) {
    const PluckerMesh::Cell& record = mesh.cells[cell];
    const auto& points = record.points;
    std::uint32_t next = kNone;
    bool found = false;
    for (std::size_t face = 0; face < 4 && !found; ++face) {
      if (face == way_in) continue;
      const auto& loop = kFaces[face];
      audit.count_tests(1);
      if (sign * product(points[loop[0]], points[loop[1]]) < 0) continue;
      audit.count_tests(1);
      if (sign * product(points[loop[1]], points[loop[2]]) < 0) continue;
      audit.count_tests(1);
      if (sign * product(points[loop[2]], points[loop[0]]) < 0) continue;
      next = record.neighbors[face];
      found = true;
    }
    if (!found || next == kNone || cells == kPluckerLongest) return cells;
    cell = next >> 2;
    way_in = next & 3;
  }
}

}  // namespace

void walk_naive_plucker(const BenchMesh& mesh, const BenchView& view, std::span<PassageSum> sums) {
  NoAudit audit;
  for (std::size_t i = 0; i < view.passages.size(); ++i) {
    const Passage& passage = view.passages[i];
    const PluckerRay ray(view.rays[passage.ray], mesh.plucker.frame);
    sums[i] = {walk(mesh.plucker, ray, mesh.tets.boundary[passage.entry.boundary], audit), 0, 0};
  }
}

PluckerCounts count_naive_tests(const BenchMesh& mesh, const BenchView& view) {
  PluckerCounts counts;
  CountingAudit audit;
  for (const Passage& passage : view.passages)
    counts.cells += walk(mesh.plucker, PluckerRay(view.rays[passage.ray], mesh.plucker.frame),
                         mesh.tets.boundary[passage.entry.boundary], audit);
  counts.tests = audit.tests;
  return counts;
}

PluckerCounts count_optimised_tests(const BenchMesh& mesh, const BenchView& view) {
  PluckerCounts counts;
  CountingAudit audit;
  for (const Passage& passage : view.passages) {
    CellsConsumer<float> consumer(mesh.optics);
    counts.cells += walk_plucker<PluckerProducts::thesis>(
                        mesh.plucker, PluckerRay(view.rays[passage.ray], mesh.plucker.frame),
                        mesh.tets.boundary[passage.entry.boundary], consumer, audit)
                        .cells;
  }
  counts.tests = audit.tests;
  return counts;
}

}  // namespace plume::bench
