/// The meshes that --with puts beside the one that is shown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console.h"
#include "plume/io/time_series.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"
#include "series_scene.h"

namespace plume::command {

/// Each shows a field of its own. Those that show the same field as the first mesh look as it does:
/// colours and opacity are fitted to the values of all of them, and isosurfaces and intervals are
/// in all. A field of another name has colours fitted to itself.
class OtherMeshes {
 public:
  /// Opens the files. `main`: the series of the first mesh; one of as many steps goes with it, and
  /// a mesh without steps stays. Throws Error, naming the option, for other numbers of steps.
  OtherMeshes(const RenderArguments& args, const Console& console, const SceneOptions& options,
              const TimeSeries& main, bool several_steps);

  bool empty() const { return others_.empty(); }

  /// Reads the meshes that go with a step. Throws Error, naming the file.
  void read(std::size_t step);
  /// Before the first step is shown: tells all scenes, the main one too, the bounds of all meshes,
  /// and remembers what the look is to be fitted to.
  void prepare(SeriesScene& main, const Mesh& mesh, const FieldRequest& request);
  /// Shows what was read. Throws Error, naming the file, where it has no such field.
  void show();
  /// After the first step is shown: how all scenes look.
  void choose_looks(SeriesScene& main);

  /// Whether a message speaks of one of the files.
  bool is_of_one(const std::string& message) const;

  /// All scenes of the picture, the main one first.
  std::vector<const Scene*> scenes_with(const Scene& main) const;

 private:
  struct Other {
    std::string file;
    FieldRequest request;
    TimeSeries series;
    SeriesScene scene;
    Mesh mesh;  // read and not yet shown
    bool read = false, shown = false;
    std::vector<float> sample;
  };

  const RenderArguments& args_;
  const Console& console_;
  std::string field_;  // of the main mesh
  std::vector<float> sample_;
  std::vector<std::unique_ptr<Other>> others_;
};

}  // namespace plume::command
