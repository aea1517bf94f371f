// plume: from a mesh to a picture.
//
// Exit status: 0 done, 1 something was wrong with a file or a value, 2 wrong usage.

#include <exception>
#include <iostream>
#include <new>

#include "commands.h"
#include "plume/lib/version.h"
#include "plume/mesh/error.h"

int main(int argc, char** argv) {
  CLI::App app{"Ray tracing through unstructured volume meshes"};
  app.name("plume");
  app.set_version_flag("--version", plume::version());
  app.require_subcommand(1);
  plume::command::add_render(app);
  plume::command::add_info(app);
  plume::command::add_chart(app);
  plume::command::add_generate(app);
  plume::command::add_tetrahedralize(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {  // --help, --version
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "plume: " << error.what() << " (see plume --help)\n";
    return 2;
  } catch (const plume::Error& error) {
    std::cerr << "plume: " << error.what() << '\n';
    return 1;
  } catch (const std::bad_alloc&) {
    std::cerr << "plume: out of memory\n";
    return 1;
  }
  return 0;
}
