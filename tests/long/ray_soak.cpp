#include "plume/tests/long/ray_soak.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <vector>

#include "plume/mesh/validate.h"
#include "plume/tests/long/aimed_rays.h"
#include "plume/tests/long/soak_entries.h"
#include "plume/tests/long/soak_ways.h"
#include "plume/traverse/trace.h"

namespace plume::test {
namespace {

constexpr std::uint64_t kGroup = 2 * AimedRays::kKinds;    // all kinds of rays
constexpr std::uint64_t kTurnEvery = 8, kCountEvery = 16;  // groups
constexpr std::size_t kSmallBoundary = 4000;               // faces that can be tried one by one

// A mesh in the form of its walker.
template <class W>
struct Made {
  using Walker = W;
  using Form = typename W::Mesh;
  std::string name;
  bool fills_bounds;
  Mesh mesh;
  Bounds bounds;
  Form form;
  BoundaryIndex<W> boundary;

  Made(const std::string& n, Mesh source, bool fills)
      : name(n),
        fills_bounds(fills),
        mesh(std::move(source)),
        bounds(check_structure(mesh)),
        form(make(n, mesh, bounds)),
        boundary(form) {}

 private:
  static Form make([[maybe_unused]] const std::string& name, const Mesh& mesh,
                   const Bounds& bounds) {
    if constexpr (std::is_same_v<Form, WalkableTets>) {
      const bool compact = name.find("compact") != std::string::npos;
      return make_walkable_tets(mesh, select_field(mesh), bounds, false, false,
                                compact ? TetLinks::compact : TetLinks::whole);
    } else if constexpr (std::is_same_v<Form, WalkableGrid>) {
      return make_walkable_grid(mesh, select_field(mesh), bounds);
    } else {
      Form form = make_walkable_cells(mesh, select_field(mesh), bounds, false);
      prepare_packets(form);
      return form;
    }
  }
};

// All passages of a ray by the scalar walker alone.
template <class Form>
struct TwinWalk {
  std::vector<Way> ways;
  std::vector<StartOf<Form>> starts;
  bool lost = false;

  void clear() {
    ways.clear();
    starts.clear();
    lost = false;
  }
};

bool has_packets(const WalkableTets&) { return true; }
bool has_packets(const WalkableGrid&) { return true; }
bool has_packets(const WalkableCells& cells) { return cells.has_packets(); }

template <class W>
void walk_twin(const Made<W>& mesh, const ShearedFrame& frame, TwinWalk<typename W::Mesh>& walk) {
  walk.clear();
  W walker(mesh.form, frame);
  Entries<W> entries;
  // Each face of a cell has two ways in at the most; polyhedra of 32 faces are none of the meshes'.
  const std::uint64_t longest = 64 * mesh.form.cell_count();
  for (auto entry = entries.first(mesh.boundary, walker, frame); entry;
       entry = entries.next(mesh.boundary, walker, frame)) {
    walker.enter(mesh.form.boundary[entry->boundary], entry->rank);
    if (has_packets(mesh.form))
      walk.starts.push_back(make_start(mesh.form, frame, mesh.form.boundary[entry->boundary],
                                       entry->place, entry->rank, 0));
    Way& way = walk.ways.emplace_back();
    do {
      way.add(walker.cell());
      if (!walker.leave() || way.cells > longest) {
        walk.lost = true;
        return;
      }
    } while (walker.advance());
  }
}

// What trace() hands to those who look.
struct TraceWalk {
  TraceResult result;
  Way way;
  bool in_order = true;
};

template <class W>
TraceWalk walk_trace(const Made<W>& mesh, const Ray& ray) {
  TraceWalk walk;
  double seen_until = -std::numeric_limits<double>::infinity();
  walk.result = trace(mesh.form, mesh.boundary, ray, [&](const Segment& segment) {
    if (!(segment.t_in <= segment.t_out) || !(seen_until <= segment.t_in)) walk.in_order = false;
    seen_until = segment.t_out;
    walk.way.add(segment.cell);
    walk.way.length += segment.t_out - segment.t_in;
    return true;
  });
  return walk;
}

Ray turned_around(Ray ray) {
  for (double& x : ray.direction) x = -x;
  return ray;
}

// As many ways in, and as many out, as all boundary faces say, tried one by one.
template <class W>
bool right_number(const Made<W>& mesh, const Ray& ray, std::size_t passages) {
  auto ways_in = [&](const Ray& of) {
    ShearedFrame frame;
    frame.set(of, mesh.form.frame);
    const W walker(mesh.form, frame);
    std::uint64_t in = 0;
    for (const auto& face : mesh.form.boundary) {
      if constexpr (std::is_same_v<W, TetWalker>)
        in +=
            static_cast<std::uint64_t>(std::max(0, -walker.boundary_winding(face) * frame.sign()));
      else
        walker.ways_in(face, [&](const Crossing&, std::uint32_t) { ++in; });
    }
    return in;
  };
  return ways_in(ray) == passages && ways_in(turned_around(ray)) == passages;
}

// The same cells the other way round. Passages may come in another order where parts overlap.
template <class W>
bool same_turned(const Made<W>& mesh, const Ray& ray, const TwinWalk<typename W::Mesh>& forth,
                 TwinWalk<typename W::Mesh>& back) {
  ShearedFrame frame;
  frame.set(turned_around(ray), mesh.form.frame);
  walk_twin(mesh, frame, back);
  if (back.lost || back.ways.size() != forth.ways.size()) return false;
  std::vector<std::uint64_t> expected, found;
  for (const Way& way : forth.ways) expected.push_back(way.back);
  for (const Way& way : back.ways) found.push_back(way.forth);
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  return expected == found;
}

template <class W>
SoakTally soak_cells(const Made<W>& mesh, std::uint64_t seed, std::uint64_t batch,
                     std::uint64_t rays) {
  using Form = typename W::Mesh;
  SoakTally tally;
  std::uint64_t number = 0;
  Failures fail(tally, mesh.name, seed, batch);
  AimedRays make_ray(mesh.mesh, mesh.bounds, seed * 0x9E3779B97F4A7C15ull + batch);
  std::array<std::vector<StartOf<Form>>, 3> starts;  // of each axis
  std::deque<ShearedFrame> frames;                   // starts refer to them
  std::vector<Way> ways;                             // of all passages
  std::vector<std::uint64_t> ray_of;
  std::vector<Ray> chord_rays(mesh.fills_bounds ? rays : 0);
  TwinWalk<Form> twin, turned;
  EntriesTogether<W> entries(mesh.form, mesh.boundary);
  auto fail_entries = [&](const std::vector<std::uint64_t>& different) {
    for (const std::uint64_t ray : different)
      fail(tally.contradictions, ray, "other ways in, or at other places, among sixteen rays");
  };
  for (; number < rays; ++number) {
    const Ray ray = make_ray(number);
    ++tally.rays;
    ShearedFrame& frame = frames.emplace_back();
    if (!frame.set(ray, mesh.form.frame)) {
      ++tally.aimless;
      continue;
    }
    fail_entries(entries.add(ray, frame, number));
    walk_twin(mesh, frame, twin);
    const TraceWalk seen = walk_trace(mesh, ray);
    if (twin.lost || seen.result.end != WalkEnd::left) {
      fail(tally.lost, number, "lost");
      continue;
    }
    if (!(seen.way.length <= (1 + kTwinSlack) * mesh.bounds.diagonal()))
      fail(tally.off_length, number, "the twin's segments are longer than the mesh");
    const bool alike = seen.in_order && seen.result.entries == twin.ways.size() &&
                       (twin.ways.size() != 1 || (seen.way.forth == twin.ways[0].forth &&
                                                  seen.way.cells == twin.ways[0].cells));
    if (!alike)
      fail(tally.contradictions, number, "trace() and the walker alone differ, or out of order");
    else if (number / kGroup % kCountEvery == 0 && mesh.form.boundary.size() <= kSmallBoundary &&
             !right_number(mesh, ray, twin.ways.size()))
      fail(tally.contradictions, number, "another number of ways in or out than of windings");
    if (number / kGroup % kTurnEvery == 0 && !same_turned(mesh, ray, twin, turned))
      fail(tally.one_way, number, "another way when turned around");
    if (mesh.fills_bounds) {
      chord_rays[number] = ray;
      const Chord chord(mesh.bounds, ray);
      tally.worst_twin = std::max(tally.worst_twin, chord.error(seen.way.length));
      if (!chord.holds(seen.way.length, kTwinSlack))
        fail(tally.off_length, number, "the twin's segments do not sum up to the chord");
    }
    for (std::size_t p = 0; p < twin.ways.size(); ++p) {
      if (has_packets(mesh.form)) {
        twin.starts[p].ray = static_cast<std::uint32_t>(ways.size());
        starts[static_cast<std::size_t>(frame.axis())].push_back(twin.starts[p]);
      }
      ways.push_back(twin.ways[p]);
      ray_of.push_back(number);
      tally.cells += twin.ways[p].cells;
    }
  }
  fail_entries(entries.finish());
  tally.passages = ways.size();
  if (!has_packets(mesh.form)) return tally;

  PacketWays packets(ways.size());
  std::vector<std::uint32_t> counts(ways.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& own = starts[static_cast<std::size_t>(axis)];
    Starts<StartOf<Form>> to_walk(own), to_count(own);
    walk_segments(mesh.form, axis, to_walk, packets);
    count_cells(mesh.form, axis, to_count, counts);
  }
  for (std::size_t p = 0; p < ways.size(); ++p) {
    if (packets.ways[p].forth != ways[p].forth || packets.ways[p].cells != ways[p].cells ||
        counts[p] != ways[p].cells)
      fail(tally.different, ray_of[p], "packets meet other cells than the twin");
    if (!(packets.ways[p].length <= (1 + kPacketSlack) * mesh.bounds.diagonal())) {  // or NaN
      fail(tally.off_length, ray_of[p], "a packet's passage is longer than the mesh");
      continue;
    }
    const bool alone = (p == 0 || ray_of[p - 1] != ray_of[p]) &&
                       (p + 1 == ways.size() || ray_of[p + 1] != ray_of[p]);
    if (!mesh.fills_bounds || !alone) continue;
    const Chord chord(mesh.bounds, chord_rays[ray_of[p]]);
    tally.worst_packets = std::max(tally.worst_packets, chord.error(packets.ways[p].length));
    if (!chord.holds(packets.ways[p].length, kPacketSlack))
      fail(tally.off_length, ray_of[p], "the packets' segments do not sum up to the chord");
  }
  return tally;
}

template <class W>
class CellsSoak : public SoakMesh {
 public:
  CellsSoak(const std::string& name, Mesh mesh, bool fills) : made_(name, std::move(mesh), fills) {}
  SoakTally soak(std::uint64_t seed, std::uint64_t batch, std::uint64_t rays) const override {
    return soak_cells(made_, seed, batch, rays);
  }

 private:
  Made<W> made_;
};

}  // namespace

std::unique_ptr<SoakMesh> make_soak_mesh(const std::string& name, Mesh mesh, bool fills) {
  if (mesh.is_rectilinear()) return make_rectilinear_soak_mesh(name, std::move(mesh));
  if (mesh.is_grid()) return std::make_unique<CellsSoak<GridWalker>>(name, std::move(mesh), fills);
  if (mesh.cells.types.size() == 1 &&
      mesh.cells.types.at<int>(0) == static_cast<int>(CellType::tetrahedron))
    return std::make_unique<CellsSoak<TetWalker>>(name, std::move(mesh), fills);
  return std::make_unique<CellsSoak<CellWalker>>(name, std::move(mesh), fills);
}

void SoakTally::add(const SoakTally& other) {
  rays += other.rays;
  aimless += other.aimless;
  passages += other.passages;
  cells += other.cells;
  lost += other.lost;
  contradictions += other.contradictions;
  different += other.different;
  one_way += other.one_way;
  off_length += other.off_length;
  worst_twin = std::max(worst_twin, other.worst_twin);
  worst_packets = std::max(worst_packets, other.worst_packets);
  if (problem.empty()) problem = other.problem;
}

}  // namespace plume::test
