/// What the modes show, in words and by which shades.
#pragma once

#include <cstdint>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// How a mode's numbers become colours.
enum class ShadeBy : std::uint8_t {
  optics,              ///< it has no numbers: emission and absorption
  transfer_function,   ///< the transfer function's colour for the number
  gray_from_zero,      ///< from 0, or the least where that is below, to the picture's greatest
  gray_near_is_white,  ///< from the picture's greatest to its least
};

struct ModeInWords {
  Mode mode;
  /// As users write it: on the command line and in messages.
  const char* name;
  /// The channel with its numbers; null where there are none.
  const char* channel;
  ShadeBy shade;
  /// Of the numbers, for messages; empty where it is the field's.
  const char* unit;
  /// For the plan.
  const char* cost;
};

/// All modes, in the order in which help lists them.
const std::vector<ModeInWords>& modes_in_words();
const ModeInWords& in_words(Mode mode);

}  // namespace plume
