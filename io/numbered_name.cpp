#include "plume/io/numbered_name.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "plume/mesh/error.h"

namespace plume {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The length of "%d" or "%0Nd" at the text's start, and its N; nothing where it starts otherwise.
struct Place {
  std::size_t length;
  int digits;
};
std::optional<Place> place_at_start(std::string_view text) {
  if (text.starts_with("%d")) return Place{2, 1};
  if (!text.starts_with("%0")) return std::nullopt;
  int digits = 0;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), digits);
  if (error != std::errc{} || end == text.data() + text.size() || *end != 'd') return std::nullopt;
  // 10^18 is the greatest power of ten in 64 bits with a sign.
  if (digits < 1 || digits > 18) return std::nullopt;
  return Place{static_cast<std::size_t>(end - text.data()) + 1, digits};
}

}  // namespace

std::optional<NumberedName> NumberedName::in(const std::string& text) {
  NumberedName name;
  int places = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    std::string& part = places == 0 ? name.before_ : name.after_;
    if (const auto place = place_at_start(rest)) {
      ++places;
      name.digits_ = place->digits;
      i += place->length;
    } else if (rest.starts_with("%%")) {
      part += '%';
      i += 2;
    } else {
      part += text[i++];
    }
  }
  if (places > 1) throw Error(text + ": has two places for a number; leave one %d");
  if (places == 0) return std::nullopt;
  return name;
}

std::string NumberedName::at(std::uint64_t number) const {
  std::string digits = std::to_string(number);
  const auto wanted = static_cast<std::size_t>(digits_);
  if (digits.size() < wanted) digits.insert(0, wanted - digits.size(), '0');
  return before_ + digits + after_;
}

std::optional<std::uint64_t> NumberedName::number_in(const std::string& name) const {
  if (name.size() <= before_.size() + after_.size() || !name.starts_with(before_) ||
      !name.ends_with(after_))
    return std::nullopt;
  const char* const first = name.data() + before_.size();
  const char* const last = name.data() + name.size() - after_.size();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc{} || end != last || at(number) != name) return std::nullopt;
  return number;
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i, ++j;
      continue;
    }
    // Numbers of any length: leading zeros do not count, then the longer one is the greater.
    const auto number_at = [](const std::string& text, std::size_t& at) {
      std::size_t start = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      while (start + 1 < at && text[start] == '0') ++start;
      return std::string_view(text).substr(start, at - start);
    };
    const std::string_view x = number_at(a, i), y = number_at(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // the same but for leading zeros
}

}  // namespace plume
