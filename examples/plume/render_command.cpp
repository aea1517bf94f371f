// plume render: a mesh file becomes a picture.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "console.h"
#include "parse.h"
#include "plume/io/color_map_file.h"
#include "plume/io/image_file.h"
#include "plume/io/read_mesh.h"
#include "plume/io/whole_file.h"
#include "plume/lib/plume.h"
#include "surface_options.h"

namespace plume::command {
namespace {

struct RenderArguments {
  std::string mesh, solution, output = "picture.png", field, association, size = "1024x768";
  std::string view = "iso", camera, transfer_function, transfer_range, mode = "volume";
  std::string integrator = "closed-form", order = "1", cell_data = "constant", background = "white",
              stats;
  std::string interval_form = "exponential";
  std::vector<std::string> channels, isosurfaces, intervals, lights, clip_planes;
  std::string material, clip_box;
  double azimuth = 0, elevation = 0, zoom = 1, opacity_scale = 1, view_angle = 0;
  double unit_distance = 0, early_termination = RenderSettings{}.early_termination;
  int time_step = -1, samples = 1, threads = 0, bits = 8;
  bool no_volume = false, parallel = false, merge_points = false, quiet = false, verbose = false;
};

const std::vector<std::pair<std::string, Mode>> kModes{{"volume", Mode::volume},
                                                       {"mip", Mode::maximum},
                                                       {"integral", Mode::integral},
                                                       {"depth", Mode::depth}};
const std::vector<std::pair<std::string, IntegratorKind>> kIntegrators{
    {"closed-form", IntegratorKind::closed_form},
    {"table", IntegratorKind::table},
    {"table2", IntegratorKind::second_order_table},
    {"midpoint", IntegratorKind::midpoint},
    {"reference", IntegratorKind::reference}};
const std::vector<std::pair<std::string, CellData>> kCellData{{"constant", CellData::constant},
                                                              {"averaged", CellData::averaged}};
const std::vector<std::pair<std::string, IntervalForm>> kIntervalForms{
    {"exponential", IntervalForm::exponential}, {"linear", IntervalForm::linear}};
const std::vector<std::pair<std::string, ScalarOrder>> kOrders{
    {"1", ScalarOrder::linear}, {"2", ScalarOrder::quadratic}, {"3", ScalarOrder::cubic}};

template <class T>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, T>>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}

template <class T>
T chosen(const std::vector<std::pair<std::string, T>>& choices, const std::string& name) {
  for (const auto& choice : choices)
    if (choice.first == name) return choice.second;
  return choices.front().second;  // CLI11 has checked the name
}

class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

void choose_transfer_function(Scene& scene, const RenderArguments& args, const Console& console) {
  ColorMap map = scene.default_color_map();
  const std::vector<std::string> presets = preset_names();
  if (!args.transfer_function.empty()) {
    if (auto colors = preset(args.transfer_function)) {
      // A preset brings colours; the opacity stays the one fitted to the values.
      colors = rescaled(*colors, map.colors.front().x, map.colors.back().x);
      colors->opacities = map.opacities;
      map = *colors;
    } else if (std::filesystem::exists(args.transfer_function)) {
      map = read_color_map(args.transfer_function);
    } else {
      throw Error(fmt::format("--tf '{}': neither a file nor a preset; the presets are: {}",
                              args.transfer_function, fmt::join(presets, " ")));
    }
  }
  if (!args.transfer_range.empty()) {
    const auto range = parse_numbers("--tf-range", args.transfer_range, {2});
    if (!(range[0] < range[1]))
      throw Error(fmt::format("--tf-range '{}': the first number must be below the second",
                              args.transfer_range));
    map = rescaled(std::move(map), range[0], range[1]);
  }
  const ScalarField& field = scene.field();
  if (map.colors.back().x < field.low || map.colors.front().x > field.high)
    console.say(fmt::format(
        "the colour map covers {:g} to {:g}, but '{}' runs from {:g} to {:g}; see --tf-range",
        map.colors.front().x, map.colors.back().x, field.name, field.low, field.high));
  const double unit = args.unit_distance > 0 ? args.unit_distance : scene.default_unit_distance();
  scene.set_transfer_function(to_transfer_function(map, unit, args.opacity_scale));
}

bool asks_for(const std::vector<std::string>& channels, const char* name) {
  return std::find(channels.begin(), channels.end(), name) != channels.end();
}

// Light and clip planes need no mesh: what is wrong with them is said before a long read.
void choose_light_and_clip(const RenderArguments& args, RenderSettings& settings) {
  const bool surfaces = !args.isosurfaces.empty() || !args.intervals.empty();
  for (const char* channel : {"isovalue", "normal"})
    if (asks_for(args.channels, channel) && !surfaces)
      throw Error(
          fmt::format("--channels {}: it is of isosurfaces and intervals; add an --iso or "
                      "an --interval",
                      channel));
  for (const std::string& text : args.clip_planes)
    settings.clip_planes.push_back(parse_clip_plane(text));
  if (!args.clip_box.empty())
    for (const ClipPlane& plane : parse_clip_box(args.clip_box))
      settings.clip_planes.push_back(plane);
  if (args.lights.empty()) {
    if (!args.material.empty())
      throw Error(
          fmt::format("--material '{}': there is no light; add --light head", args.material));
    return;
  }
  if (!surfaces)
    throw Error(fmt::format("--light '{}': there is nothing to light; add an --iso or --interval",
                            args.lights[0]));
  Lighting lighting;
  lighting.lights.clear();
  for (const std::string& text : args.lights) lighting.lights.push_back(parse_light(text));
  if (!args.material.empty()) {
    const auto n = parse_numbers("--material", args.material, {4});
    lighting.ambient = n[0];
    lighting.diffuse = n[1];
    lighting.specular = n[2];
    lighting.exponent = n[3];
    if (const auto problem = lighting.problem())
      throw Error(fmt::format("--material '{}': {}", args.material, *problem));
  }
  settings.lighting = lighting;
}

void choose_classification(Scene& scene, const RenderArguments& args, const Console& console) {
  if (args.no_volume && args.isosurfaces.empty() && args.intervals.empty())
    throw Error("--no-volume leaves nothing to see; add an --iso or an --interval");
  Classification classification = scene.classification();
  const ScalarField& field = scene.field();
  auto warn_outside = [&](const std::string& what, float low, float high) {
    if (high < field.low || low > field.high)
      console.say(fmt::format("{} is outside of '{}', which runs from {:g} to {:g}", what,
                              field.name, field.low, field.high));
  };
  for (const std::string& text : args.isosurfaces) {
    classification.isosurfaces.push_back(parse_isosurface(text, scene.transfer_function()));
    const float value = classification.isosurfaces.back().value;
    warn_outside("--iso " + text, value, value);
  }
  for (const std::string& text : args.intervals) {
    classification.intervals.push_back(parse_interval(text, scene.transfer_function()));
    warn_outside("--interval " + text, classification.intervals.back().low,
                 classification.intervals.back().high);
  }
  if (args.no_volume) classification.volume.reset();
  scene.set_classification(std::move(classification));
}

Camera choose_camera(const Bounds& bounds, const RenderArguments& args, double aspect_ratio) {
  Camera camera = named_view(args.view, bounds, aspect_ratio);
  if (!args.camera.empty()) {
    const auto n = parse_numbers("--camera", args.camera, {6, 9});
    camera.position = {n[0], n[1], n[2]};
    camera.focal_point = {n[3], n[4], n[5]};
    if (n.size() == 9) camera.view_up = {n[6], n[7], n[8]};
  }
  camera.parallel = args.parallel;
  if (args.view_angle != 0) camera.view_angle = args.view_angle;
  orbit(camera, args.azimuth, args.elevation);
  zoom(camera, args.zoom);
  return camera;
}

void choose_background(const std::string& text, ImageFileOptions& options) {
  if (text == "transparent") return;
  std::vector<double> rgb;
  if (text == "white")
    rgb = {1, 1, 1};
  else if (text == "black")
    rgb = {0, 0, 0};
  else
    rgb = parse_numbers("--background", text, {3});
  for (std::size_t c = 0; c < 3; ++c) {
    if (rgb[c] < 0 || rgb[c] > 1)
      throw Error(fmt::format("--background '{}': each number must be 0 to 1", text));
    options.background[c] = static_cast<float>(rgb[c]);
  }
}

nlohmann::json to_json(const std::vector<Finding>& findings) {
  auto list = nlohmann::json::array();
  for (const Finding& finding : findings) list.push_back(describe(finding));
  return list;
}

void run(const RenderArguments& args) {
  const Console console(args.quiet);
  const PictureSize size = parse_size(args.size);
  ImageFileOptions file_options;
  file_options.png_bits = args.bits;
  choose_background(args.background, file_options);
  check_image_path(args.output);
  if (!args.stats.empty()) check_writable(args.stats);
  RenderSettings settings;
  choose_light_and_clip(args, settings);
  const double aspect_ratio = static_cast<double>(size.width) / size.height;
  // What can be wrong with a camera shows with any bounds: said now, not after a long read.
  PixelRays(choose_camera({{0, 0, 0}, {1, 1, 1}}, args, aspect_ratio), size.width, size.height);

  Stopwatch watch;
  ReadOptions read_options;
  read_options.solution = args.solution;
  read_options.merge_points = args.merge_points;
  if (args.time_step >= 0) read_options.time_step = args.time_step;
  const Notice notice = [&](const std::string& line) { console.say(line); };
  auto mesh = std::make_unique<Mesh>(read_mesh(args.mesh, read_options, notice));
  const double ms_read = watch.lap();

  SceneOptions scene_options;
  scene_options.field.name = args.field;
  if (args.association == "point") scene_options.field.association = Association::point;
  if (args.association == "cell") scene_options.field.association = Association::cell;
  scene_options.cell_data = chosen(kCellData, args.cell_data);
  scene_options.keep_cell_numbers = asks_for(args.channels, "cell_id");
  scene_options.keep_gradients = settings.lighting || asks_for(args.channels, "normal");
  auto scene = [&] {
    try {
      return Scene(*mesh, scene_options);
    } catch (const Error& error) {
      throw Error(args.mesh + ": " + error.what());
    }
  }();
  mesh.reset();  // the scene needs it no more
  choose_transfer_function(scene, args, console);
  choose_classification(scene, args, console);
  const double ms_build = watch.lap();
  const ScalarField& field = scene.field();
  console.say(fmt::format("{}: {} cells, coloured by '{}' ({}, {:g} to {:g})", args.mesh,
                          with_separators(scene.cell_count()), field.name,
                          scene.cell_data_averaged()                ? "cell data averaged to points"
                          : field.association == Association::point ? "point data"
                                                                    : "cell data",
                          field.low, field.high));
  for (const Finding& finding : scene.findings()) console.say(describe(finding));

  settings.width = size.width;
  settings.height = size.height;
  settings.mode = chosen(kModes, args.mode);
  settings.integrator.kind = chosen(kIntegrators, args.integrator);
  settings.integrator.samples = args.samples;
  settings.interval_form = chosen(kIntervalForms, args.interval_form);
  settings.order = chosen(kOrders, args.order);
  settings.early_termination = args.early_termination;
  settings.threads = args.threads;
  settings.channels = args.channels;
  const Camera camera = choose_camera(scene.bounds(), args, aspect_ratio);
  const RenderResult result = render(scene, camera, settings, console.progress_bar());
  const double ms_render = watch.lap();
  const RenderStatistics& statistics = result.statistics;
  if (args.verbose)
    for (const std::string& line : statistics.plan) console.say(line);

  file_options.metadata = {
      {"Software", "plume " PLUME_VERSION},
      {"plume:mesh", std::filesystem::path(args.mesh).filename().string()},
      {"plume:field", field.name},
      {"plume:mode", args.mode},
      {"plume:plan", fmt::format("{}", fmt::join(statistics.plan, "; "))},
      {"plume:camera",
       fmt::format("position {} focal point {} view up {} view angle {} parallel "
                   "scale {}{}",
                   fmt::join(camera.position, ","), fmt::join(camera.focal_point, ","),
                   fmt::join(camera.view_up, ","), camera.view_angle, camera.parallel_scale,
                   camera.parallel ? " (parallel)" : "")}};
  write_image(result.image, args.output, file_options);
  const double ms_write = watch.lap();

  if (!args.stats.empty()) {
    const double cells = static_cast<double>(scene.cell_count());
    const bool of_cells = field.association == Association::cell || scene.cell_data_averaged();
    const nlohmann::json stats{
        {"rays", statistics.rays},
        {"rays_hit", statistics.rays_hit},
        {"entries", statistics.entries},
        {"cells_visited", statistics.cells_visited},
        {"lost_rays", statistics.lost_rays},
        {"rays_in_packets", statistics.rays_in_packets},
        {"isosurfaces_crossed", statistics.surfaces},
        {"interval_visits", statistics.visits},
        {"ms",
         {{"read", ms_read}, {"build", ms_build}, {"render", ms_render}, {"write", ms_write}}},
        {"peak_memory_bytes", peak_memory_bytes()},
        {"bytes_per_cell", static_cast<double>(scene.bytes()) / cells},
        {"walkable_bytes", scene.bytes()},
        {"cells", scene.cell_count()},
        {"points", scene.point_count()},
        {"boundary_faces", scene.boundary_face_count()},
        {"field", field.name},
        {"field_association", of_cells ? "cell" : "point"},
        {"cell_data", of_cells ? nlohmann::json(args.cell_data) : nlohmann::json()},
        {"field_range", {field.low, field.high}},
        {"values_not_finite", field.not_finite},
        {"size", {size.width, size.height}},
        {"order", static_cast<int>(settings.order)},
        {"plan", statistics.plan},
        {"findings", to_json(scene.findings())}};
    write_whole_file(args.stats, stats.dump(2) + "\n");
  }
  console.say(fmt::format("{}: {} x {}, {} cells walked, {} rays lost, {:.0f} ms", args.output,
                          size.width, size.height, with_separators(statistics.cells_visited),
                          statistics.lost_rays, ms_render));
}

}  // namespace

void add_render(CLI::App& app) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Render a mesh file to a PNG or EXR picture");
  command->add_option("mesh", args->mesh, "The mesh: .vtu .vtk .vts .cgns .case .foam .ex2 ...")
      ->required();
  command->add_option("--solution", args->solution, "Plot3D: the q file of the grid");
  command->add_option("-o,--output", args->output, "The picture: .png or .exr (picture.png)");
  command->add_option("--field", args->field,
                      "What to show: NAME, NAME:component or NAME:magnitude (the active field)");
  command->add_option("--association", args->association, "Where a name is on both: point or cell")
      ->check(CLI::IsMember({"point", "cell"}));
  command
      ->add_option("--cell-data", args->cell_data,
                   "Values of cells: constant in each, or averaged to the points (constant)")
      ->check(CLI::IsMember(names_of(kCellData)));
  command->add_option("--time-step", args->time_step, "Which step of several, from 0 (the last)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--merge-points", args->merge_points,
                    "Merge coincident points of neighbouring blocks");
  command->add_option("--size", args->size, "Pixels: WIDTHxHEIGHT (1024x768)");
  CLI::Option* view = command->add_option(
      "--view", args->view, "Look along +x -x +y -y +z -z, or iso; fitted to the mesh (iso)");
  command
      ->add_option("--camera", args->camera,
                   "Position and focal point, and view up if wanted: PX,PY,PZ,FX,FY,FZ[,UX,UY,UZ]")
      ->excludes(view);
  command->add_option("--azimuth", args->azimuth, "Turn the camera around view up, degrees");
  command->add_option("--elevation", args->elevation, "Turn the camera upwards, degrees");
  command->add_option("--zoom", args->zoom, "Enlarge by this factor (1)");
  command->add_option("--view-angle", args->view_angle, "Degrees, bottom to top (30)");
  command->add_flag("--parallel", args->parallel, "Parallel projection");
  command->add_option("--tf", args->transfer_function,
                      "ParaView's JSON colour map, or a preset: cool-warm viridis inferno turbo "
                      "gray rainbow (fitted to the field)");
  command->add_option("--tf-range", args->transfer_range, "Stretch the colour map over LOW,HIGH");
  command->add_option("--opacity-scale", args->opacity_scale, "Multiply the extinction by this (1)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--unit-distance", args->unit_distance,
                   "World length over which opacity applies (a tenth of the mesh's diagonal)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--iso", args->isosurfaces,
                   "An isosurface: VALUE[:OPACITY[:R,G,B]]; opaque, of the colour map's colour "
                   "unless said (repeatable)")
      ->allow_extra_args(false);
  command
      ->add_option("--interval", args->intervals,
                   "All between two values, as opaque however thick it is: "
                   "LOW,HIGH[:OPACITY[:R,G,B]] (repeatable; opacity 0.5)")
      ->allow_extra_args(false);
  command
      ->add_option("--light", args->lights,
                   "Light on isosurfaces and intervals: head, or X,Y,Z towards the light, and "
                   ":INTENSITY (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--material", args->material,
                      "Of what is lit: AMBIENT,DIFFUSE,SPECULAR,EXPONENT (0.2,0.8,0.25,30)");
  command
      ->add_option("--clip", args->clip_planes,
                   "Keep one side of a plane: X,Y,Z,NX,NY,NZ, the normal points to what is kept "
                   "(repeatable)")
      ->allow_extra_args(false);
  command->add_option("--clip-box", args->clip_box,
                      "Keep what is inside of a box: X0,Y0,Z0,X1,Y1,Z1");
  command->add_flag("--no-volume", args->no_volume, "Isosurfaces and intervals alone");
  command
      ->add_option("--interval-form", args->interval_form,
                   "Opacity of intervals: exponential or linear (exponential)")
      ->check(CLI::IsMember(names_of(kIntervalForms)));
  command->add_option("--mode", args->mode, "volume, mip, integral or depth (volume)")
      ->check(CLI::IsMember(names_of(kModes)));
  command
      ->add_option("--integrator", args->integrator,
                   "closed-form, table, table2 (of second order, for --order 2 and 3), midpoint "
                   "or reference")
      ->check(CLI::IsMember(names_of(kIntegrators)));
  command->add_option("--samples", args->samples, "Samples a segment, for midpoint (1)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--order", args->order,
                   "The scalar inside of a cell: 1 linear, 2 quadratic, 3 cubic; tetrahedra are "
                   "linear (1)")
      ->check(CLI::IsMember(names_of(kOrders)));
  command
      ->add_option("--early-termination", args->early_termination,
                   "Transmittance at which a ray ends (1e-4)")
      ->check(CLI::Range(0.0, 0.999));
  command
      ->add_option("--channels", args->channels,
                   "More channels in an EXR: depth,optical_depth,cell_id,cell_count,isovalue,"
                   "normal")
      ->delimiter(',');
  command->add_option("--bits", args->bits, "Bits a channel of a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}));
  command->add_option("--background", args->background,
                      "Of a PNG: white, black, transparent or R,G,B from 0 to 1 (white)");
  command->add_option("--threads", args->threads, "Threads, 0 for all (0)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--stats", args->stats, "Write counts, times and the plan to this JSON file");
  command->add_flag("--verbose", args->verbose, "Print the plan and the reasons for it");
  command->add_flag("--quiet", args->quiet, "Print nothing but errors");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
