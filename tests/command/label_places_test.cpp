#include "plume/examples/plume/label_places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plume/tests/preint/seeded_rapidcheck.h"

namespace plume::command {
namespace {

// Places in steps of so many pixels, and widths.
double pixels(int most) { return static_cast<double>(*rc::gen::inRange(0, most)); }

RC_GTEST_PROP(LabelPlaces, FrontLabelsAreClearOfEachOtherAndOfTheFrontsPoints, ()) {
  const int count = *rc::gen::inRange(1, 15);
  std::vector<ChartPlace> points;
  std::vector<double> widths;
  ChartPlace at{400, 50};
  for (int i = 0; i < count; ++i) {
    at = {at.x + pixels(60), at.y + pixels(60)};
    points.push_back(at);
    widths.push_back(20 + pixels(200));
  }
  const auto boxes = front_label_places(points, widths, 14, 8);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    RC_ASSERT(boxes[i].left + boxes[i].width <= points[i].x - 8 + 1e-9);
    RC_ASSERT(boxes[i].top + boxes[i].height / 2 >= points[i].y - 1e-9);
    for (std::size_t k = 0; k < i; ++k) RC_ASSERT(!overlap(boxes[i], boxes[k]));
  }
}

TEST(LabelPlaces, OthersAreClearOfWhatIsTakenWhereThereIsRoom) {
  const LabelBox area{0, 0, 400, 400};
  std::vector<LabelBox> taken{{200, 190, 60, 20}};  // to the right of the first point
  const auto boxes = label_places({{195, 200}, {50, 50}}, {20, 20}, 10, 4, area, taken);
  ASSERT_EQ(boxes.size(), 2u);
  for (const LabelBox& box : boxes) EXPECT_FALSE(overlap(box, {200, 190, 60, 20}));
  EXPECT_FALSE(overlap(boxes[0], boxes[1]));
  EXPECT_EQ(taken.size(), 3u);
  EXPECT_DOUBLE_EQ(boxes[1].left, 54);  // nothing in its way: to the right
}

TEST(LabelPlaces, StayInsideOfTheArea) {
  const LabelBox area{0, 0, 100, 100};
  std::vector<LabelBox> taken;
  for (const LabelBox& box : label_places({{98, 98}, {2, 2}}, {30, 30}, 10, 4, area, taken)) {
    EXPECT_GE(box.left, 0);
    EXPECT_GE(box.top, 0);
    EXPECT_LE(box.left + box.width, 100);
    EXPECT_LE(box.top + box.height, 100);
  }
}

}  // namespace
}  // namespace plume::command
