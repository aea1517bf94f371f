// Plume beside other renderers, on one mesh, one transfer function and the same rays: plume_peers.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "plume/examples/plume/render_choices.h"
#include "plume/io/read_mesh.h"
#include "plume/io/whole_file.h"
#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/peer_table.h"

namespace {

using namespace plume;
using namespace plume::bench;

struct Arguments {
  command::RenderArguments render;
  int size = 512;
  PeerTimings timings;
  bool quick = false, cut = false, seven_knots = false;
  std::vector<std::string> only;
};

const std::vector<std::string> kFamilies{"ray-cast", "z-sweep", "projected", "locator",
                                         "embree",   "voxels",  "openvkl",   "viskores"};

void add_options(CLI::App& app, Arguments& args) {
  command::RenderArguments& render = args.render;
  render.threads = 1;
  render.output = "peers.csv";
  app.add_option("mesh", render.mesh, "what plume render reads")->required();
  app.add_option("-o,--output", render.output, "the table as CSV")->capture_default_str();
  app.add_option("--solution", render.solution, "Plot3D: the q file");
  app.add_option("--field", render.field, "on points");
  app.add_option("--size", args.size, "pixels along each side")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  app.add_option("--view", render.view, "as plume render's")
      ->check(CLI::IsMember(view_names()))
      ->capture_default_str();
  app.add_option("--azimuth", render.azimuth, "as plume render's")->capture_default_str();
  app.add_option("--elevation", render.elevation, "as plume render's")->capture_default_str();
  app.add_option("--zoom", render.zoom, "as plume render's")->capture_default_str();
  app.add_flag("--parallel", render.parallel, "without perspective");
  app.add_option("--tf", render.transfer_function, "as plume render's");
  app.add_option("--tf-range", render.transfer_range, "as plume render's");
  app.add_option("--unit-distance", render.unit_distance, "as plume render's");
  app.add_option("--opacity-scale", render.opacity_scale, "as plume render's")
      ->capture_default_str();
  app.add_flag(
      "--seven-knots", args.seven_knots,
      "a transfer function of seven knots, as one draws it by hand; VTK looks knots up one "
      "by one, so that the hundreds of a colour map slow it down");
  app.add_flag("--cut-into-tetrahedra", args.cut,
               "of a curvilinear grid: compare on its tetrahedra");
  app.add_option("--threads", render.threads, "Z sweep has one")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--rounds", args.timings.rounds, "frames of each; medians are reported")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--limit", args.timings.limit, "seconds for each way, of which one frame is made")
      ->capture_default_str();
  app.add_option("--pictures", args.timings.pictures, "a directory for them, as PNG files")
      ->check(CLI::ExistingDirectory);
  app.add_flag("--quick", args.quick, "fewer steps");
  app.add_option("--only", args.only, "some peers")
      ->check(CLI::IsMember(kFamilies))
      ->delimiter(',');
}

// Our own ways: first what the others are compared with.
std::vector<PeerWay> plume_ways(const Scene& scene, const PeerScene& peers,
                                const RenderSettings& settings) {
  std::vector<PeerWay> ways;
  const auto add = [&](const std::string& method, const RenderSettings& with) {
    const auto picture = std::make_shared<Image>();
    ways.push_back(
        {"plume", method,
         [&scene, &peers, with, picture] { *picture = render(scene, peers.camera, with).image; },
         [picture] { return *picture; }});
  };
  add(peers.cut ? "closed form order 1" : "closed form", settings);
  if (!peers.cut) return ways;
  for (const auto& [name, order] : {std::pair{"closed form order 2", ScalarOrder::quadratic},
                                    std::pair{"closed form order 3", ScalarOrder::cubic}}) {
    RenderSettings with = settings;
    with.order = order;
    add(name, with);
  }
  return ways;
}

int run(const Arguments& args) {
  const command::Console console(false);
  check_writable(args.render.output);
  const auto wanted = [&](const char* name) {
    return args.only.empty() ||
           std::find(args.only.begin(), args.only.end(), name) != args.only.end();
  };
  ReadOptions options;
  options.solution = args.render.solution;
  Mesh mesh = read_mesh(args.render.mesh, options);
  if (args.cut) {
    if (!mesh.is_grid() || mesh.is_rectilinear())
      throw Error("--cut-into-tetrahedra: the mesh is no curvilinear grid");
    mesh = cut_into_tetrahedra(mesh);
  }
  check_structure(mesh);
  PeerScene peers = make_peer_scene(mesh, args.render.field);
  SceneOptions scene_options;
  scene_options.field = {args.render.field, Association::point};
  Scene scene(mesh, scene_options);
  if (args.seven_knots)
    scene.set_transfer_function(seven_knots(scene));
  else
    command::choose_transfer_function(scene, command::look_fitted_to(scene), args.render, console);
  peers.transfer_function = scene.transfer_function();
  peers.camera = command::choose_camera(scene.bounds(), args.render, 1);
  peers.size = args.size;
  peers.threads = args.render.threads;

  RenderSettings settings;
  settings.width = settings.height = args.size;
  settings.threads = args.render.threads;
  settings.early_termination = 0;
  const Image reference = render(scene, peers.camera, reference_settings(settings)).image;

  std::vector<PeerWay> ways = plume_ways(scene, peers, settings);
  const auto add = [&](const char* name, const std::function<std::vector<PeerWay>()>& make) {
    if (!wanted(name)) return;
    for (PeerWay& way : make()) ways.push_back(std::move(way));
  };
  add("ray-cast", [&] { return vtk_ray_cast_ways(peers); });
  add("z-sweep", [&] { return vtk_z_sweep_ways(peers, args.quick); });
#ifdef PLUME_WITH_VTK_OPENGL
  limit_rasterizer_threads(peers.threads);
  add("projected", [&] { return vtk_projected_tetrahedra_ways(peers); });
#endif
  add("locator", [&] { return vtk_locator_ways(peers, args.quick); });
  add("embree", [&] { return embree_ways(peers, args.quick); });
  add("voxels", [&] { return voxel_ways(peers, args.quick); });
#ifdef PLUME_WITH_OPENVKL
  add("openvkl", [&] { return openvkl_ways(peers, args.quick); });
#endif
#ifdef PLUME_WITH_VISKORES
  add("viskores", [&] { return viskores_ways(peers, args.quick); });
#endif
  PeerTimings timings = args.timings;
  timings.say = [&](const std::string& line) { console.say(line); };
  timings.one_thread = args.render.threads == 1;
  const std::vector<PeerRow> rows = compare_peers(ways, reference, timings);
  write_whole_file(args.render.output, peer_csv(rows));

  fmt::print(
      "{}: {} cells, {} x {} pixels, {} knots, {}; medians of frames in turns, at most {}, or {:g} "
      "seconds;\nerrors of linear, premultiplied RGBA against Plume's reference. A cell's size is "
      "{:.3g} of the mesh's diagonal.\n\n{}",
      args.render.mesh, scene.cell_count(), args.size, args.size,
      peers.transfer_function.knots.size(),
      timings.one_thread ? "one thread, time on the processor"
                         : fmt::format("{} threads, time of the clock", args.render.threads),
      timings.rounds, timings.limit, peers.cell_size / peers.bounds.diagonal(), peer_table(rows));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("plume_peers: Plume beside other renderers, on the same rays");
  Arguments args;
  add_options(app, args);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  try {
    return run(args);
  } catch (const Error& error) {
    std::fprintf(stderr, "plume_peers: %s\n", error.what());
    return 1;
  }
}
