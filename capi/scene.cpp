#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "plume/capi/handles.h"

using namespace plume::capi;

namespace {

plume::FieldRequest request_of(const char* field) { return {field ? field : "", {}}; }

}  // namespace

plume_status plume_scene_create(const plume_mesh* mesh, const char* field, unsigned flags,
                                plume_scene** scene) {
  return guarded([&] {
    require(mesh, "plume_scene_create: mesh");
    require(scene, "plume_scene_create: scene");
    constexpr unsigned kAll = PLUME_KEEP_FIELD_ORDER | PLUME_KEEP_GRADIENTS | PLUME_AVERAGE_CELLS;
    if ((flags & ~kAll) != 0)
      throw plume::Error(
          fmt::format("scene flags {}: {} is unknown; see plume_scene_flag", flags, flags & ~kAll));
    plume::SceneOptions options;
    options.field = request_of(field);
    options.keep_field_order = (flags & PLUME_KEEP_FIELD_ORDER) != 0;
    options.keep_gradients = (flags & PLUME_KEEP_GRADIENTS) != 0;
    if ((flags & PLUME_AVERAGE_CELLS) != 0) options.cell_data = plume::CellData::averaged;
    *scene = new plume_scene{plume::Scene(mesh->mesh, options)};
    return PLUME_OK;
  });
}

void plume_scene_free(plume_scene* scene) { delete scene; }

plume_status plume_scene_set_field(plume_scene* scene, const plume_mesh* mesh, const char* field) {
  return guarded([&] {
    require(scene, "plume_scene_set_field: scene");
    require(mesh, "plume_scene_set_field: mesh");
    scene->scene.set_field(mesh->mesh, request_of(field));
    return PLUME_OK;
  });
}

plume_status plume_scene_bounds(const plume_scene* scene, double bounds[6]) {
  return guarded([&] {
    require(scene, "plume_scene_bounds: scene");
    require(bounds, "plume_scene_bounds: bounds");
    for (std::size_t a = 0; a < 3; ++a) {
      bounds[2 * a] = scene->scene.bounds().low[a];
      bounds[2 * a + 1] = scene->scene.bounds().high[a];
    }
    return PLUME_OK;
  });
}

plume_status plume_scene_range(const plume_scene* scene, float range[2]) {
  return guarded([&] {
    require(scene, "plume_scene_range: scene");
    require(range, "plume_scene_range: range");
    range[0] = scene->scene.field().low;
    range[1] = scene->scene.field().high;
    return PLUME_OK;
  });
}

plume_status plume_scene_set_color_map(plume_scene* scene, const char* name, double low,
                                       double high, double unit_distance, double opacity_scale) {
  return guarded([&] {
    require(scene, "plume_scene_set_color_map: scene");
    plume::ColorMap map = scene->scene.default_color_map();
    if (name != nullptr) {
      const auto preset = plume::preset(name);
      if (!preset)
        throw plume::Error(fmt::format("no colour map '{}'; there are: {}", name,
                                       fmt::join(plume::preset_names(), " ")));
      if (!(low < high))
        throw plume::Error(
            fmt::format("colour map '{}' from {} to {}: they must ascend", name, low, high));
      map = plume::rescaled(*preset, low, high);
    }
    if (unit_distance == 0) unit_distance = scene->scene.default_unit_distance();
    if (!(unit_distance > 0) || !(opacity_scale >= 0))
      throw plume::Error(
          fmt::format("a unit distance of {} and an opacity scale of {}: neither may be negative",
                      unit_distance, opacity_scale));
    scene->scene.set_transfer_function(
        plume::to_transfer_function(map, unit_distance, opacity_scale));
    return PLUME_OK;
  });
}

plume_status plume_scene_set_transfer_function(plume_scene* scene, size_t count,
                                               const float* knots) {
  return guarded([&] {
    require(scene, "plume_scene_set_transfer_function: scene");
    require(knots, "plume_scene_set_transfer_function: knots");
    plume::TransferFunction function;
    for (std::size_t i = 0; i < count; ++i) {
      const float* k = knots + 5 * i;
      function.knots.push_back({k[0], {k[1], {k[2], k[3], k[4]}}});
    }
    scene->scene.set_transfer_function(std::move(function));
    return PLUME_OK;
  });
}

plume_status plume_scene_set_isosurfaces(plume_scene* scene, size_t count, const float* isosurfaces,
                                         int show_volume) {
  return guarded([&] {
    require(scene, "plume_scene_set_isosurfaces: scene");
    if (count > 0) require(isosurfaces, "plume_scene_set_isosurfaces: isosurfaces");
    plume::Classification classification;
    for (std::size_t i = 0; i < count; ++i) {
      const float* s = isosurfaces + 5 * i;
      classification.isosurfaces.push_back({s[0], s[1], {s[2], s[3], s[4]}});
    }
    if (show_volume != 0) classification.volume = scene->scene.transfer_function();
    scene->scene.set_classification(std::move(classification));
    return PLUME_OK;
  });
}

plume_status plume_trace(const plume_scene* scene, const double origin[3],
                         const double direction[3], plume_visit visit, void* user) {
  return guarded([&] {
    require(scene, "plume_trace: scene");
    require(origin, "plume_trace: origin");
    require(direction, "plume_trace: direction");
    require(reinterpret_cast<const void*>(visit), "plume_trace: visit");
    plume::Ray ray;
    std::copy_n(origin, 3, ray.origin.begin());
    std::copy_n(direction, 3, ray.direction.begin());
    scene->scene.trace(ray, [&](const plume::Segment& segment) {
      const plume_segment seen{segment.t_in, segment.t_out, segment.s_in, segment.s_out};
      return visit(user, &seen) != 0;
    });
    return PLUME_OK;
  });
}
