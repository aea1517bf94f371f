/// The pixels of a tile by packets, those that packets decline by their twin.
#pragma once

#include <cstddef>

#include "plume/lib/frame.h"
#include "plume/lib/packet_tile.h"
#include "plume/lib/rectilinear_tile.h"

namespace plume {

template <class Walkable>
using PacketTileOf = PacketTile<typename Walkable::Walker>;

/// Adds the tile's rays to `packets`, calls walk() for all of them together, then
/// put(const PixelPlace&, const PacketResult&, std::size_t) for each pixel that packets have made,
/// with its ray's number. `twin` makes the others.
template <class Packets, class Twin, class Walk, class Put>
void make_by_packets(const Frame& frame, const Tile& tile, Packets& packets, Twin& twin,
                     Counts& counts, const Walk& walk, const Put& put) {
  packets.clear();
  // Packets walk whole passages: rays that end inside are walked one by one.
  frame.for_each_pixel(tile, [&](const PixelPlace& pixel) {
    if (frame.sees_endlessly(pixel))
      packets.add(frame.ray(pixel));
    else
      twin.make_pixel(pixel, counts);
  });
  walk();
  std::size_t ray = 0;
  frame.for_each_pixel(tile, [&](const PixelPlace& pixel) {
    if (!frame.sees_endlessly(pixel)) return;
    const PacketResult result = packets.result(ray++);
    if (result.declined) {
      twin.make_pixel(pixel, counts);
      return;
    }
    counts.add(result.trace);
    ++counts.in_packets;
    put(pixel, result, ray - 1);
  });
}

}  // namespace plume
