// SPDX-License-Identifier: Apache-2.0
#include "component/scan_watch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace clew::bridge {
namespace {

using std::chrono::milliseconds;

domain::Scan scan_of(double range_m) {
  domain::Scan scan;
  scan.range_max_m = 1.5;
  scan.ranges_m.assign(7, range_m);
  return scan;
}

/// What a watch says of a tick in which the robot has gone `travel_m`.
std::optional<std::string> show(ScanWatch& watch, std::uint64_t tick, const domain::Scan& scan,
                                double travel_m) {
  runtime::TopicSet present;
  present.set(index_of(domain::Topic::kScan));
  present.set(index_of(domain::Topic::kOdometry));
  domain::Messages messages;
  std::get<domain::Scan>(messages) = scan;
  std::get<domain::Odometry>(messages).travel_m = travel_m;
  return watch.see(tick, present, messages);
}

/// Shows a watch one scan again and again to a robot that goes `step_m` a tick, 50 times; the tick
/// at which it takes the sensor for frozen.
std::optional<std::uint64_t> frozen_at(ScanWatch& watch, const domain::Scan& scan, double step_m) {
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    if (show(watch, tick, scan, static_cast<double>(tick) * step_m)) return tick;
  }
  return std::nullopt;
}

TEST(ScanWatch, TakesEqualReadingsForFrozenAfterAFifthOfASecond) {
  ScanWatch watch(0.05, true);

  EXPECT_EQ(frozen_at(watch, scan_of(1.0), 0.03), 4u);
  EXPECT_EQ(show(watch, 5, scan_of(1.0), 1.0),
            "the sensor is frozen: its readings are those of tick 0, to the bit, though the robot "
            "has moved by more than 5 cm");
}

TEST(ScanWatch, TakesATickWhereTicksAreLonger) {
  ScanWatch watch(0.3, true);

  EXPECT_EQ(frozen_at(watch, scan_of(1.0), 0.1), 1u);
}

TEST(ScanWatch, WaitsUntilTheRobotHasMoved) {
  ScanWatch slow(0.1, true);
  ScanWatch still(0.1, true);

  EXPECT_EQ(frozen_at(slow, scan_of(1.0), 0.004), 13u);  // 5.2 cm
  EXPECT_EQ(frozen_at(still, scan_of(1.0), 0.0), std::nullopt);
}

TEST(ScanWatch, KnowsNothingOfScansInWhichNothingReturns) {
  ScanWatch watch(0.1, true);

  EXPECT_EQ(frozen_at(watch, scan_of(1.5), 0.1), std::nullopt);
}

TEST(ScanWatch, KnowsNothingOfSensorsWhoseReadingsMayRepeat) {
  ScanWatch watch(0.1, false);

  EXPECT_EQ(frozen_at(watch, scan_of(1.0), 0.1), std::nullopt);
}

TEST(ScanWatch, KnowsNothingOfATickWithoutAScan) {
  ScanWatch watch(0.1, true);
  domain::Messages messages;

  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    std::get<domain::Odometry>(messages).travel_m = static_cast<double>(tick);
    EXPECT_FALSE(watch.see(tick, {}, messages));
  }
}

TEST(ScanWatch, SaysItAgainWhenTheRobotGoesOnAllTheSame) {
  ScanWatch watch(0.05, true);
  std::vector<std::uint64_t> told;

  for (std::uint64_t tick = 0; tick < 9; ++tick) {
    if (show(watch, tick, scan_of(1.0), 0.03 * static_cast<double>(tick))) told.push_back(tick);
  }

  EXPECT_EQ(told, (std::vector<std::uint64_t>{4, 6, 8}));
}

TEST(ScanWatch, BelievesTheSensorAgainWhenOneReadingChanges) {
  ScanWatch watch(0.1, true);
  domain::Scan scan = scan_of(1.0);
  ASSERT_TRUE(frozen_at(watch, scan, 0.1));

  scan.ranges_m[3] = 1.0000000000000002;

  EXPECT_FALSE(show(watch, 50, scan, 100.0));
}

TEST(ScanWatch, TakesASensorThatRepeatsItsStampForFrozenOnceAStamp) {
  const ScanWatch::Time start{};
  ScanWatch watch(0.1, false);

  EXPECT_FALSE(watch.arrive(7, start));
  EXPECT_FALSE(watch.arrive(7, start + milliseconds(150)));
  EXPECT_EQ(watch.arrive(7, start + milliseconds(210)),
            "the sensor is frozen: it writes its scan of tick 7 again");
  EXPECT_FALSE(watch.arrive(7, start + milliseconds(400)));
  EXPECT_FALSE(watch.arrive(8, start + milliseconds(500)));
  EXPECT_TRUE(watch.arrive(8, start + milliseconds(900)));
}

TEST(ScanWatch, TakesSensorsThatWriteTwiceForHealthyAsLongAsTheyGoOn) {
  ScanWatch watch(0.1, false);
  ScanWatch::Time now{};

  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    now += milliseconds(100);
    EXPECT_FALSE(watch.arrive(tick, now));
    EXPECT_FALSE(watch.arrive(tick, now + milliseconds(1)));
  }
}

}  // namespace
}  // namespace clew::bridge
