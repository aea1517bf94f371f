#include "chart_walkers.h"

#include <memory>
#include <string>
#include <utility>

#include "plume/lib/frame.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/volume_tiles.h"
#include "plume/preint/closed_form.h"
#include "plume/traverse/grid_walker.h"

namespace plume::command {
namespace {

// All that a frame needs besides settings.
template <class Walker>
struct WalkedGrid {
  Walkable<Walker> walkable;
  ClosedForm integrator;

  WalkedGrid(const WalkableGrid& grid, const TransferFunction& function)
      : walkable(grid), integrator(function) {}
};

template <class Walker>
void add(std::vector<ChartWay>& ways, const char* name, const WalkableGrid& grid,
         const Scene& scene, const Camera& camera, const RenderSettings& base) {
  const auto walked = std::make_shared<const WalkedGrid<Walker>>(grid, scene.transfer_function());
  for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
    RenderSettings settings = base;
    settings.order = order;
    settings.scalar_twin = true;
    ChartWay way = way_of(scene, settings);
    way.kind = WayKind::other_walker;
    way.name = std::string(order == ScalarOrder::linear ? "order 1" : "order 3") + "; " + name;
    way.draw = [walked, &scene, camera](const RenderSettings& asked) {
      return on_threads(asked.threads, [&] {
        Frame frame(scene, camera, asked);
        VolumeTiles<Walkable<Walker>, ClosedForm> tiles(frame, walked->walkable,
                                                        walked->integrator);
        RenderStatistics statistics;
        make_tiles(frame, tiles, {}, statistics);
        return std::move(frame.image());
      });
    };
    ways.push_back(std::move(way));
  }
}

}  // namespace

std::vector<ChartWay> other_walkers(const Scene& scene, const Camera& camera,
                                    const RenderSettings& base) {
  std::vector<ChartWay> ways;
  const auto* grid = std::get_if<std::unique_ptr<Walkable<GridWalker>>>(&scene.body().walkable);
  if (!grid || scene.field().association == Association::cell) return ways;
  add<PluckerGridWalker>(ways, "Plücker walker", (*grid)->mesh, scene, camera, base);
  add<HybridGridWalker>(ways, "hybrid walker", (*grid)->mesh, scene, camera, base);
  return ways;
}

}  // namespace plume::command
