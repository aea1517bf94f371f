#include "plume/tests/bench/peer_frames.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "plume/io/image_file.h"
#include "plume/lib/plume.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/bench/vtk_frames.h"

namespace plume::bench {
namespace {

// Who makes a picture, how long each took, and what it looks like.
struct Maker {
  std::string name;
  std::function<void()> frame;
  std::function<Image()> picture;
  std::vector<double> wall, cpu;
};

// What all views add up to, in seconds.
struct Sum {
  double wall = 0, cpu = 0;
};

class Comparison {
 public:
  Comparison(const Mesh& mesh, const PeerFrameOptions& options) : options_(options), scene_(mesh) {
    scene_.set_transfer_function(seven_knots(scene_));
    vtk_ = std::make_unique<VtkFrames>(mesh, scene_.field().name, scene_.transfer_function());
    settings_.width = settings_.height = options.size;
    settings_.threads = 1;
    settings_.early_termination = 0;
  }

  bool run() {
    fmt::print(
        "\nThe blunt fin as {} tetrahedra, {} x {} pixels, one thread; medians of {} frames "
        "in turns.\nErrors of linear, premultiplied RGBA against Plume's scalar twin; VTK's "
        "before rounding to 8 bits.\n\n",
        scene_.cell_count(), options_.size, options_.size, options_.rounds);
    fmt::print("{:<14}{:<30}{:>9}{:>9}{:>9}{:>11}{:>11}{:>7}\n", "view", "picture by", "ms, cpu",
               "ms, wall", "x Plume", "largest", "RMS", "NaN");
    for (const NamedCamera& view : frame_cameras(scene_.bounds())) compare(view);
    const Sum& plume = sums_[kPlume];
    fmt::print("\nAll views:\n");
    for (const auto& [name, sum] : sums_)
      fmt::print("{:<14}{:<30}{:>9.1f}{:>9.1f}{:>9.2f}\n", "", name, 1e3 * sum.cpu, 1e3 * sum.wall,
                 sum.cpu / plume.cpu);
    return good_;
  }

 private:
  static constexpr const char* kPlume = "Plume";
  static constexpr double kSameThing = 0.01;  // RMS; the coarsest integrator's is 2e-3

  void compare(const NamedCamera& view) {
    vtk_->look(view.camera, options_.size);
    RenderSettings twin = settings_;
    twin.scalar_twin = true;
    auto by_plume = [&](const RenderSettings& settings) {
      return render(scene_, view.camera, settings).image;
    };
    std::vector<Maker> makers;
    makers.push_back(
        {kPlume, [&] { by_plume(settings_); }, [&] { return by_plume(settings_); }, {}, {}});
    makers.push_back(
        {"Plume, scalar twin", [&] { by_plume(twin); }, [&] { return by_plume(twin); }, {}, {}});
    for (const std::string& name : VtkFrames::integrators())
      makers.push_back({"VTK, " + name,
                        [this, &name] { vtk_->render(name); },
                        [this] { return vtk_->picture(); },
                        {},
                        {}});
    std::map<std::string, Image> pictures;
    for (Maker& maker : makers) {  // also builds what is kept from frame to frame
      maker.frame();
      pictures[maker.name] = maker.picture();
      const Image& picture = pictures[maker.name];
      if (maker.name.rfind("VTK", 0) == 0 && vtk_->pixels_unlike(picture) > 0) {
        std::fprintf(stderr, "plume_frame_bench: %s: %zu pixels are not what VTK showed\n",
                     maker.name.c_str(), vtk_->pixels_unlike(picture));
        good_ = false;
      }
      if (!options_.pictures.empty())
        write_image(picture, std::filesystem::path(options_.pictures) /
                                 fmt::format("{} {}.png", view.name, maker.name));
    }
    for (int round = 0; round < options_.rounds; ++round)
      for (Maker& maker : makers) {
        const double wall = wall_seconds(), cpu = thread_seconds();
        maker.frame();
        maker.cpu.push_back(thread_seconds() - cpu);
        maker.wall.push_back(wall_seconds() - wall);
      }
    const double plume = median(makers.front().cpu);
    const Image& reference = pictures["Plume, scalar twin"];
    std::size_t nearly_opaque = 0;
    for (std::size_t i = 3; i < reference.rgba.size(); i += 4)
      if (reference.rgba[i] >= 0.99f) ++nearly_opaque;
    for (const Maker& maker : makers) {
      const double cpu = median(maker.cpu), wall = median(maker.wall);
      sums_[maker.name].cpu += cpu;
      sums_[maker.name].wall += wall;
      const PictureError error = picture_error(pictures[maker.name], reference);
      if (!(error.rms < kSameThing)) {
        std::fprintf(stderr, "plume_frame_bench: %s is not a picture of the same thing\n",
                     maker.name.c_str());
        good_ = false;
      }
      fmt::print("{:<14}{:<30}{:>9.1f}{:>9.1f}{:>9.2f}{:>11.1e}{:>11.1e}{:>7}\n",
                 &maker == &makers.front() ? view.name : "", maker.name, 1e3 * cpu, 1e3 * wall,
                 cpu / plume, error.largest, error.rms, error.not_numbers);
    }
    fmt::print("{:<14}({} pixels have an opacity of 0.99, where VTK stops and Plume goes on)\n", "",
               nearly_opaque);
    std::fflush(stdout);
  }

  const PeerFrameOptions& options_;
  Scene scene_;
  std::unique_ptr<VtkFrames> vtk_;
  RenderSettings settings_;
  std::map<std::string, Sum> sums_;
  bool good_ = true;
};

}  // namespace

bool compare_peer_frames(const PeerFrameOptions& options) {
  const std::optional<Mesh> mesh = mesh_sources().front().load();
  return !mesh || Comparison(*mesh, options).run();
}

}  // namespace plume::bench
