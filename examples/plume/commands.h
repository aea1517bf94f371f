/// The subcommands of `plume`. Each adds itself to the command line and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

namespace plume::command {

void add_render(CLI::App& app);
void add_info(CLI::App& app);
void add_chart(CLI::App& app);
void add_generate(CLI::App& app);
void add_tetrahedralize(CLI::App& app);

}  // namespace plume::command
