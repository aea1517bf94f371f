// plume generate: a mesh made on the spot.

#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "console.h"
#include "plume/datasets/generate.h"
#include "plume/io/whole_file.h"
#include "plume/io/write_mesh.h"

namespace plume::command {
namespace {

struct GenerateArguments {
  std::string name, output;
  GenerateOptions options;
  bool quiet = false;
};

void run(const GenerateArguments& args) {
  check_writable(args.output);
  const Mesh mesh = generate(args.name, args.options);
  write_mesh(mesh, args.output);
  Console(args.quiet)
      .say(fmt::format("{}: {} cells, {} points", args.output, with_separators(mesh.cell_count()),
                       with_separators(mesh.point_count())));
}

}  // namespace

void add_generate(CLI::App& app) {
  auto args = std::make_shared<GenerateArguments>();
  std::string description = "Make a mesh:";
  for (const Generator& generator : generators())
    description += fmt::format("\n  {:<18} {}", generator.name, generator.description);
  CLI::App* command = app.add_subcommand("generate", "Make a mesh of a given kind");
  command->add_option("name", args->name, description)->required();
  command->add_option("-o,--output", args->output, "The mesh file: .vtu, .vts, .vtr, .vti or .vtk")
      ->required();
  command->add_option("--size", args->options.size, "Cells along an edge (each mesh's own default)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--jitter", args->options.jitter,
                   "Displacement of interior points, in cell edges (0.2)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seed", args->options.seed, "Seed of the displacement (1)");
  command->add_flag("--quiet", args->quiet, "Print nothing but errors");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
