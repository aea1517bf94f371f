#include "plume/mesh/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plume {

void add_example(Finding& finding, std::size_t cell) {
  constexpr std::size_t kExamples = 5;
  ++finding.count;
  auto& list = finding.examples;
  list.insert(std::upper_bound(list.begin(), list.end(), cell), cell);
  if (list.size() > kExamples) list.pop_back();
}

std::string describe(const Finding& finding) {
  std::string text = fmt::format("{} {}", finding.count, finding.what);
  if (!finding.examples.empty())
    text += fmt::format("{} {}", finding.examples.size() < finding.count ? ", among them" : ":",
                        fmt::join(finding.examples, ", "));
  return text;
}

}  // namespace plume
