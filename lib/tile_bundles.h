/// The rays of a tile in bundles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plume/lib/frame.h"
#include "plume/traverse/cluster_cache.h"
#include "plume/traverse/frame_lanes.h"
#include "plume/traverse/leaf_cache.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/searched_ray.h"

namespace plume {

/// What each thread that searches a hierarchy has of its own; used again from tile to tile. `Cache`
/// is LeafCache or a ClusterCache.
template <class Cache>
class TileBundles {
 public:
  template <class Mesh, class Hierarchy>
  TileBundles(const Mesh& mesh, const Hierarchy& hierarchy)
      : leaves(mesh, hierarchy), local_(mesh.frame) {}

  struct TileRay {
    PixelPlace place{};
    Ray ray;
    ShearedFrame frame;
    bool valid = false;  // has a direction
  };

  /// Of a frame in which all rays see endlessly. Calls search() for each bundle of the tile's rays,
  /// found in `bundle`, and then
  /// take(const TileRay&, std::size_t) for each of them, with its number in the bundle; and
  /// miss(const TileRay&) for rays without a direction.
  template <class Search, class Take, class Miss>
  void for_each(const Frame& frame, const Tile& tile, const Search& search, const Take& take,
                const Miss& miss) {
    size_ = 0;
    std::size_t begin = 0;
    auto set = [&] {
      frame.rays({places_.data(), size_ - begin}, lanes_);
      frames_.set(lanes_, local_);
      for (std::size_t i = 0; begin + i < size_; ++i) {
        TileRay& ray = rays_[begin + i];
        ray.place = places_[i];
        ray.ray = lanes_.ray(i);
        ray.valid = frames_.is_valid(i);
        if (ray.valid) frames_.put(i, ray.frame);
      }
      begin = size_;
    };
    frame.for_each_pixel(tile, [&](const PixelPlace& place) {
      if (size_ == rays_.size()) rays_.emplace_back();
      places_[size_++ - begin] = place;
      if (size_ - begin == places_.size()) set();
    });
    set();
    std::size_t first = 0;
    auto finish = [&] {
      if (bundle.size() == 0) return;
      search();
      for (std::size_t i = 0; i < bundle.size(); ++i) take(rays_[first + i], i);
      bundle.clear();
    };
    for (std::size_t i = 0; i < size_; ++i) {
      const TileRay& ray = rays_[i];
      if (!ray.valid || !bundle.takes(ray.frame)) finish();
      if (!ray.valid) {
        miss(ray);
        continue;
      }
      if (bundle.size() == 0) first = i;
      bundle.add(ray.ray, ray.frame);
    }
    finish();
  }

  Cache leaves;
  RayBundle bundle;
  std::array<SearchedRay, RayBundle::kRays> found;
  std::array<float, RayBundle::kRays> values{};

 private:
  const LocalFrame& local_;
  std::array<PixelPlace, RayLanes::kRays> places_{};
  RayLanes lanes_;
  FrameLanes frames_;
  std::vector<TileRay> rays_;  // the first size_: what there is is used again as it is
  std::size_t size_ = 0;
};

}  // namespace plume
