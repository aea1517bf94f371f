#include "plume/tests/bench/peer_table.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <filesystem>

#include "plume/io/image_file.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
std::vector<PeerRow> compare_peers(std::span<const PeerWay> ways, const Image& reference,
                                   const PeerTimings& timings) {
  const auto now = [&] {
    return timings.one_thread ? seconds_of(CLOCK_PROCESS_CPUTIME_ID) : wall_seconds();
  };
  const auto frame_seconds = [&](const PeerWay& way) {
    const double before = now();
    way.frame();
    return now() - before;
  };
  std::vector<PeerRow> rows;
  std::vector<std::vector<double>> taken(ways.size());
  std::vector<double> spent(ways.size());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    spent[i] = frame_seconds(ways[i]);
    const Image picture = ways[i].picture();
    rows.push_back({ways[i].family, ways[i].method, 0, 0, spent[i] >= timings.limit,
                    picture_error(picture, reference)});
    if (timings.say)
      timings.say(fmt::format("{} of {}: {}, {}: {:.3g} s", i + 1, ways.size(), ways[i].family,
                              ways[i].method, spent[i]));
    if (!timings.pictures.empty()) {
      std::string name = ways[i].family + " " + ways[i].method + ".png";
      std::replace(name.begin(), name.end(), '/', '-');
      write_image(picture, std::filesystem::path(timings.pictures) / name);
    }
    if (rows[i].cold) taken[i].push_back(spent[i]);
  }
  for (int round = 0; round < timings.rounds; ++round)
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (!taken[i].empty() && spent[i] >= timings.limit) continue;
      taken[i].push_back(frame_seconds(ways[i]));
      spent[i] += taken[i].back();
    }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    rows[i].seconds = median(taken[i]);
    rows[i].frames = static_cast<int>(taken[i].size());
  }
  return rows;
}

std::string peer_csv(std::span<const PeerRow> rows) {
  std::string text = "method,family,milliseconds,max_error,rms_error\n";
  for (const PeerRow& row : rows)
    text += fmt::format("{},{},{:.3f},{:.3e},{:.3e}\n", row.method, row.family, 1e3 * row.seconds,
                        row.error.largest, row.error.rms);
  return text;
}

std::string peer_table(std::span<const PeerRow> rows) {
  std::vector<std::vector<std::string>> cells{
      {"by", "method", "ms", "x Plume", "largest error", "RMS error", "frames", "not numbers"}};
  for (const PeerRow& row : rows)
    cells.push_back({row.family, row.method, fmt::format("{:.1f}", 1e3 * row.seconds),
                     fmt::format("{:.3g}", row.seconds / rows.front().seconds),
                     fmt::format("{:.1e}", row.error.largest), fmt::format("{:.1e}", row.error.rms),
                     fmt::format("{}{}", row.frames, row.cold ? ", cold" : ""),
                     fmt::format("{}", row.error.not_numbers)});
  return markdown_table(cells);
}

}  // namespace plume::bench
