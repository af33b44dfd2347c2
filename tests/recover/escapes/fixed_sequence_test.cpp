// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/fixed_sequence.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

using domain::CommandKind;

/// Ticks of half a second: a turn is at most 0.5 rad a tick.
class FixedSequenceTest : public ::testing::Test {
 protected:
  /// Begins an action and takes its ticks; the robot does what it is told.
  void act() {
    motions_.clear();
    const auto scene = [&] { return Scene().tick(tick_).travelled(travel_m_); };
    escape_.begin(scene().situation(), {});
    for (;; ++tick_) {
      domain::Guidance guidance;
      status_ = escape_.step(scene().situation(), guidance);
      why_ = guidance.why;
      if (status_ != EscapeStatus::kActive) return;
      EXPECT_TRUE(guidance.has_override);
      motions_.push_back(guidance.override_motion);
      if (!blocked_) travel_m_ += guidance.override_motion.step_m;
    }
  }

  FixedSequence escape_{{}, 0.5};
  std::vector<domain::Motion> motions_;
  EscapeStatus status_ = EscapeStatus::kActive;
  std::string why_;
  std::uint64_t tick_ = 0;
  double travel_m_ = 0.0;
  bool blocked_ = false;
};

TEST_F(FixedSequenceTest, ClearsSpinsWaitsAndBacksUpByTurns) {
  act();
  EXPECT_TRUE(motions_.empty());
  EXPECT_EQ(status_, EscapeStatus::kEnded);

  act();
  double turned_rad = 0.0;
  for (const auto& motion : motions_) turned_rad += motion.turn_rad;
  EXPECT_NEAR(turned_rad, 1.57, 1e-12);
  EXPECT_EQ(motions_.size(), 4u);

  act();
  EXPECT_EQ(motions_.size(), 10u);  // 5 s
  EXPECT_EQ(motions_.front().kind, CommandKind::kStop);

  act();
  EXPECT_NEAR(travel_m_, 0.3, 1e-12);
  EXPECT_EQ(motions_.size(), 7u + 4u);  // 180 degrees at 0.5 rad, 0.3 m at 0.075 m

  act();
  EXPECT_EQ(why_, "clear");
}

TEST_F(FixedSequenceTest, DoesNotBackUpForEver) {
  act();
  act();
  act();
  blocked_ = true;
  act();

  EXPECT_EQ(motions_.size(), 20u);  // 10 s
  EXPECT_EQ(status_, EscapeStatus::kEnded);
}

TEST_F(FixedSequenceTest, FailsAfterItsRetries) {
  for (int i = 0; i < 6; ++i) {
    act();
    EXPECT_EQ(status_, EscapeStatus::kEnded);
  }
  act();

  EXPECT_EQ(status_, EscapeStatus::kFailed);
  EXPECT_EQ(why_, "no retries left");
}

}  // namespace
}  // namespace clew::recover
