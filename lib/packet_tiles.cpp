#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "plume/lib/classified_tiles.h"
#include "plume/lib/curved_packets.h"
#include "plume/lib/packet_pixels.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/volume_tiles.h"
#include "plume/traverse/packets.h"

namespace plume {
namespace {

// Of one thread's rays.
template <class Walkable>
class StreamLight : public PacketLight {
 public:
  StreamLight(const SurfaceLight<Walkable>& light, const PacketStreamOf<Walkable>& stream)
      : light_(light), stream_(stream) {}

  Shading at(std::uint32_t ray, float z, float back, std::uint32_t cell) const override {
    return light_.shading(stream_.ray(ray), stream_.distance(ray, z) - back, cell);
  }

 private:
  const SurfaceLight<Walkable>& light_;
  const PacketStreamOf<Walkable>& stream_;
};

// `Twin` makes the pixels of rays that packets decline.
template <class Walkable, class Twin>
class PacketTiles : public TileMaker {
 public:
  PacketTiles(Frame& frame, const Walkable& walkable, const ClosedForm& integrator,
              const PacketPieces& pieces)
      : frame_(frame),
        walkable_(walkable),
        pieces_(pieces),
        twin_(frame, walkable, integrator),
        light_(frame, walkable) {}

  void make(TileSource& tiles, Counts& counts) override {
    Stream stream(walkable_.mesh, walkable_.boundary, frame_.gap());
    Pixels pixels(frame_, tiles, twin_, counts);
    composite(stream, pixels, counts);
  }

 private:
  using Stream = PacketStreamOf<Walkable>;

  class Pixels : public PacketPixels<Twin> {
   public:
    Pixels(Frame& frame, TileSource& tiles, Twin& twin, Counts& counts)
        : PacketPixels<Twin>(frame, tiles, twin, counts), frame_(frame) {}

    void begin(std::uint32_t) override {}
    void put(const PixelPlace& pixel, const PacketColor& color, const TraceResult& trace,
             std::uint32_t) override {
      this->count(trace);
      float* rgba = frame_.rgba(pixel);
      rgba[0] = color.r;
      rgba[1] = color.g;
      rgba[2] = color.b;
      rgba[3] = 1 - color.transmittance;
    }
    void miss(const PixelPlace&) override {}  // pixels are empty from the start

   private:
    Frame& frame_;
  };

  void composite(Stream& stream, Pixels& pixels, Counts& counts) const {
    PacketOptics optics;
    optics.early_termination = static_cast<float>(frame_.settings().early_termination);
    if (const auto* volume = std::get_if<PieceTable>(&pieces_)) {
      if (!is_linear(frame_.scene(), frame_.settings()))
        return composite_curved(stream, pixels, *volume);
      optics.volume = volume;
      stream.composite(optics, pixels);
      return;
    }
    const StreamLight<Walkable> light(light_, stream);
    ClassifiedPackets classified{std::get<ClassifiedPieces>(pieces_), {}};
    if (light_.is_on()) classified.light = &light;
    classified.light_intervals = light_.on_intervals();
    optics.classified = &classified;
    stream.composite(optics, pixels);
    counts.surfaces += classified.surfaces_crossed;
    counts.visits += classified.intervals_visited;
  }

  void composite_curved(Stream& stream, Pixels& pixels, const PieceTable& volume) const {
    if constexpr (kCurvedPackets<Walkable>) {
      const RenderSettings& settings = frame_.settings();
      CurvedPackets curved{&volume,
                           settings.order,
                           static_cast<float>(frame_.tolerance()),
                           static_cast<float>(settings.early_termination),
                           {}};
      stream.walk_by(
          [&](std::span<PacketColor> colors, int axis, PacketFeeder& feeder) {
            curved.colors = colors;
            composite_curved_packets(walkable_.mesh, curved, axis, feeder);
          },
          pixels);
    }
  }

  Frame& frame_;
  const Walkable& walkable_;
  const PacketPieces& pieces_;
  Twin twin_;
  const SurfaceLight<Walkable> light_;
};

}  // namespace

bool has_packets(const Scene& scene) {
  return std::visit(
      [](const auto& walkable) {
        using Walker = typename std::decay_t<decltype(*walkable)>::Walker;
        if constexpr (std::is_same_v<Walker, CellWalker>) return walkable->mesh.has_packets();
        if constexpr (std::is_same_v<Walker, RectilinearWalker>)
          return walked_by_packets(walkable->mesh);
        return true;
      },
      scene.body().walkable);
}

bool has_packets_of_order(const Scene& scene, const RenderSettings& settings) {
  if (is_linear(scene, settings)) return true;
  return std::visit(
      [](const auto& walkable) {
        using Form = std::decay_t<decltype(*walkable)>;
        // What is inside of a cell is read from its eight corners.
        if constexpr (std::is_same_v<typename Form::Walker, CellWalker>)
          if (walkable->mesh.corner_cells.empty()) return false;
        return kCurvedPackets<Form>;
      },
      scene.body().walkable);
}

std::optional<PacketPieces> pieces_for_packets(const Frame& frame) {
  const RenderSettings& settings = frame.settings();
  const bool served =
      has_packets_of_order(frame.scene(), settings) && has_packets(frame.scene()) &&
      settings.clip_planes.empty() && !settings.scalar_twin && settings.mode == Mode::volume &&
      settings.integrator.kind == IntegratorKind::closed_form && settings.channels.empty();
  if (!served) return std::nullopt;
  const Classification& classification = frame.scene().classification();
  if (!is_classified(frame.scene(), settings)) return PieceTable(frame.scene().transfer_function());
  if (!is_linear(frame.scene(), settings)) return std::nullopt;
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
