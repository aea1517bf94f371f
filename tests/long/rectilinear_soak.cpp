#include <deque>
#include <limits>
#include <vector>

#include "plume/mesh/validate.h"
#include "plume/tests/long/aimed_rays.h"
#include "plume/tests/long/soak_ways.h"
#include "plume/traverse/rectilinear_start.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume::test {
namespace {

class RectilinearSoak : public SoakMesh {
 public:
  RectilinearSoak(const std::string& name, Mesh mesh)
      : name_(name),
        mesh_(std::move(mesh)),
        bounds_(check_structure(mesh_)),
        grid_(make_walkable_rectilinear(mesh_, select_field(mesh_))),
        boundary_(grid_) {}

  SoakTally soak(std::uint64_t seed, std::uint64_t batch, std::uint64_t rays) const override {
    SoakTally tally;
    Failures fail(tally, name_, seed, batch);
    AimedRays make_ray(mesh_, bounds_, seed * 0x9E3779B97F4A7C15ull + batch);
    std::vector<Way> ways;
    std::vector<std::uint64_t> ray_of;
    std::vector<Ray> of_way;
    std::deque<RectilinearWalker> walkers;  // starts refer to them
    std::vector<RectilinearStart> starts;
    for (std::uint64_t number = 0; number < rays; ++number) {
      const Ray ray = make_ray(number);
      ++tally.rays;
      if (!(ray.direction[0] == ray.direction[0])) {
        ++tally.aimless;
        continue;
      }
      bool in_order = true;
      const Way way = walk(ray, tally, number, fail, in_order);
      if (!in_order) fail(tally.contradictions, number, "segments leave gaps or go back");
      const Chord chord(bounds_, ray);
      tally.worst_twin = std::max(tally.worst_twin, chord.error(way.length));
      if (!chord.holds(way.length, kTwinSlack))
        fail(tally.off_length, number, "the twin's segments do not sum up to the chord");
      if (number % 8 == 0) {
        Ray turned = ray;
        for (double& x : turned.direction) x = -x;
        if (walk(turned, tally, number, fail, in_order).forth != way.back)
          fail(tally.one_way, number, "another way when turned around");
      }
      RectilinearStart start;
      const RectilinearRay ready = set_start(start, walkers.emplace_back(grid_), grid_, ray,
                                             static_cast<std::uint32_t>(ways.size()));
      if ((ready == RectilinearRay::ready) != (way.cells > 0))
        fail(tally.contradictions, number, "packets and trace() do not both meet the grid");
      if (ready != RectilinearRay::ready) continue;
      starts.push_back(start);
      ways.push_back(way);
      ray_of.push_back(number);
      of_way.push_back(ray);
      tally.cells += way.cells;
    }
    tally.passages = ways.size();
    PacketWays packets(ways.size());
    std::vector<std::uint32_t> counts(ways.size(), 0);
    Starts<RectilinearStart> to_walk(starts), to_count(starts);
    walk_segments(grid_, to_walk, packets);
    count_cells(grid_, to_count, counts);
    for (std::size_t p = 0; p < ways.size(); ++p) {
      if (packets.ways[p].forth != ways[p].forth || packets.ways[p].cells != ways[p].cells ||
          counts[p] != ways[p].cells)
        fail(tally.different, ray_of[p], "packets meet other cells than the twin");
      const Chord chord(bounds_, of_way[p]);
      tally.worst_packets = std::max(tally.worst_packets, chord.error(packets.ways[p].length));
      if (!chord.holds(packets.ways[p].length, kPacketSlack))
        fail(tally.off_length, ray_of[p], "the packets' segments do not sum up to the chord");
    }
    return tally;
  }

 private:
  Way walk(const Ray& ray, SoakTally& tally, std::uint64_t number, Failures& fail,
           bool& in_order) const {
    Way way;
    double until = std::numeric_limits<double>::quiet_NaN();
    const TraceResult result = trace(grid_, boundary_, ray, [&](const Segment& s) {
      if (!(s.t_in <= s.t_out) || (way.cells > 0 && s.t_in != until)) in_order = false;
      until = s.t_out;
      way.add(s.cell);
      way.length += s.t_out - s.t_in;
      return true;
    });
    if (result.end != WalkEnd::left) fail(tally.lost, number, "lost");
    return way;
  }

  std::string name_;
  Mesh mesh_;
  Bounds bounds_;
  WalkableRectilinear grid_;
  BoundaryIndex<RectilinearWalker> boundary_;
};

}  // namespace

std::unique_ptr<SoakMesh> make_rectilinear_soak_mesh(const std::string& name, Mesh mesh) {
  return std::make_unique<RectilinearSoak>(name, std::move(mesh));
}

}  // namespace plume::test
