#include "parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "plume/mesh/error.h"

namespace plume::command {
namespace {

template <class T>
bool read_whole(const std::string& text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  const std::vector<std::size_t>& counts) {
  std::vector<double> numbers;
  bool good = true;
  for (std::size_t begin = 0; good && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    good = read_whole(text.substr(begin, end - begin), value) && std::isfinite(value);
    numbers.push_back(value);
    begin = end + 1;
  }
  if (!good || std::find(counts.begin(), counts.end(), numbers.size()) == counts.end())
    throw Error(fmt::format("{} '{}': expected {} numbers separated by commas", option, text,
                            fmt::join(counts, " or ")));
  return numbers;
}

PictureSize parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  PictureSize size{0, 0};
  const bool good = x != std::string::npos && read_whole(text.substr(0, x), size.width) &&
                    read_whole(text.substr(x + 1), size.height);
  auto in_range = [](int pixels) { return pixels >= 1 && pixels <= 65536; };
  if (!good || !in_range(size.width) || !in_range(size.height))
    throw Error(fmt::format(
        "--size '{}': expected WIDTHxHEIGHT in pixels, each 1 to 65536, such as 1024x768", text));
  return size;
}

}  // namespace plume::command
