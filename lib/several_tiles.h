/// Pictures of several volumes, ray by ray.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "plume/lib/several_volumes.h"
#include "plume/lib/tiles.h"

namespace plume {

/// Where two meshes are at once.
struct FoundOverlap {
  PixelPlace pixel;
  std::size_t first, second;  ///< of the frame's scenes
  RayRange range;
};

/// All modes of a frame with several scenes. What each of them meets of a ray is collected, and
/// what RenderSettings::overlap says is done where two are in one place; then all modes see the
/// same.
class SeveralTiles : public TileMaker {
 public:
  explicit SeveralTiles(Frame& frame);

  void make(TileSource& tiles, Counts& counts) override;

  /// Of the first pixel in which meshes overlap that are not to; nothing where none do.
  const std::optional<FoundOverlap>& overlap() const { return overlap_; }

 private:
  struct Rays;

  void follow_all(const PixelPlace& place, Rays& rays, Counts& counts);
  void settle_overlaps(const PixelPlace& place, Rays& rays, Counts& counts);
  void note(const FoundOverlap& found);
  void make_mixed(const PixelPlace& place, Rays& rays, Counts& counts);
  void make_number(const PixelPlace& place, const Rays& rays);

  Frame& frame_;
  const std::vector<VolumeOfSeveral> volumes_;
  const bool hits_;   // isosurfaces or intervals are to be seen
  const bool mixed_;  // by a MixedRay, else one number a ray
  std::mutex guard_;
  std::optional<FoundOverlap> overlap_;
};

}  // namespace plume
