#include "plume/tests/bench/agreement.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace plume::bench {

Agreement compare(const BenchMesh& mesh, Mode mode, std::span<const PassageSum> reference,
                  std::span<const PassageSum> sums, bool lengths_alone) {
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
    const bool alike = std::abs(a.first - b.first) <= first &&
                       (lengths_alone || std::abs(a.second - b.second) <= second);
    if (!alike)
      agreement.different.push_back(static_cast<std::uint32_t>(i));
    else if (a.cells != b.cells)
      ++agreement.other_way;
    else
      ++agreement.same;
  }
  return agreement;
}

std::string problem(const BenchWalker& walker, Family family, Mode mode,
                    const Agreement& agreement) {
  std::size_t astray = agreement.different.size();
  if (walker.likeness != Likeness::surface) astray += agreement.other_way;
  const double allowed =
      walker.likeness == Likeness::exact ? (mode == Mode::isosurface ? 1e-4 : 0) : 1e-2;
  if (static_cast<double>(astray) <= allowed * static_cast<double>(agreement.total())) return {};
  return fmt::format(
      "{} does not do the work of {} ({}): of {} passages, {} meet another number of cells and {} "
      "come to other sums{}",
      walker.name, reference(family).name, mode_name(mode), agreement.total(), agreement.other_way,
      agreement.different.size(),
      agreement.different.empty() ? "" : fmt::format(", the first is {}", agreement.different[0]));
}

std::string problem(const BenchWalker& walker, const BenchMesh& mesh, Mode mode,
                    std::span<const PassageSum> reference, std::span<const PassageSum> sums) {
  const bool other_surface = walker.likeness == Likeness::surface;
  if (!other_surface || mode == Mode::integral)
    return problem(walker, mesh.family, mode, compare(mesh, mode, reference, sums, other_surface));
  auto total = [](std::span<const PassageSum> of) {
    std::array<double, 2> sum{};
    for (const PassageSum& one : of) {
      sum[0] += one.cells;
      sum[1] += one.first;
    }
    return sum;
  };
  const auto right = total(reference), found = total(sums);
  auto alike = [](double a, double b, double within) { return std::abs(a - b) <= within * a; };
  const bool same_end = mode == Mode::isosurface || alike(right[1], found[1], 0.05);
  if (alike(right[0], found[0], 1.0 / 3) && same_end) return {};
  return fmt::format("{} does not do the work of {} ({}): {} cells for {}, a sum of {} for {}",
                     walker.name, plume::bench::reference(mesh.family).name, mode_name(mode),
                     found[0], right[0], found[1], right[1]);
}

Agreement drop_lost(const BenchMesh& mesh, std::vector<BenchView>& views) {
  Agreement of_baseline;
  for (BenchView& view : views)
    for (const BenchWalker& walker : walkers(mesh.family)) {
      if (walker.likeness == Likeness::exact) continue;
      std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
      reference(mesh.family).walk(mesh, view, Mode::integral, right);
      walker.walk(mesh, view, Mode::integral, sums);
      const Agreement agreement =
          compare(mesh, Mode::integral, right, sums, walker.likeness == Likeness::surface);
      view.leave_out(agreement.different);
      if (&walker != &baseline(mesh.family)) continue;
      of_baseline.same += agreement.same;
      of_baseline.other_way += agreement.other_way;
      of_baseline.different.insert(of_baseline.different.end(), agreement.different.begin(),
                                   agreement.different.end());
    }
  return of_baseline;
}

}  // namespace plume::bench
