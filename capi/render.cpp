#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "plume/capi/handles.h"
#include "plume/lib/render_modes.h"

using namespace plume::capi;

namespace {

constexpr std::pair<plume_mode, plume::Mode> kModes[] = {
    {PLUME_VOLUME, plume::Mode::volume},
    {PLUME_MAXIMUM, plume::Mode::maximum},
    {PLUME_INTEGRAL, plume::Mode::integral},
    {PLUME_DEPTH, plume::Mode::depth},
    {PLUME_MINIMUM, plume::Mode::minimum},
    {PLUME_AVERAGE, plume::Mode::average},
    {PLUME_OPTICAL_DEPTH, plume::Mode::optical_depth},
    {PLUME_CELL_COUNT, plume::Mode::cell_count}};

template <class Change>
plume_status change(plume_settings* settings, const char* function, const Change& body) {
  return guarded([&] {
    require(settings, fmt::format("{}: settings", function).c_str());
    body();
    return PLUME_OK;
  });
}

plume::Camera camera_of(const plume_camera& given) {
  plume::Camera camera;
  std::copy_n(given.position, 3, camera.position.begin());
  std::copy_n(given.focal_point, 3, camera.focal_point.begin());
  std::copy_n(given.view_up, 3, camera.view_up.begin());
  camera.view_angle = given.view_angle;
  camera.parallel_scale = given.parallel_scale;
  camera.parallel = given.parallel != 0;
  return camera;
}

}  // namespace

plume_status plume_camera_view(const plume_scene* scene, const char* view, double aspect_ratio,
                               plume_camera* camera) {
  return guarded([&] {
    require(scene, "plume_camera_view: scene");
    require(view, "plume_camera_view: view");
    require(camera, "plume_camera_view: camera");
    const plume::Camera fitted = plume::named_view(view, scene->scene.bounds(), aspect_ratio);
    std::copy_n(fitted.position.begin(), 3, camera->position);
    std::copy_n(fitted.focal_point.begin(), 3, camera->focal_point);
    std::copy_n(fitted.view_up.begin(), 3, camera->view_up);
    camera->view_angle = fitted.view_angle;
    camera->parallel_scale = fitted.parallel_scale;
    camera->parallel = fitted.parallel ? 1 : 0;
    return PLUME_OK;
  });
}

plume_status plume_settings_create(plume_settings** settings) {
  return guarded([&] {
    require(settings, "plume_settings_create: settings");
    *settings = new plume_settings{};
    return PLUME_OK;
  });
}

void plume_settings_free(plume_settings* settings) { delete settings; }

plume_status plume_settings_set_mode(plume_settings* settings, plume_mode mode) {
  return change(settings, __func__, [&] {
    for (const auto& [number, ours] : kModes)
      if (mode == number) {
        settings->settings.mode = ours;
        return;
      }
    throw plume::Error(fmt::format("no mode has the number {}", static_cast<int>(mode)));
  });
}

plume_status plume_settings_set_order(plume_settings* settings, int order) {
  return change(settings, __func__, [&] {
    if (order < 1 || order > 3) throw plume::Error(fmt::format("order {}: 1, 2 or 3", order));
    settings->settings.order = static_cast<plume::ScalarOrder>(order);
  });
}

plume_status plume_settings_set_threads(plume_settings* settings, int threads) {
  return change(settings, __func__, [&] { settings->settings.threads = threads; });
}

plume_status plume_settings_set_early_termination(plume_settings* settings, double transmittance) {
  return change(settings, __func__, [&] { settings->settings.early_termination = transmittance; });
}

plume_status plume_settings_set_tolerance(plume_settings* settings, double max_error) {
  return change(settings, __func__,
                [&] { settings->settings.tolerance.emplace().max_error = max_error; });
}

plume_status plume_settings_set_headlight(plume_settings* settings, int on) {
  return change(settings, __func__, [&] {
    settings->settings.lighting.reset();
    if (on != 0) settings->settings.lighting.emplace();
  });
}

plume_status plume_settings_add_clip_plane(plume_settings* settings, const double point[3],
                                           const double normal[3]) {
  return change(settings, __func__, [&] {
    require(point, "plume_settings_add_clip_plane: point");
    require(normal, "plume_settings_add_clip_plane: normal");
    settings->settings.clip_planes.push_back(
        {{point[0], point[1], point[2]}, {normal[0], normal[1], normal[2]}});
  });
}

plume_status plume_settings_add_channel(plume_settings* settings, const char* name, float* values) {
  return change(settings, __func__, [&] {
    require(name, "plume_settings_add_channel: name");
    require(values, "plume_settings_add_channel: values");
    settings->channels.push_back({name, values});
  });
}

plume_status plume_settings_set_progress(plume_settings* settings,
                                         int (*progress)(void* user, double share), void* user) {
  return change(settings, __func__, [&] {
    settings->progress = nullptr;
    if (progress != nullptr)
      settings->progress = [progress, user](double share) { return progress(user, share) != 0; };
  });
}

plume_status plume_render(const plume_scene* scene, const plume_camera* camera,
                          const plume_settings* settings, int width, int height, float* rgba) {
  return guarded([&] {
    require(scene, "plume_render: scene");
    require(camera, "plume_render: camera");
    require(rgba, "plume_render: rgba");
    plume_settings effective;
    if (settings != nullptr) effective = *settings;
    effective.settings.width = width;
    effective.settings.height = height;
    // What a mode makes by itself need not be asked for.
    const char* const of_mode = plume::in_words(effective.settings.mode).channel;
    for (const auto& channel : effective.channels)
      if (of_mode == nullptr || channel.name != of_mode)
        effective.settings.channels.push_back(channel.name);
    const plume::RenderResult result =
        plume::render(scene->scene, camera_of(*camera), effective.settings, effective.progress);
    for (const auto& [name, values] : effective.channels) {
      const plume::Channel* channel = result.image.channel(name);
      if (channel == nullptr)
        throw plume::Error(
            fmt::format("channel '{}' has several parts: ask for one of them", name));
      std::copy(channel->values.begin(), channel->values.end(), values);
    }
    std::copy(result.image.rgba.begin(), result.image.rgba.end(), rgba);
    return result.cancelled ? failed(PLUME_CANCELLED, "cancelled by the progress function")
                            : PLUME_OK;
  });
}
