/// Frames a second of the thesis' data sets, in all that its tables 6.3 to 6.10 show.
#pragma once

#include <array>
#include <optional>

#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/thesis_meshes.h"

namespace plume::bench {

/// Frames a second by the clock, the mean of four views, each the median of a picture's rounds.
/// Arrays: on one and on two threads.
struct FrameRates {
  std::array<double, 2> initial{};     ///< first hits alone
  std::array<double, 2> isosurface{};  ///< one colour
  std::array<double, 2> lit{};         ///< by interpolated gradients
  std::array<double, 2> maximum{};     ///< maximum-intensity projection
  std::array<double, 2> volume{};      ///< seven knots, closed form
  double isosurface_scalar = 0;        ///< ray by ray, walked; one thread
  double volume_scalar = 0;            ///< likewise
};

/// Measures all of it, or says what was measured before: tables share it. `size`: pixels along each
/// side. Nothing where the data set is absent.
std::optional<FrameRates> frame_rates(const ThesisMesh& source, int size,
                                      const PaperOptions& options);

}  // namespace plume::bench
