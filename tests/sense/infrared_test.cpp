// SPDX-License-Identifier: Apache-2.0
#include "sense/infrared.hpp"

#include "room.hpp"

namespace clew::sense {
namespace {

constexpr domain::InfraredCurve kCurve;

const Infrared& rangers() {
  static const Infrared infrared({}, kRadius_m);
  return infrared;
}

TEST(Infrared, LooksLeftAheadRightAndBack) {
  // Walls 0.3 m to the left of the skin and 0.5 m behind it.
  const world::World room = make_room("walls: [[0, 10.45, 20, 10.45], [9.35, 0, 9.35, 20]]");

  const domain::Scan scan = measure(rangers(), room, {10, 10, 0});

  expect_layout(rangers(), scan);
  ASSERT_EQ(scan.ranges_m.size(), 4u);
  EXPECT_NEAR(scan.ranges_m[0], 0.3, 0.01);
  EXPECT_EQ(scan.ranges_m[1], 0.8);
  EXPECT_EQ(scan.ranges_m[2], 0.8);
  EXPECT_NEAR(scan.ranges_m[3], 0.5, 0.02);
}

TEST(Infrared, AnswersAsTheDataSheetSaysAtBothItsPoints) {
  // S = 75 at 0.8 m, 75 + 58 at 0.2 m; I = 255 - S.
  EXPECT_EQ(kCurve.reading(0.8), 255.0 - 75.0);
  EXPECT_EQ(kCurve.reading(0.2), 255.0 - 133.0);
}

TEST(Infrared, ReadingsRiseWithTheDistanceAndAreBytes) {
  double before = 0.0;
  for (double distance_m = 0.1; distance_m <= 0.8; distance_m += 0.01) {
    const double reading = kCurve.reading(distance_m);
    EXPECT_GE(reading, before) << distance_m;
    EXPECT_EQ(reading, static_cast<double>(static_cast<int>(reading)));
    EXPECT_LE(reading, 255.0);
    before = reading;
  }
}

TEST(Infrared, AReadingStandsForADistanceWithinItsStep) {
  for (double distance_m = 0.1; distance_m <= 0.8; distance_m += 0.003) {
    const double recovered_m = rangers().distance_m(kCurve.reading(distance_m));

    // Half a unit of S is d^2 / (2 K_g) of distance, a little more on the far side.
    EXPECT_NEAR(recovered_m, distance_m, 0.51 * distance_m * distance_m / 15.467 * 1.05);
    // Recovering the reading from the scan loses nothing.
    EXPECT_EQ(kCurve.reading(recovered_m), kCurve.reading(distance_m)) << distance_m;
  }
}

TEST(Infrared, ScanCarriesOnlyDistancesThatAByteCanTell) {
  const world::World room = make_room("walls: [[10.9, 0, 10.9, 20]]");

  // 0.75 m: S = 55.67 + 15.467 / 0.75 = 76.3, so 76, which stands for 15.467 / 20.33 m.
  EXPECT_NEAR(measure(rangers(), room, {10, 10, 0}).ranges_m[1], 15.467 / 20.33, 1e-9);
}

TEST(Infrared, StaysAtItsLeastBelowItsRange) {
  const world::World room = make_room("walls: [[10.2, 0, 10.2, 20]]");

  const domain::Scan scan = measure(rangers(), room, {10, 10, 0});

  EXPECT_EQ(scan.range_min_m, 0.1);
  EXPECT_NEAR(scan.ranges_m[1], 0.1, 0.001);
}

}  // namespace
}  // namespace clew::sense
