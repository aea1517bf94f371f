#include <tbb/enumerable_thread_specific.h>

#include <string>
#include <type_traits>
#include <variant>

#include "plume/lib/packet_tile.h"
#include "plume/lib/rectilinear_tile.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/volume_tiles.h"
#include "plume/traverse/packets.h"

namespace plume {
namespace {

template <class Walkable>
class PacketTiles : public TileMaker {
 public:
  PacketTiles(Frame& frame, const Walkable& walkable, const ClosedForm& integrator,
              const PieceTable& pieces)
      : frame_(frame), walkable_(walkable), integrator_(integrator), packets_([&] {
          return PacketTile<typename Walkable::Walker>(
              walkable.mesh, walkable.boundary, pieces,
              static_cast<float>(frame.settings().early_termination));
        }) {}

  void make(const Tile& tile, Counts& counts) override {
    auto& packets = packets_.local();
    packets.clear();
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) { packets.add(frame_.ray(pixel)); });
    packets.composite();
    std::size_t ray = 0;
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) {
      const PacketResult result = packets.result(ray++);
      if (result.declined) {
        counts.add(volume_pixel(frame_, walkable_, integrator_, pixel));
        return;
      }
      counts.add(result.trace);
      ++counts.in_packets;
      float* rgba = frame_.rgba(pixel);
      rgba[0] = result.color.r;
      rgba[1] = result.color.g;
      rgba[2] = result.color.b;
      rgba[3] = 1 - result.color.transmittance;
    });
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const ClosedForm& integrator_;
  tbb::enumerable_thread_specific<PacketTile<typename Walkable::Walker>> packets_;
};

}  // namespace

bool has_packets(const Scene& scene) {
  return std::visit(
      [](const auto& walkable) {
        using Walker = typename std::decay_t<decltype(*walkable)>::Walker;
        if constexpr (std::is_same_v<Walker, CellWalker>)
          return !walkable->mesh.corner_cells.empty();
        if constexpr (std::is_same_v<Walker, RectilinearWalker>)
          return walked_by_packets(walkable->mesh);
        return true;
      },
      scene.body().walkable);
}

bool walked_in_packets(const Frame& frame) {
  const RenderSettings& settings = frame.settings();
  return is_linear(frame.scene(), settings) && has_packets(frame.scene()) &&
         !is_classified(frame.scene(), settings) && settings.clip_planes.empty() &&
         !settings.scalar_twin && settings.mode == Mode::volume &&
         settings.integrator.kind == IntegratorKind::closed_form && settings.channels.empty();
}

std::unique_ptr<TileMaker> packet_tiles(Frame& frame, const Integrator& integrator,
                                        const PieceTable& pieces) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        return std::make_unique<PacketTiles<std::decay_t<decltype(*walkable)>>>(
            frame, *walkable, std::get<ClosedForm>(integrator), pieces);
      },
      frame.scene().body().walkable);
}

}  // namespace plume
