#include <algorithm>
#include <type_traits>
#include <variant>

#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"
#include "plume/preint/compositing.h"
#include "plume/preint/interval_table.h"

namespace plume {
namespace {

// Composites what the table gives for the linear parts of segments.
struct TablePixel {
  const IntervalTable& table;
  double early_termination, tolerance, gap;
  IntervalTable::State state{};
  double end = -std::numeric_limits<double>::infinity();
  Compositor compositor{};

  bool operator()(const Segment& segment) {
    if (segment.t_in - end > gap) state = {};
    end = segment.t_out;
    return for_each_linear_part(segment, tolerance, [this](const Segment& part) {
      compositor.add(table.add(state, part.s_in, part.s_out, segment_length(part)));
      return !compositor.opaque(early_termination);
    });
  }
};

IntervalTable make_table(const Frame& frame) {
  const ScalarField& field = frame.scene().field();
  const float diagonal = static_cast<float>(frame.scene().bounds().diagonal());
  float low = static_cast<float>(field.low), high = static_cast<float>(field.high);
  if (!(low < high)) high = std::nextafter(low, std::numeric_limits<float>::infinity());
  return {frame.scene().classification(),
          {low, high},
          {1e-5f * diagonal, diagonal},
          frame.settings().interval_table};
}

template <class Walkable>
class TableTiles : public TileMaker {
 public:
  TableTiles(Frame& frame, const Walkable& walkable)
      : frame_(frame), walkable_(walkable), table_(make_table(frame)) {}

  void make(TileSource& tiles, Counts& counts) override {
    frame_.for_each_pixel(tiles, [&](const PixelPlace& place) {
      TablePixel pixel{table_, frame_.settings().early_termination, frame_.tolerance(),
                       frame_.gap()};
      counts.add(follow_ray(frame_, walkable_, place, pixel));
      float* rgba = frame_.rgba(place);
      for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
      rgba[3] = static_cast<float>(pixel.compositor.alpha());
    });
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const IntervalTable table_;
};

}  // namespace

std::unique_ptr<TileMaker> table_tiles(Frame& frame) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        return std::make_unique<TableTiles<std::decay_t<decltype(*walkable)>>>(frame, *walkable);
      },
      frame.scene().body().walkable);
}

}  // namespace plume
