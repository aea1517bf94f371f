#include "series_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "opaque_options.h"
#include "plume/mesh/rectilinear_axes.h"
#include "plume/mesh/same_mesh.h"
#include "render_choices.h"

namespace plume::command {
namespace {

// The values that a field will run through, and does in the first step; nothing where that is not
// known without reading all steps.
std::optional<std::array<double, 2>> range_of_all(const ScalarField& first,
                                                  const TimeSeries& series, const Mesh& mesh) {
  // Headers speak of whole fields: of numbers, or of the magnitudes of vectors.
  constexpr std::string_view kMagnitude = ":magnitude";
  std::string name = first.name;
  const auto is_field = [&](const Field& field) {
    return field.name == name && field.association == first.association;
  };
  if (std::none_of(mesh.fields.begin(), mesh.fields.end(), is_field)) {
    if (!name.ends_with(kMagnitude)) return std::nullopt;
    name.resize(name.size() - kMagnitude.size());
  }
  auto range = series.range(name, first.association);
  if (!range) return std::nullopt;
  range = {std::min((*range)[0], static_cast<double>(first.low)),
           std::max((*range)[1], static_cast<double>(first.high))};
  return (*range)[0] < (*range)[1] ? range : std::nullopt;
}

}  // namespace

Bounds bounds_of_mesh(const Mesh& mesh) {
  return mesh.is_rectilinear() ? check_axes(mesh) : bounds_of(mesh.points);
}

void SeriesScene::show_first(const Mesh& mesh, const TimeSeries& series) {
  const bool fitted = args_.transfer_range.empty() && !is_color_map_file(args_.transfer_function);
  if (several_) {
    options_.keep_field_order = true;
    if (fitted) {
      options_.color_range = range_of_all(select_field(mesh, options_.field), series, mesh);
      fitted_to_ = options_.color_range ? "the range of all steps" : "the first step shown";
    }
  }
  scene_.emplace(mesh, options_);
  const ScalarField& field = scene_->field();
  options_.field.name = field.name;
  options_.field.association = scene_->cell_data_averaged() ? Association::cell : field.association;
  values_ = {field.low, field.high};
  if (has_surfaces_)
    for (const std::string& text : args_.surfaces)
      surfaces_.push_back(
          read_opaque_surface(text, [this](const std::string& line) { console_.say(line); }));
  add_surfaces(mesh);
}

void SeriesScene::choose_look(const FittedLook& fitted) {
  choose_transfer_function(*scene_, fitted, args_, console_);
  choose_classification(*scene_, args_, console_);
}

void SeriesScene::choose_colors() {
  const double unit =
      args_.unit_distance > 0 ? args_.unit_distance : scene_->default_unit_distance();
  scene_->set_transfer_function(
      to_transfer_function(scene_->default_color_map(), unit, args_.opacity_scale));
}

void SeriesScene::add_surfaces(const Mesh& mesh) {
  if (!has_surfaces_) return;
  for (const OpaqueSurface& surface : surfaces_) scene_->add_surface(surface);
  for (const std::string& text : args_.walls) scene_->add_surface(parse_wall(text, mesh));
}

void SeriesScene::show(Mesh mesh, const TimeSeries& series) {
  if (!scene_) {
    show_first(mesh, series);
  } else if (same_points_and_cells(mesh, shown_)) {
    scene_->set_field(mesh, options_.field);
    mesh_stayed_ = true;
  } else {
    TransferFunction transfer_function = scene_->transfer_function();
    Classification classification = scene_->classification();
    scene_.reset();  // before another takes its memory
    if (options_.frame_bounds)
      options_.frame_bounds = united(*options_.frame_bounds, bounds_of_mesh(mesh));
    scene_.emplace(mesh, options_);
    scene_->set_transfer_function(std::move(transfer_function));
    scene_->set_classification(std::move(classification));
    add_surfaces(mesh);
    mesh_stayed_ = false;
  }
  values_ = {std::min(values_[0], scene_->field().low), std::max(values_[1], scene_->field().high)};
  if (!several_) return;  // the scene needs the mesh no more
  mesh.fields.clear();
  shown_ = std::move(mesh);
}

}  // namespace plume::command
