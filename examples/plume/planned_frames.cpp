#include "planned_frames.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "plume/io/numbered_name.h"
#include "plume/mesh/error.h"

namespace plume::command {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Error(fmt::format(
      "--time '{}': it is all, last, a step's number from 0, or FIRST:LAST[:STRIDE]", text));
}

std::optional<std::size_t> number(const std::string& part, const std::string& text) {
  if (part.empty()) return std::nullopt;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc{} || end != part.data() + part.size()) refuse(text);
  return value;
}

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

}  // namespace

std::vector<std::size_t> parse_steps(const std::string& text, const TimeSeries& series,
                                     const std::string& name) {
  const std::size_t last = series.size() - 1;
  const auto there = [&](std::size_t step) {
    if (step > last)
      throw Error(
          fmt::format("{}: there is no time step {}; choose one from 0 to {}", name, step, last));
    return step;
  };
  if (text.empty() || text == "last") return {last};
  const auto parts = text == "all" ? std::vector<std::string>{"", ""} : parts_of(text);
  if (parts.size() > 3) refuse(text);
  if (parts.size() == 1) return {there(*number(parts[0], text))};
  const std::size_t from = there(number(parts[0], text).value_or(0));
  const std::size_t to = there(number(parts[1], text).value_or(last));
  const std::size_t stride = parts.size() == 3 ? number(parts[2], text).value_or(0) : 1;
  if (stride == 0) refuse(text);
  if (from > to)
    throw Error(fmt::format("--time '{}': the first step must not come after the last", text));
  std::vector<std::size_t> steps{from};
  while (to - steps.back() >= stride) steps.push_back(steps.back() + stride);
  return steps;
}

std::vector<PlannedFrame> plan_frames(const RenderArguments& args, const TimeSeries& series) {
  const std::vector<std::size_t> steps = parse_steps(args.time, series, args.mesh);
  const auto turn = static_cast<std::size_t>(args.orbit);
  const std::size_t count = turn > 0 ? turn : steps.size();
  if (count < steps.size())
    throw Error(
        fmt::format("--orbit {}: fewer frames than the {} time steps; give at least {}, or --time "
                    "with a stride",
                    count, steps.size(), steps.size()));
  const auto numbered = NumberedName::in(args.output);
  if (count > 1 && !numbered)
    throw Error(fmt::format(
        "{}: {} frames need a place for their number; name them with %d, such as frame_%04d.png",
        args.output, count));
  std::vector<PlannedFrame> frames;
  for (std::size_t i = 0; i < count; ++i)
    frames.push_back({steps[i * steps.size() / count],
                      turn > 0 ? 360.0 * static_cast<double>(i) / static_cast<double>(turn) : 0.0,
                      numbered ? numbered->at(i) : args.output});
  return frames;
}

std::string first_output(const std::string& output) {
  const auto numbered = NumberedName::in(output);
  return numbered ? numbered->at(0) : output;
}

}  // namespace plume::command
