#include "our_walks.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <type_traits>
#include <utility>

#include "plume/mesh/corner_cells.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/rectilinear_start.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume::atlas {
namespace {

template <class Walker>
AtlasWalk walk_one(const typename Walker::Mesh& mesh, const BoundaryIndex<Walker>& boundary,
                   const Ray& ray) {
  AtlasWalk walk;
  const TraceResult result = trace(mesh, boundary, ray, [&](const Segment& s) {
    walk.spans.push_back({mesh.original_cell(s.cell), s.t_in, s.t_out, s.s_in, s.s_out});
    return true;
  });
  // trace() stops walks that go round in a circle, and calls them lost.
  walk.lost = result.end == WalkEnd::lost;
  return walk;
}

template <class Walker>
MethodWalks one_by_one(const char* name, const typename Walker::Mesh& mesh,
                       const std::vector<Ray>& rays) {
  MethodWalks made{name, true, true, Surface::faces, 0, {}};
  const BoundaryIndex<Walker> boundary(mesh);
  for (const Ray& ray : rays) made.walks.push_back(walk_one(mesh, boundary, ray));
  return made;
}

// Spans of passages, by the number that their starts have.
class Passages : public PacketSegmentSink {
 public:
  struct Passage {
    std::size_t ray;
    double t;  // where the next segment begins
  };
  std::vector<Passage> list;
  std::vector<AtlasWalk>& walks;

  explicit Passages(std::vector<AtlasWalk>& of) : walks(of) {}

  std::uint32_t add(std::size_t ray, double t) {
    list.push_back({ray, t});
    segments.emplace_back();
    return static_cast<std::uint32_t>(list.size() - 1);
  }
  void take(const PacketSegment& segment) override { segments[segment.ray].push_back(segment); }

  // Passages were added in the order in which their rays meet them.
  template <class Mesh>
  void put_together(const Mesh& mesh) {
    for (std::size_t p = 0; p < list.size(); ++p) {
      double t = list[p].t;
      for (const PacketSegment& s : segments[p]) {
        const double t_out = t + static_cast<double>(s.length);
        walks[list[p].ray].spans.push_back({mesh.original_cell(s.cell), t, t_out, s.s_in, s.s_out});
        t = t_out;
      }
    }
  }

 private:
  std::vector<std::vector<PacketSegment>> segments;
};

template <class Start>
class Starts : public PacketFeeder {
 public:
  explicit Starts(const std::vector<Start>& starts) : starts_(starts) {}
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }

 private:
  const std::vector<Start>& starts_;
  std::size_t at_ = 0;
};

// All passages of a ray as its twin meets them; nothing where packets would decline the ray.
struct Passage {
  Entry entry;
  double z_out;
};
template <class Walker>
std::optional<std::vector<Passage>> passages_of(const typename Walker::Mesh& mesh,
                                                const BoundaryIndex<Walker>& boundary,
                                                const ShearedFrame& frame, const Ray& ray) {
  std::vector<Passage> passages;
  Walker walker(mesh, frame);
  Entries<Walker> entries;
  for (auto entry = entries.first(boundary, walker, frame); entry;
       entry = entries.next(boundary, walker, frame)) {
    if (frame.t(entry->place.z) < ray.t_min) return std::nullopt;
    // As lib/packet_stream.cpp has it.
    if (!passages.empty() && (passages.back().z_out - entry->place.z) * frame.sign() > 1e-6)
      return std::nullopt;
    passages.push_back({*entry, entry->place.z});
    walker.enter(mesh.boundary[entry->boundary], entry->rank);
    do {
      const auto exit = walker.leave();
      if (!exit) return std::nullopt;
      if ((exit->z - passages.back().z_out) * frame.sign() > 0) passages.back().z_out = exit->z;
    } while (walker.advance());
  }
  return passages;
}

template <class Walker>
MethodWalks in_packets(const char* name, const typename Walker::Mesh& mesh,
                       const std::vector<Ray>& rays) {
  using Start = StartOf<typename Walker::Mesh>;
  MethodWalks made{name, true, true, Surface::faces, 0, {}};
  made.walks.resize(rays.size());
  const BoundaryIndex<Walker> boundary(mesh);
  Passages passages(made.walks);
  std::vector<Start> starts[3];
  std::deque<ShearedFrame> frames;  // starts refer to them
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ShearedFrame& frame = frames.emplace_back();
    if (!frame.set(rays[i], mesh.frame)) continue;
    const auto found = passages_of(mesh, boundary, frame, rays[i]);
    if (!found) {
      made.walks[i] = walk_one(mesh, boundary, rays[i]);
      continue;
    }
    double seen_until = -1e300;
    for (const Passage& passage : *found) {
      const double t = std::max(seen_until, frame.t(passage.entry.place.z));
      starts[frame.axis()].push_back(make_start(mesh, frame, mesh.boundary[passage.entry.boundary],
                                                passage.entry.place, passage.entry.rank,
                                                passages.add(i, t)));
      seen_until = frame.t(passage.z_out);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    Starts<Start> feeder(starts[axis]);
    walk_segments(mesh, axis, feeder, passages);
  }
  passages.put_together(mesh);
  return made;
}

MethodWalks rectilinear_in_packets(const WalkableRectilinear& mesh, const std::vector<Ray>& rays) {
  MethodWalks made{"RectilinearWalker, packets", true, true, Surface::faces, 0, {}};
  made.walks.resize(rays.size());
  const BoundaryIndex<RectilinearWalker> boundary(mesh);
  Passages passages(made.walks);
  std::deque<RectilinearWalker> walkers;  // starts refer to them
  std::vector<RectilinearStart> starts;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RectilinearWalker& walker = walkers.emplace_back(mesh);
    RectilinearStart start;
    const auto number = static_cast<std::uint32_t>(passages.list.size());
    switch (set_start(start, walker, mesh, rays[i], number)) {
      case RectilinearRay::misses:
        break;
      case RectilinearRay::declined:
        made.walks[i] = walk_one(mesh, boundary, rays[i]);
        break;
      case RectilinearRay::ready:
        passages.add(i, walker.t_in());
        starts.push_back(start);
        break;
    }
  }
  Starts<RectilinearStart> feeder(starts);
  walk_segments(mesh, feeder, passages);
  passages.put_together(mesh);
  return made;
}

}  // namespace

std::vector<MethodWalks> our_walks(const SceneMesh& scene) {
  const Bounds bounds = check_structure(scene.mesh);
  const ScalarField field = select_field(scene.mesh);
  std::vector<MethodWalks> all;
  if (scene.mesh.is_rectilinear()) {
    const WalkableRectilinear mesh = make_walkable_rectilinear(scene.mesh, field);
    all.push_back(one_by_one<RectilinearWalker>("RectilinearWalker", mesh, scene.rays));
    if (walked_by_packets(mesh)) all.push_back(rectilinear_in_packets(mesh, scene.rays));
  } else if (scene.mesh.is_grid()) {
    const WalkableGrid mesh = make_walkable_grid(scene.mesh, field, bounds);
    all.push_back(one_by_one<GridWalker>("GridWalker", mesh, scene.rays));
    all.push_back(in_packets<GridWalker>("GridWalker, packets", mesh, scene.rays));
    all.push_back(one_by_one<PluckerGridWalker>("PluckerGridWalker", mesh, scene.rays));
    all.back().surface = Surface::triangles;
    all.push_back(one_by_one<HybridGridWalker>("HybridGridWalker", mesh, scene.rays));
    all.back().promised = false;  // a face that is grazed counts as missed
  } else if (scene.cells == "tetrahedra") {
    const WalkableTets mesh = make_walkable_tets(scene.mesh, field, bounds, true);
    all.push_back(one_by_one<TetWalker>("TetWalker", mesh, scene.rays));
    all.push_back(in_packets<TetWalker>("TetWalker, packets", mesh, scene.rays));
    const WalkableCells cells = make_walkable_cells(scene.mesh, field, bounds, true);
    all.push_back(one_by_one<CellWalker>("CellWalker", cells, scene.rays));
  } else {
    WalkableCells mesh = make_walkable_cells(scene.mesh, field, bounds, true);
    all.push_back(one_by_one<CellWalker>("CellWalker", mesh, scene.rays));
    mesh.corner_cells = make_corner_cells(mesh);
    if (!mesh.corner_cells.empty())
      all.push_back(in_packets<CellWalker>("CellWalker, packets", mesh, scene.rays));
  }
  return all;
}

}  // namespace plume::atlas
