/// What the soaks of all walkers share: ways through cells as numbers, and chords.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/tests/long/ray_soak.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/traverse/packets.h"

namespace plume::test {

/// The cells of a passage in their order, and in the reverse order, as one number each: polynomials
/// modulo 2^64, so that neither way needs the cells to be kept.
struct Way {
  std::uint64_t forth = 0, back = 0, power = 1;
  std::uint64_t cells = 0;
  double length = 0;

  void add(std::uint32_t cell) {
    std::uint64_t mixed = (cell + 1) * 0x9E3779B97F4A7C15ull;
    mixed ^= mixed >> 29;
    constexpr std::uint64_t kBase = 0xD1342543DE82EF95ull;
    forth = forth * kBase + mixed;
    back += mixed * power;
    power *= kBase;
    ++cells;
  }
};

/// Hands out starts, each once.
template <class Start>
class Starts : public PacketFeeder {
 public:
  explicit Starts(const std::vector<Start>& starts) : starts_(starts) {}
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }

 private:
  const std::vector<Start>& starts_;
  std::size_t at_ = 0;
};

class PacketWays : public PacketSegmentSink {
 public:
  explicit PacketWays(std::size_t passages) : ways(passages) {}
  void take(const PacketSegment& segment) override {
    ways[segment.ray].add(segment.cell);
    ways[segment.ray].length += static_cast<double>(segment.length);
  }
  std::vector<Way> ways;
};

/// Whether a sum is the chord, and how far from it.
class Chord {
 public:
  Chord(const Bounds& bounds, const Ray& ray) : bounds_(bounds), ray_(ray) {
    chord_ = reference::box_chord(bounds.low, bounds.high, ray.origin, ray.direction);
    const auto range = of(kTwinSlack);
    well_defined_ = range[0] > 0 && range[1] - range[0] < 2e-5 * bounds.diagonal();
  }
  bool holds(double sum, double slack) const {
    const auto range = of(slack);
    return sum >= range[0] && sum <= range[1];
  }
  double error(double sum) const {
    return well_defined_ ? std::abs(sum - chord_) / bounds_.diagonal() : 0;
  }

 private:
  std::array<double, 2> of(double slack) const {
    return reference::box_chord_range(bounds_.low, bounds_.high, ray_.origin, ray_.direction,
                                      slack * bounds_.diagonal());
  }
  const Bounds& bounds_;
  const Ray& ray_;
  double chord_;
  bool well_defined_;
};

/// Counts failures and keeps the first in words.
class Failures {
 public:
  Failures(SoakTally& tally, const std::string& mesh, std::uint64_t seed, std::uint64_t batch)
      : tally_(tally), mesh_(mesh), seed_(seed), batch_(batch) {}

  void operator()(std::uint64_t& count, std::uint64_t ray, const char* what) {
    ++count;
    if (tally_.problem.empty())
      tally_.problem = "mesh '" + mesh_ + "', seed " + std::to_string(seed_) + ", batch " +
                       std::to_string(batch_) + ", ray " + std::to_string(ray) + ": " + what +
                       " (packets: " + packet_instruction_set() + ")";
  }

 private:
  SoakTally& tally_;
  const std::string& mesh_;
  std::uint64_t seed_, batch_;
};

}  // namespace plume::test
