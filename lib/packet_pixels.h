/// The pixels of a tile by packets, those that packets decline by their twin.
#pragma once

#include <array>
#include <cstddef>

#include "plume/lib/frame.h"
#include "plume/lib/packet_tile.h"
#include "plume/lib/rectilinear_tile.h"

namespace plume {

template <class Walkable>
using PacketTileOf = PacketTile<typename Walkable::Walker>;
static_assert(kTile * kTile <= PacketTile<TetWalker>::kMostRays);

/// Adds the tile's rays to `packets`, calls walk() for all of them together, then
/// put(const PixelPlace&, const PacketResult&, std::size_t) for each pixel that packets have made,
/// with its ray's PacketStart::ray, or miss(const PixelPlace&) where that does not meet the mesh.
/// `twin` makes the other pixels.
template <class Packets, class Twin, class Walk, class Put, class Miss>
void make_by_packets(const Frame& frame, const Tile& tile, Packets& packets, Twin& twin,
                     Counts& counts, const Walk& walk, const Put& put, const Miss& miss) {
  packets.clear();
  // Packets walk whole passages: rays that end inside are walked one by one.
  std::array<PixelPlace, RayLanes::kRays> pixels;
  std::size_t size = 0;
  RayLanes rays;
  auto add = [&] {
    frame.rays({pixels.data(), size}, rays);
    packets.add(rays);
    size = 0;
  };
  frame.for_each_pixel(tile, [&](const PixelPlace& pixel) {
    // A copy to refer to, so that others stay in registers: written to memory in parts and read
    // whole at once in the next line, they would have to wait (2% of a frame).
    if (!frame.sees_endlessly(pixel)) return twin.make_pixel(PixelPlace(pixel), counts);
    pixels[size++] = pixel;
    if (size == pixels.size()) add();
  });
  if (size > 0) add();
  walk();
  std::size_t ray = 0;
  frame.for_each_pixel(tile, [&](const PixelPlace& pixel) {
    if (!frame.sees_endlessly(pixel)) return;
    const std::size_t number = ray++;
    ++counts.in_packets;
    if (!packets.meets(number)) return miss(pixel);
    const PacketResult result = packets.result(number);
    if (result.declined) {
      --counts.in_packets;
      twin.make_pixel(pixel, counts);
      return;
    }
    counts.add(result.trace);
    put(pixel, result, packets.index(number));
  });
}

}  // namespace plume
