// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/track_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"
#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {
namespace {

using core::radians;

// Readings, leftmost first.
constexpr std::initializer_list<double> kWallOnLeft = {0.32, 0.5, 0.8, 1, 1, 1, 1};
constexpr std::initializer_list<double> kWallOnRight = {1, 1, 1, 1, 0.8, 0.5, 0.32};
constexpr std::initializer_list<double> kFree = {1, 1, 1, 1, 1, 1, 1};

struct Answer {
  EscapeStatus status;
  domain::Guidance guidance;
};

/// T mode since the robot was at the origin, with the target at (10, 0).
class TrackModeTest : public testing::Test {
 protected:
  explicit TrackModeTest(TrackLeaving leave = TrackLeaving::kCollinear) : escape_(make(leave)) {}

  static TrackMode make(TrackLeaving leave) {
    TrackModeParameters parameters;
    parameters.leave = leave;
    return {parameters, WallRules::parse(tests::rule_base("obstacle_following")).value()};
  }

  Answer begin(std::initializer_list<double> readings, double target_y_m = 0.0) {
    const Scene scene = Scene().at(0, 0, 0).sees(readings).target(10, target_y_m);
    escape_.begin(scene.situation(), {});
    return step(scene);
  }
  Answer step(const Scene& scene) {
    Answer answer{};
    answer.status = escape_.step(scene.situation(), answer.guidance);
    return answer;
  }
  Answer at(double x_m, double y_m, std::initializer_list<double> readings = kWallOnLeft) {
    return step(Scene().at(x_m, y_m, 0).sees(readings).target(10, 0));
  }

  TrackMode escape_;
};

TEST_F(TrackModeTest, TracksAtOnceOnTheObstaclesSide) {
  EXPECT_EQ(begin(kWallOnLeft).guidance.why, "T mode, wall on left");
  const Answer answer = begin(kWallOnRight);

  EXPECT_EQ(answer.status, EscapeStatus::kActive);
  EXPECT_TRUE(answer.guidance.has_override);
  EXPECT_EQ(answer.guidance.why, "T mode, wall on right");
}

TEST_F(TrackModeTest, TracksOnTheTargetsSideWithNothingInView) {
  EXPECT_EQ(begin(kFree, 5.0).guidance.why, "T mode, wall on left");
  EXPECT_EQ(begin(kFree, -5.0).guidance.why, "T mode, wall on right");
}

TEST_F(TrackModeTest, EndsWhereItCrossesTheLineToTheTarget) {
  begin(kWallOnLeft);

  EXPECT_EQ(at(3, 1).status, EscapeStatus::kActive);
  EXPECT_EQ(at(4, 0.1).status, EscapeStatus::kActive);
  EXPECT_EQ(at(4, -0.1).status, EscapeStatus::kEnded);
}

TEST_F(TrackModeTest, TakesTheLineFromWhereItCameBesideTheObstacle) {
  begin(kFree, 1.0);

  EXPECT_EQ(at(2, 1, kFree).status, EscapeStatus::kActive);
  EXPECT_EQ(at(2, -1, kFree).status, EscapeStatus::kActive);
  // Beside it at (2, 1): the line to the target passes (6, 0.5).
  EXPECT_EQ(at(2, 1).status, EscapeStatus::kActive);
  EXPECT_EQ(at(6, 0.6).status, EscapeStatus::kActive);
  EXPECT_EQ(at(6, 0.4).status, EscapeStatus::kEnded);
}

TEST_F(TrackModeTest, DoesNotEndBehindWhereItBeganNorBehindTheTarget) {
  begin(kWallOnLeft);

  at(-1, 1);
  EXPECT_EQ(at(-1, -1).status, EscapeStatus::kActive);
  EXPECT_EQ(at(11, -1).status, EscapeStatus::kActive);
  EXPECT_EQ(at(11, 1).status, EscapeStatus::kActive);
}

TEST_F(TrackModeTest, IsNotEndedByAnEndOfTheObstacle) {
  begin(kWallOnLeft);

  EXPECT_EQ(at(3, -1, kFree).status, EscapeStatus::kActive);
}

TEST_F(TrackModeTest, FailsWithoutAWall) {
  begin(kWallOnLeft);

  Scene scene = Scene().at(3, 1, 0).sees(kFree).target(10, 0);
  EXPECT_EQ(step(scene.travelled(3.9)).status, EscapeStatus::kActive);
  EXPECT_EQ(step(scene.travelled(4.1)).status, EscapeStatus::kFailed);
}

TEST_F(TrackModeTest, FailsWhenItHasComeRound) {
  // Round a post of 1 m, from its point nearest to the target.
  const auto on_circle = [](double angle_deg, double travel_m) {
    const double angle_rad = radians(angle_deg);
    return Scene()
        .at(-3.0 + std::cos(angle_rad), 5.0 + std::sin(angle_rad), angle_deg + 90.0)
        .travelled(travel_m)
        .sees(kWallOnLeft)
        .target(20.0, 5.0);
  };
  escape_.begin(on_circle(0.0, 0.0).situation(), {});

  EscapeStatus status = EscapeStatus::kActive;
  double angle_deg = 0.0;
  while (status == EscapeStatus::kActive && angle_deg < 800.0) {
    angle_deg += 5.0;
    status = step(on_circle(angle_deg, radians(angle_deg))).status;
  }

  EXPECT_EQ(status, EscapeStatus::kFailed);
}

TEST_F(TrackModeTest, GoesOnAsBeforeAfterSaveAndLoad) {
  begin(kWallOnRight);
  at(3, 1, kWallOnRight);
  core::StateWriter writer;
  escape_.save(writer);

  TrackMode restored = make(TrackLeaving::kCollinear);
  core::StateReader reader(writer.bytes());
  restored.load(reader);
  domain::Guidance guidance;
  const Scene on_line = Scene().at(4, -0.1, 0).sees(kWallOnRight).target(10, 0);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(restored.step(on_line.situation(), guidance), EscapeStatus::kEnded);
}

class SwappedTest : public TrackModeTest {
 protected:
  SwappedTest() : TrackModeTest(TrackLeaving::kSwapped) {}
};

TEST_F(SwappedTest, EndsAtAnEndOfTheObstacleWhereTheTargetHasComeBackToItsSide) {
  begin(kWallOnLeft, 1.0);

  EXPECT_EQ(at(3, -1, kFree).status, EscapeStatus::kActive);  // it was on no other side yet
  EXPECT_EQ(at(3, 1, kFree).status, EscapeStatus::kActive);   // on the right
  EXPECT_EQ(at(3, -1).status, EscapeStatus::kActive);         // no end
  EXPECT_EQ(at(3, -1, kFree).status, EscapeStatus::kEnded);
}

TEST(TrackMode, RefusesASensorThatLooksElsewhere) {
  domain::BehaviourSetup setup;
  setup.scan = {"bumper_eye", 3, radians(-10.0), radians(10.0), 0.0, 1.0};

  const auto made = TrackMode::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("track_mode needs a beam"), std::string::npos);
}

}  // namespace
}  // namespace clew::recover
