#include "plume/tests/bench/plucker_passages.h"

#include "plume/tests/bench/plucker_walker.h"

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

}  // namespace

void walk_thesis_plucker(const BenchMesh& mesh, const BenchView& view, Mode mode,
                         std::span<PassageSum> sums) {
  walk_plucker_passages<PluckerProducts::thesis>(mesh, view, mode, sums);
}

void walk_relative_plucker(const BenchMesh& mesh, const BenchView& view, Mode mode,
                           std::span<PassageSum> sums) {
  walk_plucker_passages<PluckerProducts::relative>(mesh, view, mode, sums);
}

}  // namespace plume::bench
