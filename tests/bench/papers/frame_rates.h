/// Frames a second of the thesis' data sets, in all that its tables 6.3 to 6.10 show.
#pragma once

#include <array>
#include <optional>

#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/thesis_meshes.h"

namespace plume::bench {

/// Frames a second, the mean of four views, each the median of a picture's rounds. Arrays: on one
/// thread, by its time on the processor, and on two, by the clock.
struct FrameRates {
  std::array<double, 2> initial{};     ///< first hits alone
  std::array<double, 2> isosurface{};  ///< one colour
  std::array<double, 2> lit{};         ///< by interpolated gradients
  std::array<double, 2> maximum{};     ///< maximum-intensity projection
  std::array<double, 2> volume{};      ///< seven knots, closed form
  double isosurface_scalar = 0;        ///< ray by ray, walked; one thread
  double volume_scalar = 0;            ///< likewise
};

/// The thesis' pictures are 512 and 1024 pixels wide and high.
inline constexpr std::array<int, 2> kThesisSizes{512, 1024};

/// Of pictures of the thesis' sizes, or, where `quick`, of a 32nd of these. Measures all of it, or
/// says what was measured before: tables share it. Nothing where the data set is absent.
std::optional<std::array<FrameRates, 2>> frame_rates(const ThesisMesh& source,
                                                     const PaperOptions& options);

}  // namespace plume::bench
