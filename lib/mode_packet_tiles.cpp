#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "plume/lib/curved_packets.h"
#include "plume/lib/mode_packets.h"
#include "plume/lib/mode_pixels.h"
#include "plume/lib/packet_pixels.h"
#include "plume/lib/render_modes.h"
#include "plume/lib/render_plan.h"
#include "plume/preint/visible_scalars.h"

namespace plume {

PacketNumber PacketNumber::before(Mode mode) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (mode == Mode::maximum) return {-kInfinity, 0};
  if (mode == Mode::minimum || mode == Mode::depth) return {kInfinity, 0};
  return {0, 0};
}

ExtinctionTable::ExtinctionTable(const PieceTable& table) {
  for (const PieceTable::Piece& piece : table.pieces)
    pieces.push_back({piece.low, piece.high, piece.extinction, piece.extinction_slope});
}

namespace {

// What packets found as the pixel that would have been given the ray's segments.
void take(MaximumPixel& pixel, const PacketNumber& number, const PacketColor&) {
  pixel.maximum = static_cast<float>(number.value);
}
void take(MinimumPixel& pixel, const PacketNumber& number, const PacketColor&) {
  pixel.minimum = static_cast<float>(number.value);
}
void take(AveragePixel& pixel, const PacketNumber& number, const PacketColor&) {
  pixel.integral = number.value;
  pixel.length = number.length;
}
void take(IntegralPixel& pixel, const PacketNumber& number, const PacketColor& color) {
  pixel.integral = number.value;
  pixel.any = color.cells > 0;
}
void take(OpticalDepthPixel& pixel, const PacketNumber& number, const PacketColor& color) {
  pixel.depth = number.value;
  pixel.any = color.cells > 0;
}
void take(FirstPixel& pixel, const PacketNumber& number, const PacketColor&) {
  pixel.depth = number.value;
}
void take(CellCountPixel& pixel, const PacketNumber&, const PacketColor& color) {
  pixel.cells = color.cells;
}

// Of one thread's rays.
template <class Packets>
class FirstOfStream : public PacketFirst {
 public:
  FirstOfStream(const Frame& frame, const VisibleScalars& visible, const Packets& packets,
                std::span<PacketNumber> numbers)
      : frame_(frame), visible_(visible), packets_(packets), numbers_(numbers) {}

  Clear around(float scalar) const override {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Clear clear{-kInfinity, kInfinity};
    for (const VisibleScalars::Range& range : visible_.ranges()) {
      if (range.high < scalar)
        clear.low = range.high;
      else if (range.low > scalar)
        return {clear.low, range.low};
      else
        return {};
    }
    return clear;
  }

  bool contributes(std::uint32_t ray, float z, const Segment& segment) const override {
    FirstPixel first{frame_.optical_depth(), frame_.tolerance()};
    Segment placed = segment;
    placed.t_out = packets_.distance(ray, z);
    placed.t_in = placed.t_out - segment.t_out;
    if (first(placed)) return false;
    numbers_[ray].value = first.depth;
    return true;
  }

 private:
  const Frame& frame_;
  const VisibleScalars& visible_;
  const Packets& packets_;
  const std::span<PacketNumber> numbers_;
};

template <class Walkable, class Pixel>
class ModePacketTiles : public TileMaker {
 public:
  ModePacketTiles(Frame& frame, const Walkable& walkable, const Pixel& fresh)
      : frame_(frame),
        walkable_(walkable),
        fresh_(fresh),
        twin_(frame, walkable, fresh),
        extinction_(PieceTable(frame.scene().transfer_function())),
        visible_(frame.scene().transfer_function()) {}

  void make(TileSource& tiles, Counts& counts) override {
    Stream stream(walkable_.mesh, walkable_.boundary, frame_.gap());
    Pixels pixels(*this, tiles, counts);
    walk(stream, pixels);
  }

 private:
  using Stream = PacketStreamOf<Walkable>;
  using Twin = ModeTiles<Walkable, Pixel>;

  class Pixels : public PacketPixels<Twin> {
   public:
    Pixels(ModePacketTiles& tiles, TileSource& source, Counts& counts)
        : PacketPixels<Twin>(tiles.frame_, source, tiles.twin_, counts),
          frame_(tiles.frame_),
          fresh_(tiles.fresh_) {}

    void begin(std::uint32_t ray) override { numbers[ray] = before_; }
    void put(const PixelPlace& place, const PacketColor& color, const TraceResult& trace,
             std::uint32_t ray) override {
      this->count(trace);
      Pixel pixel = fresh_;
      take(pixel, numbers[ray], color);
      frame_.put_raw(place, pixel.value(), pixel.seen());
    }
    void miss(const PixelPlace& place) override {
      frame_.put_raw(place, fresh_.value(), fresh_.seen());
    }

    std::vector<PacketNumber> numbers = std::vector<PacketNumber>(Stream::kMostRays);

   private:
    Frame& frame_;
    const Pixel& fresh_;
    const PacketNumber before_ = PacketNumber::before(frame_.settings().mode);
  };

  void walk(Stream& stream, Pixels& pixels) const {
    const Mode mode = frame_.settings().mode;
    const FirstOfStream first(frame_, visible_, stream, std::span(pixels.numbers));
    ModePackets packets;
    packets.mode = mode;
    packets.extinction = &extinction_;
    packets.first = &first;
    packets.numbers = pixels.numbers;
    if (!is_linear(frame_.scene(), frame_.settings())) packets.order = frame_.settings().order;
    packets.tolerance =
        std::max(static_cast<float>(frame_.tolerance()), std::numeric_limits<float>::min());
    [[maybe_unused]] const bool curved =
        packets.order != ScalarOrder::linear && mode != Mode::cell_count;
    auto by_packets = [&](std::span<PacketColor> colors, int axis, PacketFeeder& feeder) {
      packets.colors = colors;
      if constexpr (std::is_same_v<typename Walkable::Walker, RectilinearWalker>) {
        reduce_packets(walkable_.mesh, packets, feeder);
      } else {
        if constexpr (kCurvedPackets<Walkable>)
          if (curved) return reduce_curved_packets(walkable_.mesh, packets, axis, feeder);
        reduce_packets(walkable_.mesh, packets, axis, feeder);
      }
    };
    stream.walk_by(by_packets, pixels);
  }

  Frame& frame_;
  const Walkable& walkable_;
  const Pixel fresh_;
  Twin twin_;
  const ExtinctionTable extinction_;
  const VisibleScalars visible_;
};

}  // namespace

bool has_mode_packets(const Frame& frame) {
  const RenderSettings& settings = frame.settings();
  const auto* tets =
      std::get_if<std::unique_ptr<Walkable<TetWalker>>>(&frame.scene().body().walkable);
  if (tets != nullptr && (*tets)->mesh.is_compact()) return false;
  // Cells are the same at any order.
  return settings.mode != Mode::volume &&
         (settings.mode == Mode::cell_count || has_packets_of_order(frame.scene(), settings)) &&
         has_packets(frame.scene()) && !is_classified(frame.scene(), settings) &&
         settings.clip_planes.empty() && !settings.scalar_twin && settings.channels.empty();
}

double mode_packet_error(const Scene& scene, const RenderSettings& settings) {
  const Mode mode = settings.mode;
  const bool of_one_place = mode == Mode::maximum || mode == Mode::minimum || mode == Mode::depth;
  const double of_numbers = of_one_place && !is_linear(scene, settings) ? 2.5e-5 : 1e-5;
  if (mode == Mode::cell_count) return 0;
  if (in_words(mode).shade != ShadeBy::transfer_function) return of_numbers;
  const auto& knots = scene.transfer_function().knots;
  const double range = static_cast<double>(scene.field().high) - scene.field().low;
  double steepest = 0;
  for (std::size_t k = 1; k < knots.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const double change = std::abs(knots[k].optics.color[c] - knots[k - 1].optics.color[c]);
      const double width = static_cast<double>(knots[k].scalar) - knots[k - 1].scalar;
      if (change > 0) steepest = std::max(steepest, change / width);  // infinite at a step
    }
  return steepest * range * of_numbers;
}

std::unique_ptr<TileMaker> mode_packet_tiles(Frame& frame) {
  return with_mode_pixel(frame, [&](const auto& walkable, const auto& fresh) {
    return std::make_unique<
        ModePacketTiles<std::decay_t<decltype(walkable)>, std::decay_t<decltype(fresh)>>>(
        frame, walkable, fresh);
  });
}

}  // namespace plume
