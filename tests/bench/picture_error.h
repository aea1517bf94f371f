/// How far one picture is from another: lib/picture_error.h, by the name that benchmarks know.
#pragma once

#include "plume/lib/picture_error.h"

namespace plume::bench {

using plume::picture_error;
using plume::PictureError;

}  // namespace plume::bench
