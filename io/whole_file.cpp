#include "plume/io/whole_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "plume/mesh/error.h"

namespace plume {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// A name that nobody else uses. Its length does not depend on the file's.
fs::path hidden_name_beside(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  return folder_of(file) / (".plume-" + std::to_string(getpid()) + "-" + std::to_string(count++));
}

}  // namespace

WholeFile::WholeFile(fs::path target)
    : target_(std::move(target)), path_(hidden_name_beside(target_)) {}

WholeFile::~WholeFile() {
  std::error_code ignored;  // nothing is there where writing could not start
  if (!kept_) fs::remove(path_, ignored);
}

void WholeFile::keep() {
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error) fail(target_, "cannot be replaced (" + error.message() + "); choose another name");
  kept_ = true;
}

void write_whole_file(const fs::path& file, std::string_view bytes) {
  WholeFile whole(file);
  std::ofstream out(whole.path(), std::ios::binary);
  errno = 0;
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    fail(file, "not written (" + std::string(std::strerror(errno)) +
                   "); is the disk full, the folder writable?");
  }
  whole.keep();
}

void check_writable(const fs::path& file) {
  std::error_code error;
  const fs::path folder = folder_of(file);
  const fs::file_status there = fs::status(folder, error);
  if (!fs::exists(there))
    fail(file, "there is no folder " + folder.string() + "; create it or choose another");
  if (!fs::is_directory(there)) fail(file, folder.string() + " is no folder; choose another");
  const fs::file_status target = fs::status(file, error);
  if (fs::is_directory(target)) fail(file, "is a folder; give the name of a file");
  if (target.type() == fs::file_type::none)
    fail(file, "cannot be a file's name (" + error.message() + "); choose another");

  // Permissions, quotas and read-only mounts show only when one tries.
  const WholeFile probe(file);
  errno = 0;
  if (!std::ofstream(probe.path())) {
    fail(file, "folder " + folder.string() + " is not writable (" + std::strerror(errno) +
                   "); choose another");
  }
}

}  // namespace plume
