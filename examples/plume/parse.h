/// Values on the command line.
#pragma once

#include <string>
#include <vector>

namespace plume::command {

/// "1,2.5,-3" as numbers. Throws Error, naming `option` and the text, unless there are as many as
/// one of `counts` and all are finite.
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  const std::vector<std::size_t>& counts);

struct PictureSize {
  int width, height;
};
/// "800x600", both sides 1 to 65536. Throws Error, naming the text.
PictureSize parse_size(const std::string& text);

}  // namespace plume::command
