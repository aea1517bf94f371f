/// Rays through classifications, for the tests of preint.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "plume/preint/classified_optics.h"
#include "plume/preint/closed_form.h"
#include "plume/preint/compositing.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume::tests {

struct Piece {
  float s_in, s_out;
  double length = 1;
};

/// Pieces of length one that join.
inline std::vector<Piece> polyline(const std::vector<float>& scalars) {
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < scalars.size(); ++i) pieces.push_back({scalars[i - 1], scalars[i]});
  return pieces;
}

inline std::vector<Piece> reversed(std::vector<Piece> pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (Piece& piece : pieces) std::swap(piece.s_in, piece.s_out);
  return pieces;
}

inline std::vector<ClassifiedPart> parts_of(const Classification& classification,
                                            const std::vector<Piece>& pieces) {
  const ScalarRanges ranges(classification);
  IntervalState state(ranges);
  std::vector<ClassifiedPart> parts;
  for (const Piece& piece : pieces)
    state.add(piece.s_in, piece.s_out, [&](const ClassifiedPart& part) {
      parts.push_back(part);
      return true;
    });
  return parts;
}

inline int crossings(const Classification& classification, const std::vector<float>& scalars) {
  const auto parts = parts_of(classification, polyline(scalars));
  return static_cast<int>(std::count_if(parts.begin(), parts.end(), [](const auto& part) {
    return part.kind == ClassifiedPart::Kind::surface;
  }));
}

inline Compositor composite(const Classification& classification, const std::vector<Piece>& pieces,
                            IntervalForm form = IntervalForm::exponential) {
  const ClassifiedOptics optics(classification, form);
  const ClosedForm volume(classification.volume.value_or(TransferFunction{{{0, {}}}}));
  IntervalState state(optics.ranges());
  Compositor compositor;
  for (const Piece& piece : pieces)
    state.add(piece.s_in, piece.s_out, [&](const ClassifiedPart& part) {
      compositor.add(optics.color(part, piece.length, volume));
      return true;
    });
  return compositor;
}

inline double distance(const Compositor& a, const Compositor& b) {
  return std::max({std::abs(a.rgb[0] - b.rgb[0]), std::abs(a.rgb[1] - b.rgb[1]),
                   std::abs(a.rgb[2] - b.rgb[2]), std::abs(a.transmittance - b.transmittance)});
}

/// A profile over [0, 1] with an integral of at most `largest`, steps included.
inline TransferFunction random_profile(std::mt19937_64& random, float largest) {
  return random_function(random(), std::uniform_int_distribution<int>(1, 12)(random), largest);
}

/// Up to four intervals in [0, 1], some of which touch, up to four isosurfaces between and inside
/// of them, and mostly a volume.
inline Classification random_classification(std::mt19937_64& random, float largest_profile = 4) {
  std::uniform_real_distribution<float> unit(0, 1);
  Classification result;
  if (unit(random) < 0.8f) result.volume = random_function(random(), 12, 5);
  std::vector<float> ends(std::uniform_int_distribution<std::size_t>(2, 7)(random));
  for (float& end : ends) end = unit(random);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (unit(random) < 0.6f && ends[i] > ends[i - 1])
      result.intervals.push_back({ends[i - 1], ends[i], random_profile(random, largest_profile)});
  std::shuffle(result.intervals.begin(), result.intervals.end(), random);
  const int surfaces = std::uniform_int_distribution<int>(0, 4)(random);
  for (int i = 0; i < surfaces; ++i)
    result.isosurfaces.push_back(
        {unit(random), 0.7f * unit(random), {unit(random), unit(random), unit(random)}});
  return result;
}

/// A scalar that turns back and forth: pieces that join, within [-0.2, 1.2].
inline std::vector<Piece> random_ray(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<float> scalar(-0.2f, 1.2f), step(-0.15f, 0.15f), unit(0, 1);
  std::vector<Piece> pieces;
  float s = scalar(random);
  for (int i = 0; i < count; ++i) {
    const float next =
        unit(random) < 0.5f ? scalar(random) : std::clamp(s + step(random), -0.2f, 1.2f);
    pieces.push_back({s, next, random_length(random, 1e-3f, 1)});
    s = next;
  }
  return pieces;
}

}  // namespace plume::tests
