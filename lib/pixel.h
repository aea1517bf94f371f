/// What a ray's segments add up to in each mode: the consumers of segments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plume/preint/compositing.h"
#include "plume/preint/transfer_function.h"
#include "plume/traverse/segment.h"

namespace plume {

inline float segment_length(const Segment& segment) {
  return static_cast<float>(segment.t_out - segment.t_in);
}

/// Emission and absorption.
template <class Integrator>
struct VolumePixel {
  const Integrator& integrator;
  float early_termination;
  Compositor compositor{};

  bool operator()(const Segment& segment) {
    compositor.add(integrator.integrate(segment.s_in, segment.s_out, segment_length(segment)));
    return !compositor.opaque(early_termination);
  }
};

/// The greatest scalar. NaN is passed over; -infinity where there is none.
struct MaximumPixel {
  float maximum = -std::numeric_limits<float>::infinity();

  bool operator()(const Segment& segment) {
    maximum = std::fmax(maximum, std::fmax(segment.s_in, segment.s_out));
    return true;
  }
};

/// The integral of the scalar, exact where it is linear along a segment. NaN counts as nothing.
struct IntegralPixel {
  double integral = 0;

  bool operator()(const Segment& segment) {
    const double mean = 0.5 * (static_cast<double>(segment.s_in) + segment.s_out);
    if (!std::isnan(mean)) integral += mean * (segment.t_out - segment.t_in);
    return true;
  }
};

/// The first segment that is not transparent.
template <class Integrator>
struct FirstPixel {
  const Integrator& integrator;
  double depth = std::numeric_limits<double>::infinity();
  std::uint32_t cell = 0xFFFFFFFFu;

  bool operator()(const Segment& segment) {
    if (!(integrator.optical_depth(segment.s_in, segment.s_out, segment_length(segment)) > 0))
      return true;
    depth = segment.t_in;
    cell = segment.cell;
    return false;
  }
};

/// What the further channels hold, gathered besides the picture.
template <class Integrator>
struct ChannelPixel {
  FirstPixel<Integrator> first;
  double optical_depth = 0;
  std::uint64_t cells = 0;

  void operator()(const Segment& segment) {
    if (!(first.depth < std::numeric_limits<double>::infinity())) first(segment);
    optical_depth +=
        first.integrator.optical_depth(segment.s_in, segment.s_out, segment_length(segment));
    ++cells;
  }
};

}  // namespace plume
