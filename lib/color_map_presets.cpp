#include <algorithm>
#include <cstdint>
#include <iterator>

#include "plume/lib/color_map.h"

namespace plume {
namespace {

/// Display colours as hexadecimal red, green, blue, evenly spaced over the map.
using Table = std::vector<std::uint32_t>;

struct Preset {
  const char* name;
  ColorMap::Space space;
  Table colors;
};

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      // K. Moreland, "Diverging color maps for scientific visualization", 2009: the interpolation
      // does the rest.
      {"cool-warm", ColorMap::Space::diverging, {0x3b4cc0, 0xb40426}},
      // Every 17th of the 256 colours by S. van der Walt and N. Smith for matplotlib (CC0), 2015.
      {"viridis",
       ColorMap::Space::rgb,
       {0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b,
        0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725}},
      {"inferno",
       ColorMap::Space::rgb,
       {0x000004, 0x0c0826, 0x240c4f, 0x420a68, 0x5d126e, 0x781c6d, 0x932667, 0xae305c, 0xc73e4c,
        0xdd513a, 0xed6925, 0xf8850f, 0xfca50a, 0xfac62d, 0xf2e661, 0xfcffa4}},
      // Every 17th of the 256 colours by A. Mikhailov, "Turbo, an improved rainbow colormap for
      // visualization", Google, 2019.
      {"turbo",
       ColorMap::Space::rgb,
       {0x30123b, 0x4143a7, 0x4771e9, 0x3e9bfe, 0x22c5e2, 0x1ae4b6, 0x46f884, 0x88ff4e, 0xb9f635,
        0xe1dd37, 0xfaba39, 0xfd8d27, 0xf05b12, 0xd63506, 0xaf1801, 0x7a0403}},
      {"gray", ColorMap::Space::rgb, {0x000000, 0xffffff}},
      // The pure hues from blue to red.
      {"rainbow", ColorMap::Space::rgb, {0x0000ff, 0x00ffff, 0x00ff00, 0xffff00, 0xff0000}},
  };
  return all;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return names;
}

std::optional<ColorMap> preset(const std::string& name) {
  const auto& all = presets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
  if (found == all.end()) return std::nullopt;

  ColorMap map;
  map.name = name;
  map.space = found->space;
  const Table& colors = found->colors;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto channel = [&](int shift) { return ((colors[i] >> shift) & 0xff) / 255.0; };
    map.colors.push_back({static_cast<double>(i) / static_cast<double>(colors.size() - 1),
                          {channel(16), channel(8), channel(0)}});
  }
  map.opacities = {{0, 0}, {1, 1}};
  return map;
}

}  // namespace plume
