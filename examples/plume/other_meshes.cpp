#include "other_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "plume/lib/fitted_map.h"
#include "plume/mesh/error.h"
#include "render_choices.h"

namespace plume::command {
namespace {

// "FILE[:FIELD]"; a colon of a file that is there is the file's.
std::pair<std::string, std::string> split_field(const std::string& text) {
  if (std::filesystem::exists(text)) return {text, ""};
  for (std::size_t colon = text.find(':'); colon != std::string::npos;
       colon = text.find(':', colon + 1))
    if (std::filesystem::exists(text.substr(0, colon)))
      return {text.substr(0, colon), text.substr(colon + 1)};
  // A pattern, or a file that is not there.
  const std::size_t slash = text.rfind('/');
  const std::size_t colon = text.find(':', slash == std::string::npos ? 0 : slash);
  return {text.substr(0, colon), colon == std::string::npos ? "" : text.substr(colon + 1)};
}

template <class Work>
void of_file(const std::string& file, Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    const std::string words = error.what();
    throw Error(words.starts_with(file + ": ") ? words : file + ": " + words);
  }
}

}  // namespace

OtherMeshes::OtherMeshes(const RenderArguments& args, const Console& console,
                         const SceneOptions& options, const TimeSeries& main, bool several_steps)
    : args_(args), console_(console) {
  for (const std::string& text : args.others) {
    const auto [file, field] = split_field(text);
    SceneOptions own = options;
    own.name = file;
    own.field = {field, {}};
    TimeSeries series(file, {}, [&](const std::string& line) { console.say(line); });
    if (series.size() != 1 && series.size() != main.size())
      throw Error(fmt::format(
          "--with '{}': {} time steps beside the {} of {}; give a mesh of one step or of as many",
          text, series.size(), main.size(), args.mesh));
    SeriesScene scene(args, console, own, several_steps && series.size() > 1);
    others_.push_back(std::make_unique<Other>(
        Other{file, own.field, std::move(series), std::move(scene), {}, false, false, {}}));
  }
}

void OtherMeshes::read(std::size_t step) {
  for (const auto& other : others_) {
    if (other->shown && other->series.size() == 1) continue;
    of_file(other->file, [&] {
      other->mesh = other->series
                        .read(other->series.size() == 1 ? 0 : step,
                              [&](const std::string& line) { console_.say(line); })
                        .mesh;
    });
    other->read = true;
  }
}

void OtherMeshes::prepare(SeriesScene& main, const Mesh& mesh, const FieldRequest& request) {
  const ScalarField field = select_field(mesh, request);
  field_ = field.name;
  sample_ = sample_for_map(field.values);
  Bounds bounds = bounds_of_mesh(mesh);
  for (const auto& other : others_)
    of_file(other->file, [&] {
      if (other->request.name.empty()) other->request.name = field_;
      const ScalarField own = select_field(other->mesh, other->request);
      other->sample = sample_for_map(own.values);
      other->scene.set_field(other->request);
      bounds = united(bounds, bounds_of_mesh(other->mesh));
    });
  main.set_frame_bounds(bounds);
  for (const auto& other : others_) other->scene.set_frame_bounds(bounds);
}

void OtherMeshes::show() {
  for (const auto& other : others_) {
    if (!std::exchange(other->read, false)) continue;
    of_file(other->file, [&] { other->scene.show(std::exchange(other->mesh, {}), other->series); });
    other->shown = true;
  }
}

void OtherMeshes::choose_looks(SeriesScene& main) {
  std::vector<float> values = std::move(sample_);
  std::vector<SeriesScene*> alike{&main};
  for (const auto& other : others_) {
    if (other->scene.scene().field().name != field_) {
      other->scene.choose_colors();
      continue;
    }
    values.insert(values.end(), other->sample.begin(), other->sample.end());
    alike.push_back(&other->scene);
    other->sample = {};
  }
  // Of those that are going to change, all that is known of what they will be.
  std::optional<std::array<double, 2>> range;
  if (std::any_of(alike.begin(), alike.end(), [](auto* scene) { return scene->color_range(); })) {
    for (const SeriesScene* scene : alike) {
      const auto own = scene->color_range().value_or(
          std::array<double, 2>{scene->values()[0], scene->values()[1]});
      range =
          range ? std::array{std::min((*range)[0], own[0]), std::max((*range)[1], own[1])} : own;
    }
  }
  FittedLook fitted{fitted_color_map(values, range), 0};
  for (const SeriesScene* scene : alike)
    fitted.unit_distance = std::max(fitted.unit_distance, scene->scene().default_unit_distance());
  for (SeriesScene* scene : alike) scene->choose_look(fitted);
}

bool OtherMeshes::is_of_one(const std::string& message) const {
  return std::any_of(others_.begin(), others_.end(),
                     [&](const auto& other) { return message.starts_with(other->file + ": "); });
}

std::vector<const Scene*> OtherMeshes::scenes_with(const Scene& main) const {
  std::vector<const Scene*> scenes{&main};
  for (const auto& other : others_) scenes.push_back(&other->scene.scene());
  return scenes;
}

}  // namespace plume::command
