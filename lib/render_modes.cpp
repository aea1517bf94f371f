#include "plume/lib/render_modes.h"

#include <algorithm>
#include <cassert>

namespace plume {

const std::vector<ModeInWords>& modes_in_words() {
  static const std::vector<ModeInWords> kModes{
      {Mode::volume, "volume", nullptr, ShadeBy::optics, "", "emission and absorption"},
      {Mode::maximum, "mip", "maximum", ShadeBy::transfer_function, "",
       "maximum of the scalar: no optics"},
      {Mode::minimum, "minip", "minimum", ShadeBy::transfer_function, "",
       "minimum of the scalar: no optics"},
      {Mode::average, "average", "average", ShadeBy::transfer_function, "",
       "average of the scalar over the ray's length in the mesh: no optics"},
      {Mode::integral, "integral", "integral", ShadeBy::gray_from_zero, "field x length",
       "integral of the scalar: no optics"},
      {Mode::optical_depth, "optical-depth", "optical_depth", ShadeBy::gray_from_zero, "",
       "optical depth alone: no colours, nothing composited"},
      {Mode::depth, "depth", "depth", ShadeBy::gray_near_is_white, "length",
       "first contribution: optical depth alone"},
      {Mode::cell_count, "cells", "cell_count", ShadeBy::gray_from_zero, "cells",
       "cells counted: no scalar, no optics"},
  };
  return kModes;
}

const ModeInWords& in_words(Mode mode) {
  const auto& modes = modes_in_words();
  const auto found = std::find_if(modes.begin(), modes.end(),
                                  [&](const auto& words) { return words.mode == mode; });
  assert(found != modes.end());
  return *found;
}

}  // namespace plume
