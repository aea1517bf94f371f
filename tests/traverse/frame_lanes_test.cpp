// Sixteen frames made side by side are those made one by one, whatever the instruction set.

#include "plume/traverse/frame_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "hwy/targets.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

// Directions near to an axis, of any axis, along two at once, and no directions at all.
Ray make_ray(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Ray ray;
  const double reach = std::exp2(20 * number(random));
  for (auto& o : ray.origin) o = reach * number(random);
  for (auto& d : ray.direction) d = number(random);
  const auto axis = static_cast<std::size_t>(random() % 3);
  switch (random() % 8) {
    case 0:
      ray.direction = {0, 0, 0};
      ray.direction[axis] = random() % 2 ? 1 : -1;
      break;
    case 1:
      ray.direction[axis] = -ray.direction[(axis + 1) % 3];
      break;
    case 2: {
      constexpr double kNone[] = {0, std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN(), 1e-310};
      const double value = kNone[random() % 4];
      if (random() % 2)
        ray.direction = {value, value, value};
      else
        ray.direction[axis] = value;
      break;
    }
    case 3:
      ray.origin[axis] = std::numeric_limits<double>::infinity();
      break;
    default:
      break;
  }
  return ray;
}

class FrameLanesOnTargets : public testing::Test {
 protected:
  ~FrameLanesOnTargets() override { limit_packet_instruction_sets(0); }

  template <class Check>
  static void on_every_target(const Check& check) {
    const std::int64_t all = hwy::SupportedTargets();
    for (std::int64_t target = all & -all, rest = all; rest != 0;
         rest &= rest - 1, target = rest & -rest) {
      SCOPED_TRACE(hwy::TargetName(target));
      limit_packet_instruction_sets(target);
      check();
    }
  }
};

TEST_F(FrameLanesOnTargets, AreThoseOfSingleRays) {
  on_every_target([] {
    std::mt19937_64 random(3);
    LocalFrame local;
    local.center = {0.3, -17.5, 1e-3};
    local.scale = 0.125;
    std::size_t valid = 0;
    for (int group = 0; group < 400; ++group) {
      RayLanes rays;
      const std::size_t size = 1 + random() % RayLanes::kRays;
      while (rays.size < size) rays.add(make_ray(random));
      FrameLanes lanes;
      lanes.set(rays, local);
      ASSERT_EQ(lanes.size(), size);
      for (std::size_t i = 0; i < size; ++i) {
        ShearedFrame expected;
        ASSERT_EQ(lanes.is_valid(i), expected.set(rays.ray(i), local)) << "ray " << i;
        if (!lanes.is_valid(i)) continue;
        ++valid;
        ShearedFrame frame;
        lanes.put(i, frame);
        EXPECT_EQ(frame.axis(), expected.axis());
        EXPECT_EQ(lanes.axis(i), expected.axis());
        EXPECT_EQ(frame.sign(), expected.sign());
        EXPECT_EQ(frame.t_per_z(), expected.t_per_z());
        EXPECT_EQ(frame.t(0), expected.t(0));
        EXPECT_EQ(frame.line().slope_x, expected.line().slope_x);
        EXPECT_EQ(frame.line().slope_y, expected.line().slope_y);
        EXPECT_EQ(frame.line().offset_x, expected.line().offset_x);
        EXPECT_EQ(frame.line().offset_y, expected.line().offset_y);
        float start[3][16], step[3][16];
        lanes.lines({start[0], start[1], start[2]}, {step[0], step[1], step[2]});
        for (std::size_t a = 0; a < 3; ++a) {
          EXPECT_EQ(start[a][i], expected.start()[a]);
          EXPECT_EQ(step[a][i], expected.step()[a]);
        }
      }
    }
    EXPECT_GT(valid, 1500u);
  });
}

}  // namespace
}  // namespace plume::test
