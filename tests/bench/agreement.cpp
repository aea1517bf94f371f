#include "plume/tests/bench/agreement.h"

#include <fmt/format.h>

#include <cmath>

namespace plume::bench {

Agreement compare(const BenchMesh& mesh, Mode mode, std::span<const PassageSum> reference,
                  std::span<const PassageSum> sums) {
  float first = 2e-3f, second = 2e-3f;
  if (mode == Mode::closed_form) {
    first = second = 1e-4f;
  } else if (mode != Mode::volume) {
    first = static_cast<float>(1e-4 * mesh.bounds.diagonal());
    second = first * mesh.scalar_size;
  }
  Agreement agreement;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const PassageSum& a = reference[i];
    const PassageSum& b = sums[i];
    // Said so that a NaN is different.
    const bool alike =
        std::abs(a.first - b.first) <= first && std::abs(a.second - b.second) <= second;
    if (!alike)
      agreement.different.push_back(static_cast<std::uint32_t>(i));
    else if (a.cells != b.cells)
      ++agreement.other_way;
    else
      ++agreement.same;
  }
  return agreement;
}

std::string problem(const BenchWalker& walker, Mode mode, const Agreement& agreement) {
  const std::size_t astray = agreement.other_way + agreement.different.size();
  const double allowed = walker.exact ? (mode == Mode::isosurface ? 1e-4 : 0) : 1e-2;
  if (static_cast<double>(astray) <= allowed * static_cast<double>(agreement.total())) return {};
  return fmt::format(
      "{} does not do the work of {} ({}): of {} passages, {} meet another number of cells and {} "
      "come to other sums{}",
      walker.name, reference().name, mode_name(mode), agreement.total(), agreement.other_way,
      agreement.different.size(),
      agreement.different.empty() ? "" : fmt::format(", the first is {}", agreement.different[0]));
}

Agreement drop_lost(const BenchMesh& mesh, std::vector<BenchView>& views) {
  Agreement of_baseline;
  for (BenchView& view : views)
    for (const BenchWalker& walker : walkers()) {
      if (walker.exact) continue;
      std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
      reference().walk(mesh, view, Mode::integral, right);
      walker.walk(mesh, view, Mode::integral, sums);
      const Agreement agreement = compare(mesh, Mode::integral, right, sums);
      for (std::size_t i = agreement.different.size(); i-- > 0;)
        view.passages.erase(view.passages.begin() +
                            static_cast<std::ptrdiff_t>(agreement.different[i]));
      if (&walker != &baseline()) continue;
      of_baseline.same += agreement.same;
      of_baseline.other_way += agreement.other_way;
      of_baseline.different.insert(of_baseline.different.end(), agreement.different.begin(),
                                   agreement.different.end());
    }
  return of_baseline;
}

}  // namespace plume::bench
