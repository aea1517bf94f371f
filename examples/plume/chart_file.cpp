#include "chart_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "plume/lib/version.h"
#include "plume/mesh/error.h"

namespace plume::command {
namespace {

constexpr std::array<const char*, 5> kColumns{"method", "family", "milliseconds", "max_error",
                                              "rms_error"};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"') made += '"';
    made += c;
  }
  return made + '"';
}

std::string line_of(const ChartPoint& point, const std::string& dominated_by) {
  return fmt::format("{},{},{},{},{},{}\n", quoted(point.method), quoted(point.family),
                     point.milliseconds, point.max_error, point.rms_error, quoted(dominated_by));
}

// Goes through the records of a text, fields by commas, quoted ones as in RFC 4180.
class Records {
 public:
  Records(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  bool next() {
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) skip_line_end();
    if (at_ >= text_.size()) return false;
    line_ = next_line_;
    fields_.clear();
    for (;;) {
      fields_.push_back(field());
      if (at_ >= text_.size() || text_[at_] != ',') break;
      ++at_;
    }
    return true;
  }
  const std::vector<std::string>& fields() const { return fields_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}, line {}: {}", file_, line_, what));
  }

 private:
  void skip_line_end() {
    if (text_[at_] == '\n') ++next_line_;
    ++at_;
  }
  std::string field() {
    std::string made;
    if (at_ < text_.size() && text_[at_] == '"') {
      for (++at_;; ++at_) {
        if (at_ >= text_.size()) fail("a quotation mark is not closed");
        if (text_[at_] == '\n') ++next_line_;
        if (text_[at_] == '"') {
          if (at_ + 1 < text_.size() && text_[at_ + 1] == '"')
            ++at_;
          else
            break;
        }
        made += text_[at_];
      }
      ++at_;
      if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
        fail("text after a closing quotation mark");
      return made;
    }
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
      made += text_[at_++];
    return made;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1, next_line_ = 1;
  std::vector<std::string> fields_;
};

double parse_number(const Records& records, const char* column, const std::string& text,
                    bool positive) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end || !std::isfinite(value) || value < 0 ||
      (positive && value == 0))
    records.fail(fmt::format("'{}' in the column {} is no {} number", text, column,
                             positive ? "positive" : "non-negative"));
  return value;
}

nlohmann::json to_json(const ChartPoint& point) {
  return {{"method", point.method},
          {"family", point.family},
          {"milliseconds", point.milliseconds},
          {"max_error", point.max_error},
          {"rms_error", point.rms_error}};
}

nlohmann::json method_or_null(const std::vector<ChartPoint>& points,
                              const std::optional<std::size_t>& number) {
  return number ? nlohmann::json(points[*number].method) : nlohmann::json();
}

nlohmann::json to_json(const Chart& chart, std::size_t i) {
  const MeasuredWay& way = chart.ways[i];
  nlohmann::json one = to_json(way.point);
  one["frames"] = way.frames;
  one["in_turns"] = way.in_turns;
  one["milliseconds_range"] = {way.fastest, way.slowest};
  one["kind"] = name_of(way.way.kind);
  one["dominated_by"] = method_or_null(chart.points, chart.dominators[i]);
  if (way.table_ms > 0) one["table_milliseconds"] = way.table_ms;
  if (way.way.tolerance) {
    one["tolerance"] = *way.way.tolerance;
    one["planning_milliseconds"] = way.way.planning;
  }
  return one;
}

nlohmann::json to_json(const PeerFamily& family, const std::vector<ChartPoint>& ours) {
  auto points = nlohmann::json::array(), factors = nlohmann::json::array();
  for (const ChartPoint& point : family.points) points.push_back(to_json(point));
  for (const PeerFactor& at : family.factors)
    factors.push_back({{"error", at.error},
                       {"ours", method_or_null(ours, at.ours)},
                       {"theirs", method_or_null(family.points, at.theirs)},
                       {"factor", at.factor ? nlohmann::json(*at.factor) : nlohmann::json()}});
  return {{"family", family.name}, {"points", points}, {"factors", factors}};
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string text = fmt::format("{},dominated_by\n", fmt::join(kColumns, ","));
  for (std::size_t i = 0; i < chart.points.size(); ++i)
    text += line_of(chart.points[i],
                    chart.dominators[i] ? chart.points[*chart.dominators[i]].method : "");
  for (const PeerFamily& family : chart.peers)
    for (const ChartPoint& point : family.points) {
      const auto better = fastest_within(chart.points, point.max_error);
      text += line_of(point, better && dominates(chart.points[*better], point)
                                 ? chart.points[*better].method
                                 : "");
    }
  return text;
}

std::vector<ChartPoint> parse_chart_csv(std::string_view text, const std::string& file) {
  Records records(text, file);
  if (!records.next())
    throw Error(
        fmt::format("{}: empty; the first line must be {}", file, fmt::join(kColumns, ",")));
  std::array<std::size_t, kColumns.size()> place{};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const auto& names = records.fields();
    const auto at = std::find(names.begin(), names.end(), kColumns[c]);
    if (at == names.end())
      records.fail(fmt::format("no column '{}'; the first line must be {}", kColumns[c],
                               fmt::join(kColumns, ",")));
    place[c] = static_cast<std::size_t>(at - names.begin());
  }
  const std::size_t width = records.fields().size();
  std::vector<ChartPoint> points;
  while (records.next()) {
    const auto& fields = records.fields();
    if (fields.size() != width)
      records.fail(fmt::format("{} fields instead of {}", fields.size(), width));
    const auto number = [&](std::size_t c, bool positive) {
      return parse_number(records, kColumns[c], fields[place[c]], positive);
    };
    if (fields[place[1]].empty()) records.fail("no family");
    points.push_back(
        {fields[place[0]], fields[place[1]], number(2, true), number(3, false), number(4, false)});
  }
  return points;
}

std::vector<ChartPoint> read_chart_csv(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("--also '{}': cannot be read", file));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw Error(fmt::format("--also '{}': cannot be read", file));
  std::vector<ChartPoint> points = parse_chart_csv(text, file);
  for (ChartPoint& point : points)
    if (point.family == "plume")
      point.family = fmt::format("plume ({})", std::filesystem::path(file).stem().string());
  return points;
}

std::string chart_json(const Chart& chart) {
  const ChartSubject& subject = chart.subject;
  auto ways = nlohmann::json::array(), front = nlohmann::json::array(),
       peers = nlohmann::json::array();
  for (std::size_t i = 0; i < chart.ways.size(); ++i) ways.push_back(to_json(chart, i));
  for (const std::size_t i : chart.front) front.push_back(chart.points[i].method);
  for (const PeerFamily& family : chart.peers) peers.push_back(to_json(family, chart.points));
  return nlohmann::json{{"plume", version()},
                        {"date", subject.date},
                        {"mesh", subject.mesh},
                        {"form", subject.form},
                        {"cells", subject.cells},
                        {"field", subject.field},
                        {"size", {subject.width, subject.height}},
                        {"camera", subject.camera},
                        {"threads", subject.threads},
                        {"processor", subject.processor},
                        {"rounds", subject.rounds},
                        {"time", subject.on_processor ? "processor" : "clock"},
                        {"reference_seconds", chart.reference_seconds},
                        {"ways", ways},
                        {"front", front},
                        {"peers", peers}}
             .dump(2) +
         "\n";
}

}  // namespace plume::command
