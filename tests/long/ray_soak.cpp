#include "plume/tests/long/ray_soak.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "plume/mesh/validate.h"
#include "plume/tests/long/aimed_rays.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/trace.h"

namespace plume::test {
namespace {

constexpr std::uint64_t kGroup = 2 * AimedRays::kKinds;    // all kinds of rays
constexpr std::uint64_t kTurnEvery = 8, kCountEvery = 16;  // groups
constexpr std::size_t kSmallBoundary = 4000;               // faces that can be tried one by one

// The cells of a passage in their order, and in the reverse order, as one number each: polynomials
// modulo 2^64, so that neither way needs the cells to be kept.
struct Way {
  std::uint64_t forth = 0, back = 0, power = 1;
  std::uint64_t cells = 0;
  double length = 0;

  void add(std::uint32_t cell) {
    std::uint64_t mixed = (cell + 1) * 0x9E3779B97F4A7C15ull;
    mixed ^= mixed >> 29;
    constexpr std::uint64_t kBase = 0xD1342543DE82EF95ull;
    forth = forth * kBase + mixed;
    back += mixed * power;
    power *= kBase;
    ++cells;
  }
};

// All passages of a ray by the scalar walker alone.
struct TwinWalk {
  std::vector<Way> ways;
  std::vector<TetStart> starts;
  bool lost = false;

  void clear() {
    ways.clear();
    starts.clear();
    lost = false;
  }
};

void walk_twin(const SoakMesh& mesh, const ShearedFrame& frame, TwinWalk& walk) {
  walk.clear();
  TetWalker walker(mesh.tets, frame);
  Entries<TetWalker> entries;
  const std::uint64_t longest = 4 * mesh.tets.cell_count();  // each cell has four ways in
  for (auto entry = entries.first(mesh.boundary, walker, frame); entry;
       entry = entries.next(mesh.boundary, walker, frame)) {
    walker.enter(mesh.tets.boundary[entry->boundary], entry->rank);
    walk.starts.push_back(make_start(mesh.tets, frame, mesh.tets.boundary[entry->boundary],
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

TraceWalk walk_trace(const SoakMesh& mesh, const Ray& ray) {
  TraceWalk walk;
  double seen_until = -std::numeric_limits<double>::infinity();
  walk.result = trace(mesh.tets, mesh.boundary, ray, [&](const Segment& segment) {
    if (!(segment.t_in <= segment.t_out) || !(seen_until <= segment.t_in)) walk.in_order = false;
    seen_until = segment.t_out;
    walk.way.add(segment.cell);
    walk.way.length += segment.t_out - segment.t_in;
    return true;
  });
  return walk;
}

// As many ways in, and as many out, as the windings of all boundary faces say.
bool right_number(const SoakMesh& mesh, const ShearedFrame& frame, std::size_t passages) {
  const TetWalker walker(mesh.tets, frame);
  std::uint64_t in = 0, out = 0;
  for (const WalkableTets::Boundary& face : mesh.tets.boundary) {
    const int winding = walker.boundary_winding(face) * frame.sign();
    if (winding < 0) in += static_cast<std::uint64_t>(-winding);
    if (winding > 0) out += static_cast<std::uint64_t>(winding);
  }
  return in == passages && out == passages;
}

// The same cells the other way round. Passages may come in another order where parts overlap.
bool same_turned(const SoakMesh& mesh, const Ray& ray, const TwinWalk& forth, TwinWalk& back) {
  Ray turned = ray;
  for (double& x : turned.direction) x = -x;
  ShearedFrame frame;
  frame.set(turned, mesh.tets.frame);
  walk_twin(mesh, frame, back);
  if (back.lost || back.ways.size() != forth.ways.size()) return false;
  std::vector<std::uint64_t> expected, found;
  for (const Way& way : forth.ways) expected.push_back(way.back);
  for (const Way& way : back.ways) found.push_back(way.forth);
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  return expected == found;
}

class Starts : public PacketFeeder {
 public:
  explicit Starts(const std::vector<TetStart>& starts) : starts_(starts) {}
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }

 private:
  const std::vector<TetStart>& starts_;
  std::size_t at_ = 0;
};

class PacketWays : public PacketSegmentSink {
 public:
  explicit PacketWays(std::size_t passages) : ways(passages) {}
  void take(const PacketSegment& segment) override {
    ways[segment.ray].add(segment.cell);
    ways[segment.ray].length += static_cast<double>(segment.length);
  }
  std::vector<Way> ways;
};

// Whether a sum is the chord, and how far from it.
class Chord {
 public:
  Chord(const Bounds& bounds, const Ray& ray) : bounds_(bounds), ray_(ray) {
    chord_ = reference::box_chord(bounds.low, bounds.high, ray.origin, ray.direction);
    const auto range = of(kTwinSlack);
    well_defined_ = range[0] > 0 && range[1] - range[0] < 2e-5 * bounds.diagonal();
  }
  bool holds(double sum, double slack) const {
    const auto range = of(slack);
    return sum >= range[0] && sum <= range[1];
  }
  double error(double sum) const {
    return well_defined_ ? std::abs(sum - chord_) / bounds_.diagonal() : 0;
  }

 private:
  std::array<double, 2> of(double slack) const {
    return reference::box_chord_range(bounds_.low, bounds_.high, ray_.origin, ray_.direction,
                                      slack * bounds_.diagonal());
  }
  const Bounds& bounds_;
  const Ray& ray_;
  double chord_;
  bool well_defined_;
};

}  // namespace

SoakMesh::SoakMesh(std::string mesh_name, Mesh source, bool fills)
    : name(std::move(mesh_name)),
      fills_bounds(fills),
      mesh(std::move(source)),
      bounds(check_structure(mesh)),
      tets(make_walkable_tets(mesh, select_field(mesh), bounds, false)),
      boundary(tets) {}

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

SoakTally soak(const SoakMesh& mesh, std::uint64_t seed, std::uint64_t batch, std::uint64_t rays) {
  SoakTally tally;
  std::uint64_t number = 0;
  auto fail = [&](std::uint64_t& count, std::uint64_t ray, const char* what) {
    ++count;
    if (tally.problem.empty())
      tally.problem = "mesh '" + mesh.name + "', seed " + std::to_string(seed) + ", batch " +
                      std::to_string(batch) + ", ray " + std::to_string(ray) + ": " + what +
                      " (packets: " + packet_instruction_set() + ")";
  };

  AimedRays make_ray(mesh.mesh, mesh.bounds, seed * 0x9E3779B97F4A7C15ull + batch);
  std::array<std::vector<TetStart>, 3> starts;  // of each axis
  std::vector<Way> ways;                        // of all passages
  std::vector<std::uint64_t> ray_of;
  std::vector<Ray> chord_rays(mesh.fills_bounds ? rays : 0);
  TwinWalk twin, turned;
  for (; number < rays; ++number) {
    const Ray ray = make_ray(number);
    ++tally.rays;
    ShearedFrame frame;
    if (!frame.set(ray, mesh.tets.frame)) {
      ++tally.aimless;
      continue;
    }
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
    else if (number / kGroup % kCountEvery == 0 && mesh.tets.boundary.size() <= kSmallBoundary &&
             !right_number(mesh, frame, twin.ways.size()))
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
      twin.starts[p].ray = static_cast<std::uint32_t>(ways.size());
      starts[static_cast<std::size_t>(frame.axis())].push_back(twin.starts[p]);
      ways.push_back(twin.ways[p]);
      ray_of.push_back(number);
      tally.cells += twin.ways[p].cells;
    }
  }
  tally.passages = ways.size();

  PacketWays packets(ways.size());
  std::vector<std::uint32_t> counts(ways.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& own = starts[static_cast<std::size_t>(axis)];
    Starts to_walk(own), to_count(own);
    walk_segments(mesh.tets, axis, to_walk, packets);
    count_cells(mesh.tets, axis, to_count, counts);
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

}  // namespace plume::test
