#include "plume/tests/bench/bench_walkers.h"

#include <algorithm>

#include "plume/tests/bench/packet_walker.h"
#include "plume/traverse/tet_walker.h"

namespace plume::bench {
namespace {

template <PluckerProducts kProducts>
void walk_plucker_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                           std::span<PassageSum> sums) {
  with_consumer<float>(mode, [&]<class Consumer>() {
    for (std::size_t i = 0; i < view.passages.size(); ++i) {
      const Passage& passage = view.passages[i];
      const PluckerRay ray(view.rays[passage.ray], mesh.plucker.frame);
      Consumer consumer(mesh.optics);
      NoAudit audit;
      const PluckerWalk walk = walk_plucker<kProducts>(
          mesh.plucker, ray, mesh.tets.boundary[passage.entry.boundary], consumer, audit);
      sums[i] = consumer.sum(walk.cells);
    }
  });
}

// As trace() does it, without the entries.
void walk_tets(const BenchMesh& mesh, const BenchView& view, Mode mode,
               std::span<PassageSum> sums) {
  with_consumer<double>(mode, [&]<class Consumer>() {
    for (std::size_t i = 0; i < view.passages.size(); ++i) {
      const Passage& passage = view.passages[i];
      ShearedFrame frame;
      frame.set(view.rays[passage.ray], mesh.tets.frame);
      TetWalker walker(mesh.tets, frame);
      walker.enter(mesh.tets.boundary[passage.entry.boundary], passage.entry.rank);
      Consumer consumer(mesh.optics);
      double t_in = frame.t(passage.entry.place.z);
      float s_in = passage.entry.place.scalar;
      std::uint32_t cells = 0;
      do {
        ++cells;
        if constexpr (!Consumer::kMeasures) {
          walker.decide();
        } else {
          const std::optional<Crossing> exit = walker.leave();
          const double t_out = std::max(t_in, frame.t(exit->z));
          if (!consumer.add(t_in, t_out, s_in, exit->scalar)) break;
          t_in = t_out;
          s_in = exit->scalar;
        }
      } while (walker.advance());
      sums[i] = consumer.sum(cells);
    }
  });
}

std::size_t plucker_bytes(const BenchMesh& mesh) { return mesh.plucker.bytes(); }

std::size_t tets_bytes(const BenchMesh& mesh) {
  return mesh.tets.cells.size() * sizeof(WalkableTets::Cell) +
         mesh.tets.points.size() * sizeof(WalkablePoint);
}

const std::vector<Mode> kAllModes(kModes.begin(), kModes.end());
const std::vector<Mode> kPacketModes{Mode::cells, Mode::integral, Mode::isosurface,
                                     Mode::closed_form};

}  // namespace

bool BenchWalker::has(Mode mode) const {
  return std::find(modes.begin(), modes.end(), mode) != modes.end();
}

const std::vector<BenchWalker>& walkers() {
  static const std::vector<BenchWalker> all = [] {
    std::vector<BenchWalker> walkers{
        {"plucker", walk_plucker_passages<PluckerProducts::thesis>, kAllModes, false,
         plucker_bytes},
        {"tet-walker", walk_tets, kAllModes, true, tets_bytes},
        {"plucker-fast", walk_plucker_passages<PluckerProducts::relative>, kAllModes, false,
         plucker_bytes},
        {"tet-packets", walk_packet_passages, kPacketModes, true, tets_bytes},
    };
    if (packets_have_more_than_avx2())
      walkers.push_back(
          {"packets-avx2", walk_packet_passages_avx2, kPacketModes, true, tets_bytes});
    return walkers;
  }();
  return all;
}

}  // namespace plume::bench
