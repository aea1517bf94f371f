/// The transfer functions that the tests of preint share: each is hard in its own way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume::tests {

struct NamedTransferFunction {
  std::string name;
  TransferFunction function;
};

/// Eight knots on [0, 1] without jumps; extinction up to 6.
inline TransferFunction smooth_function() {
  return {{{0.0f, {0.0f, {0.1f, 0.2f, 0.9f}}},
           {0.1f, {0.5f, {0.1f, 0.4f, 0.8f}}},
           {0.25f, {1.5f, {0.2f, 0.8f, 0.6f}}},
           {0.4f, {3.0f, {0.5f, 0.9f, 0.4f}}},
           {0.55f, {2.0f, {0.8f, 0.8f, 0.2f}}},
           {0.7f, {4.0f, {0.9f, 0.6f, 0.1f}}},
           {0.85f, {6.0f, {1.0f, 0.3f, 0.0f}}},
           {1.0f, {1.0f, {0.6f, 0.0f, 0.0f}}}}};
}

/// Jumps of extinction and colour at 0.25, 0.5 (to nothing) and 0.75.
inline TransferFunction step_function() {
  return {{{0.0f, {0.2f, {0.0f, 0.0f, 1.0f}}},
           {0.25f, {0.4f, {0.0f, 0.5f, 1.0f}}},
           {0.25f, {5.0f, {1.0f, 0.0f, 0.0f}}},
           {0.5f, {3.0f, {1.0f, 1.0f, 0.0f}}},
           {0.5f, {0.0f, {1.0f, 1.0f, 0.0f}}},
           {0.75f, {0.0f, {0.0f, 1.0f, 0.0f}}},
           {0.75f, {20.0f, {0.3f, 0.3f, 0.3f}}},
           {1.0f, {1.0f, {0.9f, 0.9f, 0.9f}}}}};
}

/// A peak of extinction 1e6 that is 2e-4 wide, in a thin haze.
inline TransferFunction spike_function() {
  return {{{0.4999f, {0.01f, {0.2f, 0.2f, 1.0f}}},
           {0.5f, {1e6f, {1.0f, 0.8f, 0.1f}}},
           {0.5001f, {0.01f, {0.1f, 1.0f, 0.2f}}}}};
}

/// Random extinctions in [0, largest], a quarter of them 0, and some steps.
inline TransferFunction random_function(std::uint64_t seed, int knot_count, float largest) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> scalars;
  for (int i = 0; i < knot_count; ++i) {
    const bool makes_step = i % 8 == 7;
    scalars.push_back(makes_step ? scalars.back() : unit(random));
  }
  std::sort(scalars.begin(), scalars.end());
  TransferFunction function;
  for (const float scalar : scalars) {
    Optics optics;
    optics.extinction = unit(random) < 0.25f ? 0 : largest * unit(random);
    optics.color = {unit(random), unit(random), unit(random)};
    function.knots.push_back({scalar, optics});
  }
  return function;
}

/// The smooth one with another extinction.
inline TransferFunction scaled_smooth_function(float factor) {
  TransferFunction function = smooth_function();
  for (auto& knot : function.knots) knot.optics.extinction *= factor;
  return function;
}

inline TransferFunction single_knot_function() { return {{{0.5f, {2.0f, {0.3f, 0.6f, 0.9f}}}}}; }

inline std::vector<NamedTransferFunction> all_functions() {
  return {{"smooth", smooth_function()},
          {"steps", step_function()},
          {"narrow spike", spike_function()},
          {"64 random knots", random_function(11, 64, 10)},
          {"nearly opaque", scaled_smooth_function(1e4f)},
          {"nearly transparent", scaled_smooth_function(1e-6f)},
          {"single knot", single_knot_function()}};
}

/// Ends of a segment: anywhere in [-0.2, 1.2], at a knot, or just beside one; both ends alike at
/// times.
inline std::pair<float, float> random_ends(std::mt19937_64& random,
                                           const TransferFunction& function) {
  std::uniform_real_distribution<float> anywhere(-0.2f, 1.2f);
  std::uniform_int_distribution<std::size_t> any_knot(0, function.knots.size() - 1);
  std::uniform_int_distribution<int> choice(0, 9);
  const auto end = [&] {
    const int chosen = choice(random);
    if (chosen == 0) return function.knots[any_knot(random)].scalar;
    if (chosen == 1) return std::nextafter(function.knots[any_knot(random)].scalar, 2.0f);
    if (chosen == 2) return function.knots[any_knot(random)].scalar + 1e-4f;
    return anywhere(random);
  };
  const float s_in = end();
  const int chosen = choice(random);
  if (chosen == 0) return {s_in, s_in};
  if (chosen == 1) return {s_in, std::nextafter(s_in, -2.0f)};
  return {s_in, end()};
}

/// Logarithmically even in [low, high].
inline float random_length(std::mt19937_64& random, float low, float high) {
  return std::exp(std::uniform_real_distribution<float>(std::log(low), std::log(high))(random));
}

}  // namespace plume::tests
