#include "render_arguments.h"

#include "plume/lib/render_modes.h"

namespace plume::command {
namespace {

constexpr const char* kMeshFiles = "The mesh: .vtu .vtk .vts .cgns .case .foam .ex2 ...";

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (const ModeInWords& words : modes_in_words()) names.emplace_back(words.name);
  return names;
}

}  // namespace

Mode mode_named(const std::string& name) {
  for (const ModeInWords& words : modes_in_words())
    if (words.name == name) return words.mode;
  return Mode::volume;  // CLI11 has checked the name
}

void add_mesh_options(CLI::App& command, RenderArguments& args) {
  command.add_option("mesh", args.mesh, kMeshFiles)->required();
  command.add_option("--solution", args.solution, "Plot3D: the q file of the grid");
  command.add_option("--field", args.field,
                     "What to show: NAME, NAME:component or NAME:magnitude (the active field)");
  command.add_option("--association", args.association, "Where a name is on both: point or cell")
      ->check(CLI::IsMember({"point", "cell"}));
  command
      .add_option("--cell-data", args.cell_data,
                  "Values of cells: constant in each, or averaged to the points (constant)")
      ->check(CLI::IsMember(names_of(kCellData)));
  command.add_flag("--merge-points", args.merge_points,
                   "Merge coincident points of neighbouring blocks");
}

void add_camera_options(CLI::App& command, RenderArguments& args) {
  CLI::Option* view = command.add_option(
      "--view", args.view, "Look along +x -x +y -y +z -z, or iso; fitted to the mesh (iso)");
  command
      .add_option("--camera", args.camera,
                  "Position and focal point, and view up if wanted: PX,PY,PZ,FX,FY,FZ[,UX,UY,UZ]")
      ->excludes(view);
  command.add_option("--azimuth", args.azimuth, "Turn the camera around view up, degrees");
  command.add_option("--elevation", args.elevation, "Turn the camera upwards, degrees");
  command.add_option("--zoom", args.zoom, "Enlarge by this factor (1)");
  command.add_option("--view-angle", args.view_angle, "Degrees, bottom to top (30)");
  command.add_flag("--parallel", args.parallel, "Parallel projection");
}

void add_color_options(CLI::App& command, RenderArguments& args) {
  command.add_option("--tf", args.transfer_function,
                     "ParaView's JSON colour map, or a preset: cool-warm viridis inferno turbo "
                     "gray rainbow (fitted to the field)");
  command.add_option("--tf-range", args.transfer_range, "Stretch the colour map over LOW,HIGH");
  command.add_option("--opacity-scale", args.opacity_scale, "Multiply the extinction by this (1)")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--unit-distance", args.unit_distance,
                  "World length over which opacity applies (a tenth of the mesh's diagonal)")
      ->check(CLI::PositiveNumber);
}

void add_render_options(CLI::App& command, RenderArguments& args) {
  add_mesh_options(command, args);
  command.get_option("mesh")->description(
      std::string(kMeshFiles) +
      ", or several by a pattern in quotes: 'flow_*.vtu', 'flow_%04d.vtu'");
  command
      .add_option(
          "--with", args.others,
          "Another mesh in the same picture: FILE[:FIELD], by default of the field that the "
          "first shows, which then has one look in all (repeatable)")
      ->allow_extra_args(false);
  command
      .add_option("--overlap", args.overlap,
                  "Where meshes are in one place: add, both are seen; first, the one named first; "
                  "refuse (add)")
      ->check(CLI::IsMember(names_of(kOverlaps)));
  add_camera_options(command, args);
  add_color_options(command, args);
  command.add_option("-o,--output", args.output,
                     "The picture: .png or .exr; of several, with a place for their number from "
                     "0, such as frame_%04d.png (picture.png)");
  command.add_option("--time,--time-step", args.time,
                     "Which steps: all, last, a number from 0, or FIRST:LAST[:STRIDE] (last)");
  command.add_flag("--no-read-ahead", args.no_read_ahead,
                   "Read a step when it is needed, not while the one before is rendered: holds one "
                   "mesh instead of two");
  command.add_option("--size", args.size, "Pixels: WIDTHxHEIGHT (1024x768)");
  command
      .add_option("--orbit", args.orbit,
                  "Turn the camera once around view up in so many frames, over which time steps, "
                  "where there are several, are spread")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--iso", args.isosurfaces,
                  "An isosurface: VALUE[:OPACITY[:R,G,B]]; opaque, of the colour map's colour "
                  "unless said (repeatable)")
      ->allow_extra_args(false);
  command
      .add_option("--interval", args.intervals,
                  "All between two values, as opaque however thick it is: "
                  "LOW,HIGH[:OPACITY[:R,G,B]] (repeatable; opacity 0.5)")
      ->allow_extra_args(false);
  command
      .add_option("--light", args.lights,
                  "Light on isosurfaces and intervals: head, or X,Y,Z towards the light, and "
                  ":INTENSITY (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--material", args.material,
                     "Of what is lit: AMBIENT,DIFFUSE,SPECULAR,EXPONENT (0.2,0.8,0.25,30)");
  command
      .add_option("--clip", args.clip_planes,
                  "Keep one side of a plane: X,Y,Z,NX,NY,NZ, the normal points to what is kept "
                  "(repeatable)")
      ->allow_extra_args(false);
  command.add_option("--clip-box", args.clip_box,
                     "Keep what is inside of a box: X0,Y0,Z0,X1,Y1,Z1");
  command
      .add_option("--surface", args.surfaces,
                  "An opaque surface in the scene: FILE[:R,G,B], .stl .ply .obj .vtp ... "
                  "(repeatable)")
      ->allow_extra_args(false);
  command
      .add_option("--wall", args.walls,
                  "A side of the grid as an opaque surface: imin imax jmin jmax kmin kmax, and "
                  ":R,G,B where wanted (repeatable)")
      ->allow_extra_args(false);
  command.add_flag("--compact", args.compact,
                   "Keep tetrahedra in 16 bytes a cell instead of 32: for meshes beyond some ten "
                   "million cells");
  command.add_flag("--no-volume", args.no_volume, "Isosurfaces and intervals alone");
  command
      .add_option("--interval-form", args.interval_form,
                  "Opacity of intervals: exponential or linear (exponential)")
      ->check(CLI::IsMember(names_of(kIntervalForms)));
  command
      .add_option("--interval-way", args.interval_way,
                  "Intervals and isosurfaces: split, in data space, or table, to compare (split)")
      ->check(CLI::IsMember(names_of(kIntervalWays)));
  command
      .add_option("--mode", args.mode,
                  "volume; one number a ray: mip, minip, average, integral, optical-depth, depth "
                  "or cells (volume)")
      ->check(CLI::IsMember(mode_names()));
  command.add_option(
      "--gray-range", args.gray_range,
      "Modes integral, optical-depth, depth and cells: what shades of gray run over, "
      "LOW,HIGH (what the first picture holds)");
  command
      .add_option("--integrator", args.integrator,
                  "closed-form, table, table2 (of second order, for --order 2 and 3), midpoint or "
                  "reference (closed-form)")
      ->check(CLI::IsMember(names_of(kIntegrators)));
  command.add_option("--samples", args.samples, "Samples a segment, for midpoint (1)")
      ->check(CLI::PositiveNumber);
  command
      .add_option(
          "--order", args.order,
          "The scalar inside of a cell: 1 linear, 2 quadratic, 3 cubic, adaptive as close as "
          "can be; tetrahedra are linear (1)")
      ->check(CLI::IsMember(names_of(kOrders)));
  command
      .add_option(
          "--tolerance", args.tolerance,
          "The greatest error of a linear RGBA channel, 0 for the reference: chooses order, "
          "integrator and early termination, but what is given")
      ->check(CLI::Range(0.0, 0.999));
  command
      .add_option("--early-termination", args.early_termination,
                  "Transmittance at which a ray ends (1e-4)")
      ->check(CLI::Range(0.0, 0.999));
  command
      .add_option("--channels", args.channels,
                  "More channels in an EXR: depth,optical_depth,cell_id,cell_count,isovalue,"
                  "normal")
      ->delimiter(',');
  command.add_option("--bits", args.bits, "Bits a channel of a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}));
  command.add_option("--background", args.background,
                     "Of a PNG: white, black, transparent or R,G,B from 0 to 1 (white)");
  command.add_option("--threads", args.threads, "Threads, 0 for all (0)")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--stats", args.stats, "Write counts, times and the plan to this JSON file");
  command.add_flag("--verbose", args.verbose, "Print the plan and the reasons for it");
  command.add_flag("--quiet", args.quiet, "Print nothing but errors");
}

}  // namespace plume::command
