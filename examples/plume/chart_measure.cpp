#include "chart_measure.h"

#include <algorithm>
#include <ctime>
#include <utility>

#include "plume/lib/picture_error.h"
#include "plume/lib/planner.h"
#include "stopwatch.h"

namespace plume::command {
namespace {

constexpr double kSlow = 2000;  // milliseconds a frame
constexpr int kRoundsOfSlow = 3;

bool has_table(const ChartWay& way) {
  return way.kind == WayKind::table || way.kind == WayKind::second_order_table;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

class Measurer {
 public:
  Measurer(const Scene& scene, const Camera& camera, const RenderSettings& base,
           std::vector<ChartWay> ways, int rounds,
           const std::function<void(const ChartProgress&)>& progress)
      : scene_(scene), camera_(camera), base_(base), rounds_(rounds), progress_(progress) {
    for (ChartWay& way : ways) {
      result_.ways.push_back({});
      result_.ways.back().way = std::move(way);
    }
    result_.on_processor = base.threads == 1;
    times_.resize(result_.ways.size());
    first_.resize(result_.ways.size());
  }

  ChartMeasurement run() {
    Stopwatch watch;
    const Image reference = render(scene_, camera_, reference_settings(base_), [&](double share) {
                              tell({"the reference", share * kShareOfReference, {}});
                              return true;
                            }).image;
    result_.reference_seconds = watch.lap() / 1000;
    for (std::size_t i = 0; i < result_.ways.size(); ++i) measure_first(i, reference);
    for (std::size_t i = 0; i < result_.ways.size(); ++i)
      if (result_.ways[i].in_turns) left_ += rounds_of(i) * cost(i);
    const double all = left_;
    for (int round = 0; round < rounds_; ++round)
      for (std::size_t i = 0; i < result_.ways.size(); ++i) {
        if (round >= rounds_of(i) || !result_.ways[i].in_turns) continue;
        tell({result_.ways[i].way.name, kShareOfFirst + (1 - kShareOfFirst) * (1 - left_ / all),
              left_ / 1000});
        build_table(i);
        times_[i].push_back(frame(i));
        left_ -= cost(i);
      }
    tell({"done", 1, 0.0});
    for (std::size_t i = 0; i < result_.ways.size(); ++i) conclude(result_.ways[i], times_[i]);
    return std::move(result_);
  }

 private:
  // Of the progress bar, before anything is known of how long ways take.
  static constexpr double kShareOfReference = 0.05, kShareOfFirst = 0.2;

  void tell(const ChartProgress& at) const {
    if (progress_) progress_(at);
  }

  // Milliseconds for the way's table, where the last one that was built is another.
  double build_table(std::size_t i) const {
    if (!has_table(result_.ways[i].way)) return 0;
    RenderSettings settings = result_.ways[i].way.settings;
    settings.window = PixelWindow{};
    Stopwatch watch;
    render(scene_, camera_, settings);
    return watch.lap();
  }

  Image picture_of(std::size_t i) const {
    const ChartWay& way = result_.ways[i].way;
    return way.draw ? way.draw(way.settings) : render(scene_, camera_, way.settings).image;
  }

  void measure_first(std::size_t i, const Image& reference) {
    MeasuredWay& measured = result_.ways[i];
    const double ways = static_cast<double>(result_.ways.size());
    tell({measured.way.name,
          kShareOfReference + (kShareOfFirst - kShareOfReference) * static_cast<double>(i) / ways,
          {}});
    measured.table_ms = build_table(i);
    Stopwatch watch;
    const Image picture = picture_of(i);
    first_[i] = watch.lap();
    const PictureError error = picture_error(picture, reference);
    measured.point = {measured.way.name, "plume", 0,
                      error.not_numbers > 0 ? std::max(1.0, error.largest) : error.largest,
                      error.rms};
    if (measured.table_ms < rounds_ * first_[i]) return;
    measured.in_turns = false;
    for (int round = 0; round < rounds_of(i); ++round) times_[i].push_back(frame(i));
  }

  // Milliseconds for one; see measure_ways() for which.
  double frame(std::size_t i) const {
    if (result_.on_processor) {
      const std::clock_t start = std::clock();
      picture_of(i);
      return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    Stopwatch watch;
    picture_of(i);
    return watch.lap();
  }

  double cost(std::size_t i) const { return first_[i] + result_.ways[i].table_ms; }
  int rounds_of(std::size_t i) const {
    return first_[i] > kSlow ? std::min(rounds_, kRoundsOfSlow) : rounds_;
  }

  static void conclude(MeasuredWay& measured, const std::vector<double>& times) {
    measured.frames = static_cast<int>(times.size());
    measured.point.milliseconds = median(times);
    const auto [fastest, slowest] = std::minmax_element(times.begin(), times.end());
    measured.fastest = *fastest;
    measured.slowest = *slowest;
  }

  const Scene& scene_;
  const Camera& camera_;
  const RenderSettings& base_;
  const int rounds_;
  const std::function<void(const ChartProgress&)>& progress_;
  ChartMeasurement result_;
  std::vector<std::vector<double>> times_;  // of ways, by round
  std::vector<double> first_;               // frame's time of each way
  double left_ = 0;                         // milliseconds, as the first frames took
};

}  // namespace

ChartMeasurement measure_ways(const Scene& scene, const Camera& camera, const RenderSettings& base,
                              std::vector<ChartWay> ways, int rounds,
                              const std::function<void(const ChartProgress&)>& progress) {
  return Measurer(scene, camera, base, std::move(ways), rounds, progress).run();
}

}  // namespace plume::command
