#include "plume/lib/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/lib/render_modes.h"

namespace plume {

constexpr std::array<Frame::TilePixel, kTile* kTile> Frame::kTileOrder = [] {
  std::array<TilePixel, kTile * kTile> order{};
  for (std::size_t place = 0; place < order.size(); ++place)
    for (int bit = 0; bit < 5; ++bit) {
      order[place].x |= static_cast<int>(place >> (2 * bit) & 1) << bit;
      order[place].y |= static_cast<int>(place >> (2 * bit + 1) & 1) << bit;
    }
  return order;
}();

Frame::Frame(std::vector<const Scene*> scenes, const Camera& camera, const RenderSettings& settings)
    : scenes_(std::move(scenes)),
      settings_(settings),
      window_(settings.window.value_or(PixelWindow{0, 0, settings.width, settings.height})),
      rays_(camera, settings.width, settings.height),
      optical_depth_(scene().transfer_function()),
      tolerance_(settings.scalar_tolerance *
                 (static_cast<double>(scene().field().high) - scene().field().low)) {
  Bounds bounds = scene().bounds();
  for (const Scene* other : scenes_) bounds = united(bounds, other->bounds());
  gap_ = 1e-6 * bounds.diagonal();
  image_.width = window_.width;
  image_.height = window_.height;
  image_.rgba.assign(4 * pixel_count(), 0);
  // In the order in which they were asked for.
  for (const std::string& name : settings.channels) {
    if (name != "normal") {
      channel_place(name);
      continue;
    }
    for (const char* component : {"normal.x", "normal.y", "normal.z"})
      channels_.normal.push_back(channel_place(component));
  }
  if (const ModeInWords& words = in_words(settings.mode); words.channel != nullptr)
    raw_ = channel_place(words.channel);
  channels_.depth = wanted("depth");
  channels_.optical_depth = wanted("optical_depth");
  channels_.cell_id = wanted("cell_id");
  channels_.cell_count = wanted("cell_count");
  channels_.isovalue = wanted("isovalue");
}

std::size_t Frame::channel_place(const std::string& name) {
  for (std::size_t i = 0; i < image_.channels.size(); ++i)
    if (image_.channels[i].name == name) return i;
  image_.channels.push_back({name, std::vector<float>(pixel_count(), 0)});
  return image_.channels.size() - 1;
}

std::optional<std::size_t> Frame::wanted(const std::string& name) {
  const auto& list = settings_.channels;
  if (std::find(list.begin(), list.end(), name) == list.end()) return std::nullopt;
  return channel_place(name);
}

void Frame::put_surfaces() {
  const bool by_depth = settings_.mode == Mode::depth;
  for (std::size_t i = 0; i < pixel_count(); ++i) {
    if (!opaque_.has_color(i)) continue;
    float* rgba = &image_.rgba[4 * i];
    const auto distance = static_cast<float>(opaque_.limits[i]);
    if (settings_.mode == Mode::volume) {
      for (std::size_t c = 0; c < 3; ++c) rgba[c] += (1 - rgba[3]) * opaque_.colors[i][c];
      rgba[3] = 1;
    } else if (by_depth && rgba[3] == 0) {
      image_.channels[*raw_].values[i] = distance;
      rgba[3] = 1;
    }
    if (channels_.depth && std::isinf(image_.channels[*channels_.depth].values[i]))
      image_.channels[*channels_.depth].values[i] = distance;
  }
}

void Frame::shade_raw(RenderStatistics& statistics) {
  if (!raw_) return;
  const auto& values = image_.channels[*raw_].values;
  auto for_each_seen = [&](auto&& visit) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (image_.rgba[4 * i + 3] != 0) visit(values[i], &image_.rgba[4 * i]);
  };
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for_each_seen([&](float value, float*) {
    low = std::min(low, value);
    high = std::max(high, value);
  });
  if (!(low <= high)) return;
  statistics.values = {low, high};
  const ShadeBy by = in_words(settings_.mode).shade;
  if (by == ShadeBy::transfer_function) {
    for_each_seen([&](float value, float* rgba) {
      const Optics optics = scene().transfer_function().at(value);
      std::copy(optics.color.begin(), optics.color.end(), rgba);
    });
    return;
  }
  if (by == ShadeBy::gray_from_zero) low = std::min(low, 0.0f);
  if (settings_.gray_range) {
    low = (*settings_.gray_range)[0];
    high = (*settings_.gray_range)[1];
  }
  if (low < high) statistics.gray_range = {low, high};
  for_each_seen([&](float value, float* rgba) {
    float shade = high > low ? std::clamp((value - low) / (high - low), 0.0f, 1.0f) : 1.0f;
    if (by == ShadeBy::gray_near_is_white && high > low) shade = 1 - shade;
    std::fill_n(rgba, 3, shade);
  });
}

}  // namespace plume
