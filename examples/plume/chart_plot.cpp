#include "chart_plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "chart_script.h"
#include "plume/io/whole_file.h"
#include "plume/mesh/error.h"

extern char** environ;  // NOLINT: POSIX's own

namespace plume::command {
namespace {

namespace fs = std::filesystem;

// The whole path of gnuplot; empty where there is none.
std::string find_gnuplot() {
  const char* const given = std::getenv("PATH");
  std::string paths = given ? given : "/usr/local/bin:/usr/bin:/bin";
  for (std::size_t at = 0; at <= paths.size();) {
    const std::size_t end = std::min(paths.find(':', at), paths.size());
    const fs::path program = fs::path(paths.substr(at, end - at)) / "gnuplot";
    if (access(program.c_str(), X_OK) == 0 && fs::is_regular_file(program)) return program;
    at = end + 1;
  }
  return {};
}

// A directory that goes when this does.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (fs::temp_directory_path() / "plume-chart-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error(
          fmt::format("{}: no directory can be made there: {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Runs a program on a file, what it says goes to another; whether it ended well.
bool run(const std::string& program, const fs::path& script, const fs::path& words) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, words.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // -d: without the user's own settings.
  std::string option = "-d", file = script.string(), name = program;
  std::array<char*, 4> arguments{name.data(), option.data(), file.data(), nullptr};
  pid_t child = 0;
  const int problem =
      posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0)
    throw Error(fmt::format("{} cannot be run: {}", program, std::strerror(problem)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

}  // namespace

void require_gnuplot() {
  if (find_gnuplot().empty())
    throw Error(
        "gnuplot, which draws .png and .svg, was not found (Debian: gnuplot-nox); .csv and .json "
        "need nothing");
}

void draw_chart(const Chart& chart, const fs::path& picture) {
  require_gnuplot();
  const TemporaryDirectory directory;
  const fs::path script = directory.path() / "chart.gnuplot", words = directory.path() / "words";
  // Gnuplot draws in its own directory, whose name holds nothing that would have to be quoted.
  const bool svg = picture.extension() == ".svg";
  const fs::path drawn = directory.path() / (svg ? "chart.svg" : "chart.png");
  std::ofstream(script) << chart_script(chart, drawn, svg);
  if (!run(find_gnuplot(), script, words) || !fs::exists(drawn) || fs::file_size(drawn) == 0)
    throw Error(fmt::format("{}: gnuplot could not draw it: {}", picture.string(), text_of(words)));
  std::ifstream stream(drawn, std::ios::binary);
  write_whole_file(picture, std::string{std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace plume::command
