// SPDX-License-Identifier: Apache-2.0
#include "component/scan_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

using News = std::optional<ScanWatch::News>;

std::string kind_of(const News& news) { return news ? news->kind : ""; }

/// What a watch says of a tick in which the robot has gone `travel_m`.
News show(ScanWatch& watch, std::uint64_t tick, const domain::Scan& scan, double travel_m) {
  runtime::TopicSet present;
  present.set(index_of(domain::Topic::kScan));
  present.set(index_of(domain::Topic::kOdometry));
  domain::Messages messages;
  std::get<domain::Scan>(messages) = scan;
  std::get<domain::Odometry>(messages).travel_m = travel_m;
  return watch.see(tick, present, messages);
}

/// Shows a watch one scan again and again to a robot that goes `step_m` a tick, 50 times; the first
/// tick at which it tells the kind.
std::optional<std::uint64_t> told_at(ScanWatch watch, const char* kind, const domain::Scan& scan,
                                     double step_m) {
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    if (kind_of(show(watch, tick, scan, static_cast<double>(tick) * step_m)) == kind) return tick;
  }
  return std::nullopt;
}

TEST(ScanWatch, TakesEqualReadingsForStaleAfterAFifthOfASecondAndThenForFrozen) {
  const ScanWatch watch(0.05, true);

  EXPECT_EQ(told_at(watch, ScanWatch::kStale, scan_of(1.0), 0.03), 4u);
  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.0), 0.03), 6u);
}

TEST(ScanWatch, SaysSinceWhenTheReadingsAreTheSame) {
  ScanWatch watch(0.3, true);
  show(watch, 0, scan_of(0.9), 0.0);
  show(watch, 1, scan_of(1.0), 0.1);

  const News stale = show(watch, 2, scan_of(1.0), 0.2);
  const News frozen = show(watch, 3, scan_of(1.0), 0.3);

  const std::string why =
      "its readings are those of tick 1, to the bit, though the robot has moved by more than 5 cm";
  ASSERT_TRUE(stale && frozen);
  EXPECT_EQ(stale->text, "the sensor is stale: " + why);
  EXPECT_EQ(frozen->text, "the sensor is frozen: " + why);
}

TEST(ScanWatch, TakesATickAndTwoWhereTicksAreLonger) {
  const ScanWatch watch(0.3, true);

  EXPECT_EQ(told_at(watch, ScanWatch::kStale, scan_of(1.0), 0.1), 1u);
  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.0), 0.1), 2u);
}

TEST(ScanWatch, WaitsUntilTheRobotHasMoved) {
  const ScanWatch watch(0.1, true);

  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.0), 0.004), 13u);  // 5.2 cm
  EXPECT_EQ(told_at(watch, ScanWatch::kStale, scan_of(1.0), 0.004), std::nullopt);
  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.0), 0.0), std::nullopt);
}

TEST(ScanWatch, TakesASensorForFrozenAlsoIfTheRobotStopsWhileItIsStale) {
  ScanWatch watch(0.05, true);
  std::string told;

  for (std::uint64_t tick = 0; tick < 9; ++tick) {
    const auto gone = static_cast<double>(std::min<std::uint64_t>(tick, 4));
    told += kind_of(show(watch, tick, scan_of(1.0), 0.03 * gone));
  }

  EXPECT_EQ(told, "stale_sensorfrozen_sensor");
}

TEST(ScanWatch, KnowsNothingOfScansInWhichNothingReturns) {
  const ScanWatch watch(0.1, true);

  EXPECT_EQ(told_at(watch, ScanWatch::kStale, scan_of(1.5), 0.1), std::nullopt);
  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.5), 0.1), std::nullopt);
}

TEST(ScanWatch, KnowsNothingOfSensorsWhoseReadingsMayRepeat) {
  const ScanWatch watch(0.1, false);

  EXPECT_EQ(told_at(watch, ScanWatch::kStale, scan_of(1.0), 0.1), std::nullopt);
  EXPECT_EQ(told_at(watch, ScanWatch::kFrozen, scan_of(1.0), 0.1), std::nullopt);
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

  for (std::uint64_t tick = 0; tick < 11; ++tick) {
    const News news = show(watch, tick, scan_of(1.0), 0.03 * static_cast<double>(tick));
    if (kind_of(news) == ScanWatch::kFrozen) told.push_back(tick);
  }

  EXPECT_EQ(told, (std::vector<std::uint64_t>{6, 8, 10}));
}

TEST(ScanWatch, BelievesTheSensorAgainWhenOneReadingChanges) {
  ScanWatch watch(0.1, true);
  domain::Scan scan = scan_of(1.0);
  for (std::uint64_t tick = 0; tick < 3; ++tick) {
    show(watch, tick, scan, 0.1 * static_cast<double>(tick));
  }

  scan.ranges_m[3] = 1.0000000000000002;

  EXPECT_EQ(kind_of(show(watch, 3, scan, 0.4)), ScanWatch::kFresh);
  EXPECT_EQ(kind_of(show(watch, 4, scan, 0.4)), "");
}

/// A watch without noise, awake, whose sensor has written its scan of tick 7 and no newer one, for
/// drive has gone on to tick 8 at the time 0.
class WaitingWatch : public testing::Test {
 protected:
  explicit WaitingWatch(double tick_s = 0.1) : watch(tick_s, false) {
    EXPECT_FALSE(watch.scan_arrives(7, start));
    watch.odometry_arrives(8, start);
  }
  /// Looks every 20 ms up to this time; the kinds that are told, with their times.
  std::string look_until(int end_ms) {
    std::string told;
    for (; at_ms <= end_ms; at_ms += 20) {
      const News news = watch.look(start + milliseconds(at_ms));
      if (news) told += kind_of(news) + '@' + std::to_string(at_ms) + ' ';
    }
    return told;
  }

  const ScanWatch::Time start = ScanWatch::Time{} + std::chrono::hours(1);
  ScanWatch watch;
  int at_ms = 0;
};

TEST_F(WaitingWatch, TakesASensorThatWritesNothingForStaleAndThenForGoneAndSaysEachOnce) {
  EXPECT_EQ(look_until(2000), "stale_sensor@200 gone_sensor@300 ");
}

class WaitingForLongTicks : public WaitingWatch {
 protected:
  WaitingForLongTicks() : WaitingWatch(0.25) {}
};

TEST_F(WaitingForLongTicks, CountsATickAndTwo) {
  EXPECT_EQ(look_until(2000), "stale_sensor@260 gone_sensor@500 ");
}

TEST_F(WaitingWatch, CallsASensorThatRepeatsItsStampFrozen) {
  EXPECT_FALSE(watch.scan_arrives(7, start + milliseconds(10)));

  EXPECT_EQ(look_until(1000), "stale_sensor@200 frozen_sensor@300 ");
}

TEST_F(WaitingWatch, BelievesASensorThatComesBack) {
  EXPECT_EQ(look_until(240), "stale_sensor@200 ");

  EXPECT_EQ(kind_of(watch.scan_arrives(8, start + milliseconds(250))), ScanWatch::kFresh);
  EXPECT_EQ(look_until(2000), "") << "nothing newer is due before drive goes on";
}

TEST_F(WaitingWatch, CountsNoTimeInWhichItWasAsleepItself) {
  look_until(100);

  EXPECT_FALSE(watch.look(start + milliseconds(1100)));
  at_ms = 1120;
  EXPECT_EQ(look_until(3000), "stale_sensor@1200 gone_sensor@1300 ");
}

TEST(ScanWatch, WaitsForNoSensorThatHasNotBegun) {
  ScanWatch watch(0.1, false);
  const ScanWatch::Time start{};

  watch.odometry_arrives(0, start);

  for (int at_ms = 0; at_ms < 2000; at_ms += 20) {
    EXPECT_FALSE(watch.look(start + milliseconds(at_ms)));
  }
}

TEST(ScanWatch, TakesSensorsThatWriteTwiceForHealthyAsLongAsTheyGoOn) {
  ScanWatch watch(0.1, false);
  ScanWatch::Time now{};

  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    now += milliseconds(100);
    watch.odometry_arrives(tick, now);
    EXPECT_FALSE(watch.scan_arrives(tick, now));
    EXPECT_FALSE(watch.scan_arrives(tick, now + milliseconds(1)));
    EXPECT_FALSE(watch.look(now + milliseconds(90)));
  }
}

}  // namespace
}  // namespace clew::bridge
