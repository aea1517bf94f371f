// Transfer-function files: whatever the bytes, a colour map or one Error; and what is read becomes
// a transfer function without a problem, or one Error.

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "bytes.h"
#include "plume/io/color_map_file.h"
#include "plume/mesh/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("plume-fuzz-" + std::to_string(getpid()) + ".json");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const plume::ColorMap map = plume::read_color_map(file);
    if (map.colors.size() > 64 || map.opacities.size() > 64) return 0;  // time, not correctness
    for (const plume::ColorMap& one : {map, plume::rescaled(map, -3, 7)}) {
      const plume::TransferFunction function = plume::to_transfer_function(one, 0.5);
      if (function.problem()) plume::fuzz::fail(function.problem()->c_str());
    }
  } catch (const plume::Error&) {
  }
  std::filesystem::remove(file);
  return 0;
}
