#include "plume/vtk/window_pixels.h"

#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#if __has_include(<vtk_glew.h>)
#include <vtk_glew.h>
#else  // from VTK 9.4 on
#include <vtk_glad.h>
#endif

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include "plume/mesh/error.h"

namespace plume {

Viewport viewport_of(vtkRenderer& renderer) {
  Viewport viewport;
  renderer.GetTiledSizeAndOrigin(&viewport.width, &viewport.height, &viewport.x, &viewport.y);
  return viewport;
}

std::vector<float> depth_limits(vtkRenderer& renderer, const View& view, const Viewport& viewport) {
  if (renderer.GetNumberOfPropsRendered() == 0 && renderer.GetPreserveDepthBuffer() == 0) return {};
  const auto width = static_cast<std::size_t>(viewport.width);
  const auto height = static_cast<std::size_t>(viewport.height);
  std::vector<float> depths(width * height, 1.0f);
  renderer.GetRenderWindow()->GetZbufferData(viewport.x, viewport.y,
                                             viewport.x + viewport.width - 1,
                                             viewport.y + viewport.height - 1, depths.data());
  if (std::all_of(depths.begin(), depths.end(), [](float depth) { return !(depth < 1); }))
    return {};

  const PixelRays rays(view.camera, viewport.width, viewport.height);
  const Ray middle = [&] {
    Camera straight = view.camera;
    straight.window_center = {0, 0};
    return PixelRays(straight, 2, 2)(1, 1);
  }();
  std::vector<float> limits(depths.size(), std::numeric_limits<float>::infinity());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const float depth = depths[(height - 1 - y) * width + x];  // OpenGL's first row is the lowest
      if (!(depth < 1)) continue;
      double along = 0;  // the line of sight, for each unit along the ray
      const Ray ray = rays(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      for (std::size_t c = 0; c < 3; ++c) along += ray.direction[c] * middle.direction[c];
      limits[y * width + x] = static_cast<float>(std::max(0.0, view.in_front(depth) / along));
    }
  return limits;
}

void blend_over(vtkRenderer& renderer, const Image& image) {
  auto* const window = vtkOpenGLRenderWindow::SafeDownCast(renderer.GetRenderWindow());
  if (window == nullptr)
    throw Error(
        "the render window is not one of OpenGL's (link VTK::RenderingOpenGL2, or take "
        "vtkPlumeImageFilter, which needs no window)");
  vtkOpenGLState* const state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depth_test(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blend_function(state);
  const vtkOpenGLState::ScopedglDepthMask depth_mask(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);  // rays have ended where they are hidden
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  // VTK's helper for ray casters' pictures puts the middles of its outermost pixels onto the edges
  // of the viewport, and interpolates: everything would be moved by up to half a pixel.
  vtkNew<vtkTextureObject> texture;
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  if (!texture->Create2DFromRaw(static_cast<unsigned>(image.width),
                                static_cast<unsigned>(image.height), 4, VTK_FLOAT,
                                const_cast<float*>(image.rgba.data())))
    throw Error("no texture of " + std::to_string(image.width) + " x " +
                std::to_string(image.height) + " pixels could be made; take a smaller window");
  // Our first row is the top.
  float places_in_image[] = {0, 1, 1, 1, 1, 0, 0, 0};
  float places_in_viewport[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  texture->CopyToFrameBuffer(places_in_image, places_in_viewport, nullptr, nullptr);
  texture->ReleaseGraphicsResources(window);
}

}  // namespace plume
