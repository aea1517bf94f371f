/// How far apart two pictures of a mode are.
#pragma once

#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// How far apart the numbers are that a picture shows as black and as white; 0 where it shows no
/// shades of gray.
double shade_width(const RenderStatistics& statistics);

/// Of each pixel, the greatest difference of a channel: of linear RGBA where `width` is 0; else of
/// the number in shares of `width` (see shade_width()), and of alpha. What is no number in one of
/// the pictures alone differs by 1. Requires the same sizes.
std::vector<double> differences(const Image& picture, const Image& reference, Mode mode,
                                double width);

/// The greatest of these; 0 of no pixels.
double greatest_difference(const Image& picture, const Image& reference, Mode mode, double width);

}  // namespace plume
