/// What a bundle of rays may look for.
#pragma once

#include <variant>

#include "plume/traverse/extreme_target.h"
#include "plume/traverse/segment_target.h"

namespace plume {

template <class Cells>
using SearchTarget =
    std::variant<SegmentTarget<Cells>*, ExtremeTarget<Cells, true>*, ExtremeTarget<Cells, false>*>;

}  // namespace plume
