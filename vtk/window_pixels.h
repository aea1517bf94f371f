/// What a renderer has drawn, and how a picture comes on top of it.
#pragma once

#include <vector>

#include "plume/lib/image.h"
#include "plume/vtk/view_of.h"

class vtkRenderer;

namespace plume {

/// A renderer's part of its window, in pixels from the window's lower left corner.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Of this tile, where the window is shown in tiles.
Viewport viewport_of(vtkRenderer& renderer);

/// The distances, along the pixels' rays and in data coordinates, at which what the renderer has
/// drawn so far hides what is behind: as RenderSettings::depth_limit has them, read from the
/// z-buffer. Empty where nothing is drawn. A z-buffer of 24 bits resolves 2^-24 of the range
/// between the clipping planes, evenly in a parallel projection, less and less towards the far
/// plane in a perspective one; where a pixel has several samples, one of them counts.
std::vector<float> depth_limits(vtkRenderer& renderer, const View& view, const Viewport& viewport);

/// Blends a premultiplied picture of the viewport's size over what is there, pixel onto pixel.
/// Throws Error where the window is not drawn by OpenGL.
void blend_over(vtkRenderer& renderer, const Image& image);

}  // namespace plume
