/// A view's passages by one of our scalar walkers, as trace() walks them, without the entries.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

/// Where nothing is measured, a walker that can decide without measuring does. A passage that finds
/// no way out ends there; its sums give it away.
template <class Walker>
void walk_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                   std::span<PassageSum> sums) {
  const auto& form = form_of<typename Walker::Mesh>(mesh);
  with_consumer<double>(mode, [&]<class Consumer>() {
    for (std::size_t i = 0; i < view.passages.size(); ++i) {
      const Entry& entry = view.entry<Walker>(i);
      ShearedFrame frame;
      frame.set(view.rays[view.passages[i].ray], form.frame);
      Walker walker(form, frame);
      walker.enter(form.boundary[entry.boundary], entry.rank);
      Consumer consumer(mesh.optics);
      double t_in = frame.t(entry.place.z);
      float s_in = entry.place.scalar;
      std::uint32_t cells = 0;
      do {
        ++cells;
        if constexpr (!Consumer::kMeasures && requires { walker.decide(); }) {
          walker.decide();
        } else {
          const std::optional<Crossing> exit = walker.leave();
          if (!exit) break;
          if constexpr (Consumer::kMeasures) {
            const double t_out = std::max(t_in, frame.t(exit->z));
            if (!consumer.add(t_in, t_out, s_in, exit->scalar)) break;
            t_in = t_out;
            s_in = exit->scalar;
          }
        }
      } while (walker.advance());
      sums[i] = consumer.sum(cells);
    }
  });
}

}  // namespace plume::bench
