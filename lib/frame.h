/// The picture that is being made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/camera.h"
#include "plume/lib/empty_space.h"
#include "plume/lib/opaque_pixels.h"
#include "plume/lib/render.h"
#include "plume/preint/optical_depth.h"
#include "plume/traverse/frame_lanes.h"

namespace plume {

inline constexpr int kTile = 32;  ///< pixels along a tile's edge

/// A tile by its first pixel.
struct Tile {
  int x = 0, y = 0;
};

/// Tiles one after the other, each of a picture given to one source only.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// To be asked when the last one is made, or all but made.
  virtual std::optional<Tile> next() = 0;
};

/// A pixel of the image, and where it is in its arrays.
struct PixelPlace {
  int x, y;
  std::size_t index;
};

/// What rays came to, for the statistics.
struct Counts {
  std::uint64_t hit = 0, entries = 0, cells = 0, lost = 0, surfaces = 0, visits = 0;
  std::uint64_t in_packets = 0, searched = 0, overlapping = 0;

  void add(const TraceResult& trace) {
    hit += trace.entries > 0 ? 1 : 0;
    entries += trace.entries;
    cells += trace.cells;
    lost += trace.end == WalkEnd::lost ? 1 : 0;
  }
};

/// Places of the image's further channels; nothing where one is not asked for.
struct ChannelPlaces {
  std::optional<std::size_t> depth, optical_depth, cell_id, cell_count, isovalue;
  std::vector<std::size_t> normal;  ///< x, y and z, or none

  /// Channels that every segment must be looked at for.
  bool any_of_segments() const { return depth || cell_id || whole_rays(); }
  /// Channels that need rays to go on to their end.
  bool whole_rays() const { return optical_depth || cell_count; }
};

/// One frame, shared by all tiles, each of which writes pixels of its own. Requires settings that
/// check_settings() lets pass; keeps references to the scene and the settings.
class Frame {
 public:
  Frame(const Scene& scene, const Camera& camera, const RenderSettings& settings)
      : Frame(std::vector{&scene}, camera, settings) {}
  /// Of several scenes, at least one.
  Frame(std::vector<const Scene*> scenes, const Camera& camera, const RenderSettings& settings);

  /// The only one, or the first of several.
  const Scene& scene() const { return *scenes_.front(); }
  const std::vector<const Scene*>& scenes() const { return scenes_; }
  const RenderSettings& settings() const { return settings_; }
  const ChannelPlaces& channels() const { return channels_; }
  /// Of the volume's transfer function: what channels and modes of optical depth ask.
  const OpticalDepth& optical_depth() const { return optical_depth_; }
  /// Of the linear parts of segments above order 1, in the field's unit.
  double tolerance() const { return tolerance_; }
  /// Segments farther apart than this, in world units, are in different passages as far as
  /// intervals and isosurfaces are concerned. Places on the faces of blocks that touch differ by
  /// rounding, which is some 1e-7 of the mesh.
  double gap() const { return gap_; }
  Image& image() { return image_; }
  std::size_t pixel_count() const {
    return static_cast<std::size_t>(window_.width) * static_cast<std::size_t>(window_.height);
  }
  int tiles_across() const { return (window_.width + kTile - 1) / kTile; }
  int tiles_down() const { return (window_.height + kTile - 1) / kTile; }

  /// The ray through the middle of a pixel, as far as it sees.
  Ray ray(const PixelPlace& pixel) const {
    Ray ray = rays_(window_.x + pixel.x + 0.5, window_.y + pixel.y + 0.5);
    if (opaque_.any()) ray.t_max = opaque_.limits[pixel.index];
    return ray;
  }
  /// Whether all of a tile is in the picture, and nothing opaque in sight.
  bool is_clear(const Tile& tile) const {
    return tile.x + kTile <= window_.width && tile.y + kTile <= window_.height && !opaque_.any();
  }
  /// Sixteen pixels of such a tile, from the `first`-th, and their rays.
  void rays(const Tile& tile, std::size_t first, std::span<PixelPlace, RayLanes::kRays> pixels,
            RayLanes& rays) const {
    std::array<double, RayLanes::kRays> x, y;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const PixelPlace place = place_of(tile, first + i);
      x[i] = window_.x + place.x + 0.5;
      y[i] = window_.y + place.y + 0.5;
      pixels[i] = place;
    }
    rays_.set(rays, x, y, pixels.size());
  }
  /// Those of up to sixteen pixels that see endlessly, to the bit.
  void rays(std::span<const PixelPlace> pixels, RayLanes& rays) const {
    std::array<double, RayLanes::kRays> x{}, y{};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      x[i] = window_.x + pixels[i].x + 0.5;
      y[i] = window_.y + pixels[i].y + 0.5;
    }
    rays_.set(rays, x, y, pixels.size());
  }
  /// Whether nothing opaque ends the pixel's ray.
  bool sees_endlessly(const PixelPlace& pixel) const {
    return !opaque_.any() || opaque_.limits[pixel.index] == std::numeric_limits<double>::infinity();
  }
  /// Where the pixel is in arrays of the whole picture, of which the image may be a window.
  std::size_t index_in_picture(const PixelPlace& pixel) const {
    return static_cast<std::size_t>(window_.y + pixel.y) *
               static_cast<std::size_t>(settings_.width) +
           static_cast<std::size_t>(window_.x + pixel.x);
  }
  /// Ends rays at what is opaque.
  void set_opaque(OpaquePixels opaque) { opaque_ = std::move(opaque); }
  /// Lets rays pass over it, where there is one.
  void set_empty_space(std::optional<EmptySpace> space) { empty_space_ = std::move(space); }
  const std::optional<EmptySpace>& empty_space() const { return empty_space_; }
  /// Puts the surfaces behind what rays saw in front of them, once all pixels are made.
  void put_surfaces();
  float* rgba(const PixelPlace& pixel) { return &image_.rgba[4 * pixel.index]; }
  void put(const std::optional<std::size_t>& channel, const PixelPlace& pixel, double value) {
    if (channel) image_.channels[*channel].values[pixel.index] = static_cast<float>(value);
  }
  /// The pixel's value in a mode that shows one number a ray, and whether there is one.
  void put_raw(const PixelPlace& pixel, double value, bool seen) {
    put(raw_, pixel, value);
    rgba(pixel)[3] = seen ? 1.0f : 0.0f;
  }
  /// Colours the numbers of such a mode, once all pixels have one; says what they, and the shades
  /// of gray, run from and to.
  void shade_raw(RenderStatistics& statistics);

  /// A tile's pixels along a Z-curve, 0 to kTile * kTile - 1: neighbours in the list, which share
  /// packets, are neighbours in the picture and meet the same cells. Nothing beyond the picture.
  std::optional<PixelPlace> pixel(const Tile& tile, std::size_t number) const {
    const PixelPlace place = place_of(tile, number);
    if (place.x >= window_.width || place.y >= window_.height) return std::nullopt;
    return place;
  }
  /// Calls visit(PixelPlace) for each of them.
  template <class Visit>
  void for_each_pixel(const Tile& tile, Visit&& visit) const {
    for (std::size_t number = 0; number < kTileOrder.size(); ++number)
      if (const auto place = pixel(tile, number)) visit(*place);
  }
  /// And of each tile.
  template <class Visit>
  void for_each_pixel(TileSource& tiles, Visit&& visit) const {
    while (const auto tile = tiles.next()) for_each_pixel(*tile, visit);
  }

 private:
  struct TilePixel {
    int x, y;
  };
  static const std::array<TilePixel, kTile * kTile> kTileOrder;

  PixelPlace place_of(const Tile& tile, std::size_t number) const {
    const int x = tile.x + kTileOrder[number].x, y = tile.y + kTileOrder[number].y;
    return {x, y,
            static_cast<std::size_t>(y) * static_cast<std::size_t>(window_.width) +
                static_cast<std::size_t>(x)};
  }

  std::size_t channel_place(const std::string& name);
  std::optional<std::size_t> wanted(const std::string& name);

  const std::vector<const Scene*> scenes_;
  const RenderSettings& settings_;
  const PixelWindow window_;  // all of the picture, where none was asked for
  PixelRays rays_;
  OpticalDepth optical_depth_;
  double tolerance_, gap_;
  Image image_;
  OpaquePixels opaque_;
  std::optional<EmptySpace> empty_space_;
  ChannelPlaces channels_;
  std::optional<std::size_t> raw_;
};

}  // namespace plume
