/// Names of files with a number in them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace plume {

/// A name with a place for a number, as printf() has it: "frame_%04d.png". The place is %d, or %0Nd
/// for at least N digits (1 to 18) with leading zeros; %% is a percent sign.
class NumberedName {
 public:
  /// Nothing where the text has no such place. Throws Error where it has two.
  static std::optional<NumberedName> in(const std::string& text);

  /// The name with that number.
  std::string at(std::uint64_t number) const;
  /// The number that `name` was made with; nothing where at() makes no such name.
  std::optional<std::uint64_t> number_in(const std::string& name) const;

  const std::string& before() const { return before_; }
  const std::string& after() const { return after_; }

 private:
  std::string before_, after_;
  int digits_ = 1;
};

/// Whether `a` comes before `b` where digits that stand together count as one number: "t9" before
/// "t10".
bool natural_less(const std::string& a, const std::string& b);

}  // namespace plume
