#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "plume/lib/classified_tiles.h"
#include "plume/lib/packet_tile.h"
#include "plume/lib/rectilinear_tile.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/volume_tiles.h"
#include "plume/traverse/packets.h"

namespace plume {
namespace {

template <class Walkable>
using PacketTileOf = PacketTile<typename Walkable::Walker>;

// Of one thread's tile.
template <class Walkable>
class TileLight : public PacketLight {
 public:
  TileLight(const SurfaceLight<Walkable>& light, const PacketTileOf<Walkable>& tile)
      : light_(light), tile_(tile) {}

  Shading at(std::uint32_t ray, float z, float back, std::uint32_t cell) const override {
    return light_.shading(tile_.ray(ray), tile_.distance(ray, z) - back, cell);
  }

 private:
  const SurfaceLight<Walkable>& light_;
  const PacketTileOf<Walkable>& tile_;
};

// `Twin` makes the pixels of rays that packets decline.
template <class Walkable, class Twin>
class PacketTiles : public TileMaker {
 public:
  PacketTiles(Frame& frame, const Walkable& walkable, const ClosedForm& integrator,
              const PacketPieces& pieces)
      : frame_(frame),
        pieces_(pieces),
        twin_(frame, walkable, integrator),
        light_(frame, walkable),
        packets_([&] {
          return PacketTileOf<Walkable>(walkable.mesh, walkable.boundary, frame.gap());
        }) {}

  void make(const Tile& tile, Counts& counts) override {
    auto& packets = packets_.local();
    packets.clear();
    // Packets walk whole passages: rays that end inside are walked one by one.
    std::array<PixelPlace, RayLanes::kRays> pixels;
    std::size_t size = 0;
    RayLanes rays;
    auto add = [&] {
      frame_.rays({pixels.data(), size}, rays);
      packets.add(rays);
      size = 0;
    };
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) {
      if (!frame_.sees_endlessly(pixel)) return twin_.make_pixel(pixel, counts);
      pixels[size++] = pixel;
      if (size == pixels.size()) add();
    });
    if (size > 0) add();
    composite(packets, counts);
    std::size_t ray = 0;
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) {
      if (!frame_.sees_endlessly(pixel)) return;
      const std::size_t number = ray++;
      ++counts.in_packets;
      if (!packets.meets(number)) return;  // pixels are empty from the start
      const PacketResult result = packets.result(number);
      if (result.declined) {
        --counts.in_packets;
        twin_.make_pixel(pixel, counts);
        return;
      }
      counts.add(result.trace);
      float* rgba = frame_.rgba(pixel);
      rgba[0] = result.color.r;
      rgba[1] = result.color.g;
      rgba[2] = result.color.b;
      rgba[3] = 1 - result.color.transmittance;
    });
  }

 private:
  void composite(PacketTileOf<Walkable>& packets, Counts& counts) const {
    PacketOptics optics;
    optics.early_termination = static_cast<float>(frame_.settings().early_termination);
    if (const auto* volume = std::get_if<PieceTable>(&pieces_)) {
      optics.volume = volume;
      packets.composite(optics);
      return;
    }
    const TileLight<Walkable> light(light_, packets);
    ClassifiedPackets classified{std::get<ClassifiedPieces>(pieces_), {}};
    if (light_.is_on()) classified.light = &light;
    classified.light_intervals = light_.on_intervals();
    optics.classified = &classified;
    packets.composite(optics);
    counts.surfaces += classified.surfaces_crossed;
    counts.visits += classified.intervals_visited;
  }

  Frame& frame_;
  const PacketPieces& pieces_;
  Twin twin_;
  const SurfaceLight<Walkable> light_;
  tbb::enumerable_thread_specific<PacketTileOf<Walkable>> packets_;
};

}  // namespace

bool has_packets(const Scene& scene) {
  return std::visit(
      [](const auto& walkable) {
        using Walker = typename std::decay_t<decltype(*walkable)>::Walker;
        if constexpr (std::is_same_v<Walker, CellWalker>)
          return walkable->mesh.has_packets();
        if constexpr (std::is_same_v<Walker, RectilinearWalker>)
          return walked_by_packets(walkable->mesh);
        return true;
      },
      scene.body().walkable);
}

std::optional<PacketPieces> pieces_for_packets(const Frame& frame) {
  const RenderSettings& settings = frame.settings();
  const bool served =
      is_linear(frame.scene(), settings) && has_packets(frame.scene()) &&
      settings.clip_planes.empty() && !settings.scalar_twin && settings.mode == Mode::volume &&
      settings.integrator.kind == IntegratorKind::closed_form && settings.channels.empty();
  if (!served) return std::nullopt;
  const Classification& classification = frame.scene().classification();
  if (!is_classified(frame.scene(), settings)) return PieceTable(frame.scene().transfer_function());
  if (settings.interval_way != IntervalWay::split) return std::nullopt;
  if (!classification.intervals.empty() && settings.interval_form != IntervalForm::exponential)
    return std::nullopt;
  ClassifiedPieces pieces(classification);
  if (!pieces.in_single_precision()) return std::nullopt;
  return pieces;
}

std::unique_ptr<TileMaker> packet_tiles(Frame& frame, const Integrator& integrator,
                                        const PacketPieces& pieces) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        using Form = std::decay_t<decltype(*walkable)>;
        const auto& closed_form = std::get<ClosedForm>(integrator);
        if (std::holds_alternative<PieceTable>(pieces))
          return std::make_unique<PacketTiles<Form, VolumeTiles<Form, ClosedForm>>>(
              frame, *walkable, closed_form, pieces);
        return std::make_unique<PacketTiles<Form, ClassifiedTiles<Form, ClosedForm>>>(
            frame, *walkable, closed_form, pieces);
      },
      frame.scene().body().walkable);
}

}  // namespace plume
