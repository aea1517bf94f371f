// plume tetrahedralize: points, or what a closed surface encloses, as tetrahedra.

#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "console.h"
#include "plume/io/read_surface.h"
#include "plume/io/whole_file.h"
#include "plume/io/write_mesh.h"
#include "plume/mesh/error.h"

namespace plume::command {
namespace {

struct TetrahedralizeArguments {
  std::string input, output, engine = "automatic";
  std::vector<double> quality;
  SurfaceMeshing meshing;
  int time_step = -1;
  bool points = false, quiet = false;
};

const std::vector<std::pair<std::string, TetrahedralizationEngine>> kEngines{
    {"automatic", TetrahedralizationEngine::automatic},
    {"tetgen", TetrahedralizationEngine::tetgen},
    {"cgal", TetrahedralizationEngine::cgal}};

void check_for_points(const TetrahedralizeArguments& args) {
  if (!args.quality.empty() || args.meshing.volume > 0)
    throw Error(args.input +
                ": --quality and --max-volume are for surfaces, and to points none are added; "
                "leave them out");
}

void check_for_surfaces(const TetrahedralizeArguments& args) {
  if (args.engine == "cgal")
    throw Error(args.input +
                ": --engine cgal is for points; what a surface encloses is filled by TetGen "
                "(--points takes the surface's points alone)");
}

void run(TetrahedralizeArguments args) {
  check_writable(args.output);
  const Console console(args.quiet);
  const Notice notice = [&](const std::string& line) { console.say(line); };
  if (!args.quality.empty()) args.meshing.radius_edge_ratio = args.quality[0];
  if (args.quality.size() > 1) args.meshing.dihedral_angle = args.quality[1];
  ReadOptions options;
  if (args.time_step >= 0) options.time_step = args.time_step;
  TriangleSurface surface = read_surface(args.input, options, notice);
  if (args.points) surface.triangles.clear();
  const bool points = surface.triangles.empty();
  points ? check_for_points(args) : check_for_surfaces(args);
  TetrahedralizationEngine engine = TetrahedralizationEngine::automatic;
  for (const auto& [name, value] : kEngines)
    if (name == args.engine) engine = value;
  const Tetrahedralization result = [&] {
    try {
      return points ? tetrahedralize(surface.vertices, engine)
                    : tetrahedralize(surface, args.meshing);
    } catch (const Error& error) {
      throw Error(args.input + ": " + error.what());
    }
  }();
  report_tetrahedra(result, args.input,
                    points ? fmt::format("{} points", surface.vertices.point_count())
                           : fmt::format("{} triangles", surface.triangles.size()),
                    notice);
  write_mesh(result.mesh, args.output);
  console.say(fmt::format("{}: {} cells, {} points", args.output,
                          with_separators(result.mesh.cell_count()),
                          with_separators(result.mesh.point_count())));
}

}  // namespace

void add_tetrahedralize(CLI::App& app) {
  auto args = std::make_shared<TetrahedralizeArguments>();
  CLI::App* command = app.add_subcommand(
      "tetrahedralize", "Make tetrahedra of points, or of what a closed surface encloses");
  command
      ->add_option("input", args->input,
                   "Points: .csv .xyz .ply .vtp .vtu .vtk; a surface of triangles: .stl .obj .ply "
                   ".vtp .vtu .vtk")
      ->required();
  command->add_option("-o,--output", args->output, "The mesh file: .vtu or .vtk")->required();
  std::vector<std::string> names;
  for (const auto& [name, engine] : kEngines) names.push_back(name);
  command
      ->add_option("--engine", args->engine,
                   "For points: tetgen, cgal, or automatic (TetGen where the build has it)")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--quality", args->quality,
                   "Of a surface's tetrahedra: the largest radius-edge ratio, and the smallest "
                   "dihedral angle in degrees if wanted: RATIO[,ANGLE]")
      ->delimiter(',')
      ->expected(1, 2);
  command->add_option("--max-volume", args->meshing.volume, "The largest volume of one of them")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--max-points", args->meshing.added_points,
                   "Refine until so many points are added (10000000)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--points", args->points, "Take a surface's points alone");
  command->add_option("--time-step", args->time_step, "Which step of several, from 0 (the last)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--quiet", args->quiet, "Print nothing but errors");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
