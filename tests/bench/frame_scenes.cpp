#include "plume/tests/bench/frame_scenes.h"

namespace plume::bench {

TransferFunction seven_knots(const Scene& scene) {
  const float low = static_cast<float>(scene.default_color_map().colors.front().x);
  const float high = static_cast<float>(scene.default_color_map().colors.back().x);
  const float per_length = static_cast<float>(1.5 / scene.bounds().diagonal());
  const plume::Optics optics[] = {{0, {0, 0, 1}},      {1, {0, 0.5f, 1}},    {0.2f, {0, 1, 0.3f}},
                                  {2, {0.6f, 1, 0}},   {0.5f, {1, 0.7f, 0}}, {4, {1, 0.2f, 0}},
                                  {3, {0.8f, 0, 0.4f}}};
  TransferFunction made;
  for (std::size_t i = 0; i < 7; ++i) {
    made.knots.push_back({low + (high - low) * static_cast<float>(i) / 6, optics[i]});
    made.knots.back().optics.extinction *= per_length;
  }
  return made;
}

std::vector<NamedCamera> frame_cameras(const Bounds& bounds) {
  std::vector<NamedCamera> made;
  for (const char* name : {"+x", "+y", "+z", "iso"}) {
    made.push_back({name, named_view(name, bounds)});
    orbit(made.back().camera, 3, 2);
  }
  made.push_back({"iso, parallel", made.back().camera});
  made.back().camera.parallel = true;
  return made;
}

}  // namespace plume::bench
