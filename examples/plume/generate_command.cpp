// plume generate: a mesh made on the spot.

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "console.h"
#include "plume/datasets/generate.h"
#include "plume/io/numbered_name.h"
#include "plume/io/read_file.h"
#include "plume/io/whole_file.h"
#include "plume/io/write_mesh.h"
#include "plume/io/write_pvd.h"
#include "plume/mesh/error.h"

namespace plume::command {
namespace {

struct GenerateArguments {
  std::string name, output;
  GenerateOptions options;
  int steps = 0;
  bool quiet = false;
};

// Steps over one period, which a movie can repeat: as files with a number each, or with a list of
// them.
void write_steps(const GenerateArguments& args, const Console& console) {
  const double period = generator_named(args.name).period;
  if (period == 0)
    throw Error(
        fmt::format("--steps {}: {} does not change in time; leave it out", args.steps, args.name));
  const std::filesystem::path output(args.output);
  const bool listed = lower_extension(output) == ".pvd";
  auto parts = NumberedName::in(args.output);
  if (listed)
    parts = NumberedName::in((output.parent_path() / output.stem()).string() + "_%04d.vts");
  if (!parts)
    throw Error(fmt::format(
        "{}: {} steps need a place for their number, such as flow_%04d.vtu, or a list: .pvd",
        args.output, args.steps));
  std::vector<PvdEntry> entries;
  std::size_t cells = 0;
  for (int step = 0; step < args.steps; ++step) {
    GenerateOptions options = args.options;
    options.time = period * step / args.steps;
    const std::string file = parts->at(static_cast<std::uint64_t>(step));
    const Mesh mesh = generate(args.name, options);
    write_mesh(mesh, file);
    cells = mesh.cell_count();
    entries.push_back({options.time, std::filesystem::path(file).filename().string()});
  }
  if (listed) write_pvd(entries, output);
  console.say(
      fmt::format("{}: {} steps of {} cells", args.output, args.steps, with_separators(cells)));
}

void run(const GenerateArguments& args) {
  check_writable(args.output);
  const Console console(args.quiet);
  if (args.steps > 0) return write_steps(args, console);
  const Mesh mesh = generate(args.name, args.options);
  write_mesh(mesh, args.output);
  console.say(fmt::format("{}: {} cells, {} points", args.output,
                          with_separators(mesh.cell_count()), with_separators(mesh.point_count())));
}

}  // namespace

void add_generate(CLI::App& app) {
  auto args = std::make_shared<GenerateArguments>();
  std::string description = "Make a mesh:";
  for (const Generator& generator : generators())
    description += fmt::format("\n  {:<18} {}", generator.name, generator.description);
  CLI::App* command = app.add_subcommand("generate", "Make a mesh of a given kind");
  command->add_option("name", args->name, description)->required();
  command
      ->add_option("-o,--output", args->output,
                   "The mesh file: .vtu, .vts, .vtr, .vti or .vtk; of several "
                   "steps .pvd, or a name with a place for their number, such as flow_%04d.vts")
      ->required();
  command->add_option("--size", args->options.size, "Cells along an edge (each mesh's own default)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--jitter", args->options.jitter,
                   "Displacement of interior points, in cell edges (0.2)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seed", args->options.seed, "Seed of the displacement (1)");
  command
      ->add_option("--steps", args->steps,
                   "Of a mesh that changes in time: so many steps, over one period")
      ->check(CLI::PositiveNumber);
  command->add_flag("--quiet", args->quiet, "Print nothing but errors");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
