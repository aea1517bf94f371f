#include "plume/io/find_files.h"

#include <glob.h>

#include <algorithm>
#include <optional>

#include "plume/io/numbered_name.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr const char* kWildcards = "*?[";

// What the C library's glob() finds, in no order.
std::vector<std::string> shell_finds(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> names;
  // Folders that cannot be opened count as empty, as they do to a shell.
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return names;
}

std::string without_wildcards(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string("*?[]\\").find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

bool is_file_pattern(const std::string& name) {
  if (std::filesystem::exists(name)) return false;
  return name.find_first_of(kWildcards) != std::string::npos || NumberedName::in(name);
}

std::vector<std::filesystem::path> find_files(const std::string& pattern) {
  std::vector<std::string> names;
  if (const std::optional<NumberedName> numbered = NumberedName::in(pattern)) {
    for (std::string& name : shell_finds(without_wildcards(numbered->before()) + "*" +
                                         without_wildcards(numbered->after())))
      if (numbered->number_in(name)) names.push_back(std::move(name));
    std::sort(names.begin(), names.end(), [&](const auto& a, const auto& b) {
      return *numbered->number_in(a) < *numbered->number_in(b);
    });
  } else {
    names = shell_finds(pattern);
    std::sort(names.begin(), names.end(), natural_less);
  }
  if (names.empty())
    throw Error(pattern +
                ": no file matches this pattern; check the folder, and that the pattern is quoted");
  return {names.begin(), names.end()};
}

}  // namespace plume
