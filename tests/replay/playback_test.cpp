// SPDX-License-Identifier: Apache-2.0
#include "replay/playback.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

using Kind = PlaybackRequest::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

const Playback::Time kStart{seconds(100)};
constexpr double kTick_s = 0.5;

int ticks_begun(Playback& playback, Playback::Time now, int most = 10) {
  int count = 0;
  while (count < most && playback.may_begin(now)) {
    playback.begin(now);
    ++count;
  }
  return count;
}

TEST(Playback, GoesAsFastAsItCanWithoutARate) {
  Playback playback(kTick_s, 0.0, false);
  playback.start(kStart);

  EXPECT_EQ(ticks_begun(playback, kStart), 10);
  EXPECT_LE(*playback.due(), kStart);
}

TEST(Playback, SpacesTicksByItsRate) {
  Playback playback(kTick_s, 2.0, false);
  playback.start(kStart);

  // Half a simulated second at twice its speed: four ticks in a second, the first at once.
  EXPECT_EQ(ticks_begun(playback, kStart), 1);
  EXPECT_EQ(*playback.due(), kStart + milliseconds(250));
  EXPECT_EQ(ticks_begun(playback, kStart + milliseconds(249)), 0);
  EXPECT_EQ(ticks_begun(playback, kStart + milliseconds(250)), 1);
}

TEST(Playback, CatchesUpWithASmallDelayButNotWithAHoldUp) {
  Playback playback(kTick_s, 10.0, false);
  playback.start(kStart);

  // 50 ms a tick: after 80 ms the first two are due, and the third is at 100 ms.
  EXPECT_EQ(ticks_begun(playback, kStart + milliseconds(80)), 2);
  EXPECT_EQ(*playback.due(), kStart + milliseconds(100));
  // A second later one is due, and the next 50 ms after it, not nineteen at once.
  EXPECT_EQ(ticks_begun(playback, kStart + seconds(1)), 1);
  EXPECT_EQ(*playback.due(), kStart + milliseconds(1050));
}

TEST(Playback, BeginsNothingWhilePausedButSingleTicks) {
  Playback playback(kTick_s, 0.0, true);
  playback.start(kStart);

  EXPECT_TRUE(playback.halted());
  EXPECT_FALSE(playback.due().has_value());
  EXPECT_EQ(ticks_begun(playback, kStart), 0);
  playback.apply({Kind::kStep, 3, 0.0}, kStart);
  playback.apply({Kind::kStep}, kStart);
  EXPECT_FALSE(playback.halted());
  EXPECT_EQ(ticks_begun(playback, kStart), 4);
  EXPECT_TRUE(playback.halted());
}

TEST(Playback, ASingleTickPauses) {
  Playback playback(kTick_s, 1.0, false);
  playback.start(kStart);

  playback.apply({Kind::kStep}, kStart);

  EXPECT_TRUE(playback.paused());
  EXPECT_EQ(ticks_begun(playback, kStart), 1);
}

TEST(Playback, GoesOnFromAPauseAtOnceAndWithoutTicksAskedForBefore) {
  Playback playback(kTick_s, 1.0, true);
  playback.start(kStart);
  playback.apply({Kind::kStep, 5, 0.0}, kStart);
  playback.apply({Kind::kPause}, kStart);
  EXPECT_EQ(ticks_begun(playback, kStart), 0);

  playback.apply({Kind::kToggle}, kStart + seconds(9));

  EXPECT_FALSE(playback.paused());
  EXPECT_EQ(ticks_begun(playback, kStart + seconds(9)), 1);
  EXPECT_EQ(*playback.due(), kStart + milliseconds(9500));
  playback.apply({Kind::kToggle}, kStart + seconds(9));
  EXPECT_TRUE(playback.paused());
  playback.apply({Kind::kResume}, kStart + seconds(9));
  EXPECT_FALSE(playback.paused());
}

TEST(Playback, GetsFasterAndSlowerByTwo) {
  Playback playback(kTick_s, 600.0, false);

  playback.apply({Kind::kFaster}, kStart);
  EXPECT_EQ(playback.rate(), 1000.0);  // the highest one
  playback.apply({Kind::kFaster}, kStart);
  EXPECT_EQ(playback.rate(), 0.0);  // as fast as it goes
  playback.apply({Kind::kFaster}, kStart);
  EXPECT_EQ(playback.rate(), 0.0);
  playback.apply({Kind::kSlower}, kStart);
  EXPECT_EQ(playback.rate(), 1.0);
  playback.apply({Kind::kSlower}, kStart);
  EXPECT_EQ(playback.rate(), 0.5);
  playback.apply({Kind::kRate, 1, 0.0001}, kStart);
  EXPECT_EQ(playback.rate(), 0.001);  // the lowest one
  playback.apply({Kind::kSlower}, kStart);
  EXPECT_EQ(playback.rate(), 0.001);
}

}  // namespace
}  // namespace clew::bridge
