/// One scene for all steps of a series.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "plume/io/time_series.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"
#include "render_choices.h"

namespace plume::command {

/// Of any form.
Bounds bounds_of_mesh(const Mesh& mesh);

/// Shows one step's mesh after the other. All show the field that the first does, and are coloured
/// by what was chosen for the first, so that pictures can be compared and a movie does not flicker.
/// Where the points and cells stay, the walkable mesh does.
class SeriesScene {
 public:
  /// `several`: more than one step is going to be shown.
  SeriesScene(const RenderArguments& args, const Console& console, SceneOptions options,
              bool several)
      : args_(args), console_(console), options_(std::move(options)), several_(several) {}

  /// Throws Error where the mesh or its field is wrong. `series` is asked what values there will
  /// be.
  void show(Mesh mesh, const TimeSeries& series);

  /// Before the first is shown: bounds of all meshes of the picture (see SceneOptions).
  void set_frame_bounds(const Bounds& bounds) { options_.frame_bounds = bounds; }
  /// Before the first is shown: another field than the options say.
  void set_field(const FieldRequest& request) { options_.field = request; }
  /// Before the first is shown: with the surfaces and walls of the arguments.
  void show_surfaces() { has_surfaces_ = true; }

  /// After the first is shown: colours, isosurfaces and intervals as the arguments say.
  void choose_look(const FittedLook& fitted);
  /// Or colours alone, fitted to the field: of one that the arguments do not speak of.
  void choose_colors();
  /// What is shown. Requires that something is.
  const Scene& scene() const { return *scene_; }
  /// Whether the last step's mesh was that of the step before.
  bool mesh_stayed() const { return mesh_stayed_; }

  /// The least and greatest value of all steps shown.
  const std::array<float, 2>& values() const { return values_; }
  /// What values there are going to be, where that is known and colours are fitted to it.
  const std::optional<std::array<double, 2>>& color_range() const { return options_.color_range; }
  /// What the transfer function was fitted to, in words; empty where it was given.
  const std::string& fitted_to() const { return fitted_to_; }

 private:
  void show_first(const Mesh& mesh, const TimeSeries& series);
  void add_surfaces(const Mesh& mesh);

  const RenderArguments& args_;
  const Console& console_;
  SceneOptions options_;
  const bool several_;
  std::optional<Scene> scene_;
  Mesh shown_;  // without fields: what the next step's mesh is compared with
  bool mesh_stayed_ = false;
  std::array<float, 2> values_{};
  std::string fitted_to_;
  bool has_surfaces_ = false;
  std::vector<OpaqueSurface> surfaces_;  // of files
};

}  // namespace plume::command
