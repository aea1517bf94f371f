/// ParaView's list of files by time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plume {

struct PvdEntry {
  double time = 0;
  std::string file;  ///< as the list's reader finds it: relative to the list
};

/// Writes a .pvd, whole or not at all. Throws Error, naming the file and the reason.
void write_pvd(const std::vector<PvdEntry>& entries, const std::filesystem::path& file);

}  // namespace plume
