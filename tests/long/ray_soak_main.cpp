// The long run: plume_ray_soak. See --help.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "hwy/targets.h"
#include "plume/mesh/error.h"
#include "plume/tests/long/ray_soak.h"
#include "plume/tests/long/soak_meshes.h"
#include "plume/traverse/packets.h"

namespace {

using plume::test::SoakTally;

constexpr const char* kHelp =
    R"(plume_ray_soak: rays by the million through bad meshes

  --rays=N      rays over all meshes (1,000,000); half of them aimed at vertices, along edges and
                in the planes of faces
  --seed=S      which rays (1)
  --threads=T   (1); the outcome is the same for any number

Checks that no ray is lost, that packets of rays meet the cells of their scalar twin in its order,
with every instruction set at hand, that sixteen rays looked at together come in where each alone
does, that rays turned around go back the way they came, and that lengths sum up to the chord. Meshes are of tetrahedra, of hexahedra in curvilinear grids, of mixed
cells and of rectilinear grids; `--form=NAME` takes those of one form: tetrahedra, grid, cells or
rectilinear. Ends with 1 where any of that fails. The blunt fin is read from the
directory PLUME_DATASETS, by default ../shared/datasets.
)";

constexpr std::uint64_t kBatch = 4096;

struct Options {
  std::uint64_t rays = 1000000, seed = 1, threads = 1;
  std::string form;
};

// One instruction set of each name: those that were not compiled fall back on others.
std::vector<std::int64_t> instruction_sets() {
  std::vector<std::int64_t> sets;
  std::vector<std::string> names;
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
    plume::limit_packet_instruction_sets(all & -all);
    const std::string name = plume::packet_instruction_set();
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    names.push_back(name);
    sets.push_back(all & -all);
  }
  return sets;
}

// `rays` rays through a mesh, shared out to the instruction sets in turn.
SoakTally soak_mesh(const plume::test::SoakMesh& mesh, const Options& options, std::uint64_t rays,
                    const std::vector<std::int64_t>& sets) {
  SoakTally total;
  const std::uint64_t batches = (rays + kBatch - 1) / kBatch;
  for (std::size_t set = 0; set < sets.size(); ++set) {
    plume::limit_packet_instruction_sets(sets[set]);
    std::vector<SoakTally> tallies(options.threads);
    std::atomic<std::uint64_t> next = set;
    std::vector<std::thread> workers;
    for (SoakTally& tally : tallies)
      workers.emplace_back([&] {
        for (std::uint64_t b = next.fetch_add(sets.size()); b < batches;
             b = next.fetch_add(sets.size()))
          tally.add(mesh.soak(options.seed, b, std::min(kBatch, rays - b * kBatch)));
      });
    for (std::thread& worker : workers) worker.join();
    for (const SoakTally& tally : tallies) total.add(tally);
  }
  return total;
}

void print(const std::string& name, const SoakTally& t, bool chord, double seconds) {
  fmt::print("{:<23}{:>11}{:>9}{:>12}{:>14}{:>6}{:>8}{:>7}{:>8}{:>7}{:>9}{:>9}{:>8.0f}\n", name,
             t.rays, t.aimless, t.passages, t.cells, t.lost, t.contradictions, t.different,
             t.one_way, t.off_length, chord ? fmt::format("{:.1e}", t.worst_twin) : "-",
             chord ? fmt::format("{:.1e}", t.worst_packets) : "-", seconds);
  std::fflush(stdout);
}

int run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto sets = instruction_sets();
  std::vector<plume::test::SoakSource> sources;
  for (const auto& source : plume::test::soak_sources())
    if (options.form.empty() || options.form == source.form) sources.push_back(source);
  fmt::print("{:<23}{:>11}{:>9}{:>12}{:>14}{:>6}{:>8}{:>7}{:>8}{:>7}{:>9}{:>9}{:>8}\n", "mesh",
             "rays", "aimless", "passages", "cells", "lost", "contra", "packet", "turned", "length",
             "worst", "packets'", "seconds");
  SoakTally total;
  const auto start = Clock::now();
  auto since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto begin = Clock::now();
    std::optional<plume::Mesh> mesh = sources[s].load();
    if (!mesh) continue;
    const auto made =
        plume::test::make_soak_mesh(sources[s].name, std::move(*mesh), sources[s].fills_bounds);
    // What is left, shared among the meshes that are left.
    const std::uint64_t rays =
        (options.rays - std::min(options.rays, total.rays)) / (sources.size() - s);
    const SoakTally tally = soak_mesh(*made, options, rays, sets);
    print(sources[s].name, tally, sources[s].fills_bounds, since(begin));
    if (!tally.problem.empty()) fmt::print("  {}\n", tally.problem);
    total.add(tally);
  }
  print("all", total, true, since(start));
  fmt::print("\n{} failures; instruction sets:", total.failures());
  for (const std::int64_t set : sets) {
    plume::limit_packet_instruction_sets(set);
    fmt::print(" {}", plume::packet_instruction_set());
  }
  fmt::print("\n");
  return total.failures() == 0 && total.passages > 0 ? 0 : 1;
}

// False where the argument is not `--name=number`.
bool take(const std::string& argument, const std::string& name, std::uint64_t& value) {
  const std::string front = "--" + name + "=";
  if (argument.rfind(front, 0) != 0) return false;
  char* end = nullptr;
  value = std::strtoull(argument.c_str() + front.size(), &end, 10);
  return end != argument.c_str() + front.size() && *end == '\0';
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (take(argument, "rays", options.rays) || take(argument, "seed", options.seed) ||
        take(argument, "threads", options.threads))
      continue;
    if (argument.rfind("--form=", 0) == 0) {
      options.form = argument.substr(7);
      continue;
    }
    std::fputs(kHelp, argument == "--help" ? stdout : stderr);
    return argument == "--help" ? 0 : 2;
  }
  if (options.rays == 0 || options.threads == 0) {
    std::fputs(kHelp, stderr);
    return 2;
  }
  try {
    return run(options);
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_ray_soak: %s\n", error.what());
    return 1;
  }
}
