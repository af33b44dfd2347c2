// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/map_following.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/astar.hpp"
#include "recover/detectors/map_detour.hpp"
#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

domain::BehaviourSetup setup() {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.limits.speed_mps = 0.4;
  return setup;
}

struct Answer {
  EscapeStatus status = EscapeStatus::kActive;
  domain::Guidance guidance;
};

/// What a robot has seen so far, as the component keeps it.
class Memory {
 public:
  /// The scene, taken in.
  Situation seen(Situation situation) {
    local_map_.see(situation.odometry, situation.scan);
    situation.local_map = &local_map_;
    return situation;
  }
  Answer step(Escape& escape, const Situation& situation) {
    Answer answer;
    answer.status = escape.step(seen(situation), answer.guidance);
    if (answer.status == EscapeStatus::kLooksAgain) local_map_.forget();
    return answer;
  }
  /// As the component does it: whoever is at work or not watches first.
  Answer tick(Escape& escape, const Situation& situation) {
    escape.watch(seen(situation));
    return step(escape, situation);
  }
  map::LocalMap& local_map() { return local_map_; }

 private:
  map::LocalMap local_map_{{}, setup().robot.radius_m};
};

/// At the origin, and a wall across at 0.4 m: the least distance of a straight wall in a cone is
/// that on its inner border, 0.4 m / cos(border), less the robot's radius. The target is near
/// behind the wall, so that the way round it leads away first.
Scene before_a_wall() {
  return Scene().at(0, 0, 0).target(0.65, 0).sees({0.354, 0.283, 0.254, 0.25, 0.254, 0.283, 0.354});
}

/// Escapes end only where the way does not lead away at all.
MapFollowing::Parameters patient() {
  MapFollowing::Parameters parameters;
  parameters.leave_rise_m = 0.01;
  return parameters;
}

enum class Search { kDistance, kNeural, kAStar };

/// All searches, which share all but the search.
class RememberedWayTest : public ::testing::TestWithParam<Search> {
 protected:
  std::unique_ptr<Escape> make(const MapFollowing::Parameters& parameters = patient()) const {
    if (GetParam() == Search::kAStar) return RememberedAStar::create(parameters, setup()).value();
    const PathBy by = GetParam() == Search::kNeural ? PathBy::kNeural : PathBy::kDistance;
    return RememberedMap::create({parameters, by}, setup()).value();
  }
  Answer step(Escape& escape, const Scene& scene) {
    return memory_.step(escape, scene.situation());
  }

  Memory memory_;
};

TEST_P(RememberedWayTest, LeadsRoundTheWallThatItSaw) {
  const auto escape = make();
  escape->begin(before_a_wall().situation(), {});

  const Answer answer = step(*escape, before_a_wall());

  // Sideways, and not so near to the wall at x = 0.4 that a robot of 0.15 m would touch it.
  EXPECT_EQ(answer.status, EscapeStatus::kActive);
  ASSERT_TRUE(answer.guidance.target_is_virtual);
  EXPECT_GT(std::fabs(answer.guidance.target_y_m), 0.1);
  EXPECT_LT(answer.guidance.target_x_m, 0.26);
}

TEST_P(RememberedWayTest, TurnsOnTheSpotBeforeItStepsToTheSide) {
  const auto escape = make();
  escape->begin(before_a_wall().situation(), {});
  const Answer answer = step(*escape, before_a_wall());
  const core::Vec2 corner(answer.guidance.target_x_m, answer.guidance.target_y_m);
  const double bearing_rad = core::atan2(corner.y(), corner.x());
  ASSERT_GT(std::fabs(bearing_rad), core::radians(30.0));

  ASSERT_TRUE(answer.guidance.has_override);
  EXPECT_DOUBLE_EQ(answer.guidance.override_motion.turn_rad, bearing_rad);
  EXPECT_EQ(answer.guidance.override_motion.step_m, 0.0);

  // Now it looks there, and sees nothing: 0.4 m/s for 0.5 s, or to the corner.
  const Answer next = step(*escape, Scene().at(0, 0, core::degrees(bearing_rad)).target(0.65, 0));

  ASSERT_TRUE(next.guidance.has_override);
  EXPECT_NEAR(next.guidance.override_motion.turn_rad, 0.0, 1e-9);
  EXPECT_NEAR(next.guidance.override_motion.step_m, std::min(0.2, core::length(corner)), 1e-9);
}

TEST_P(RememberedWayTest, LeavesTheMotionToTheControllerAsLongAsThatGetsOn) {
  MapFollowing::Parameters parameters = patient();
  parameters.patience_s = 2.0;
  parameters.path.replan_s = 60.0;
  parameters.held_s = 100.0;
  const auto escape = make(parameters);
  escape->begin(before_a_wall().situation(), {});

  // Stands still from tick 0 on: 2 s are 4 ticks of 0.5 s.
  for (std::uint64_t tick = 0; tick < 4; ++tick) {
    EXPECT_FALSE(step(*escape, before_a_wall().tick(tick)).guidance.has_override) << tick;
  }
  EXPECT_TRUE(step(*escape, before_a_wall().tick(4)).guidance.has_override);
}

TEST_P(RememberedWayTest, EndsWhereTheWayDoesNotLeadAway) {
  const auto escape = make();
  escape->begin(before_a_wall().situation(), {});
  step(*escape, before_a_wall());

  // Past the wall's known end and behind it.
  const Answer answer = step(*escape, Scene().at(0.6, 1.0, -90).target(0.65, 0).tick(10));

  EXPECT_EQ(answer.status, EscapeStatus::kEnded);
}

TEST_P(RememberedWayTest, EndsASecondTimeOnlyNearerToTheTarget) {
  const auto escape = make();
  const auto open_at = [](double x_m) { return Scene().at(x_m, 0, 0).target(5, 0); };
  escape->begin(open_at(1.0).situation(), {});
  EXPECT_EQ(step(*escape, open_at(1.0)).status, EscapeStatus::kEnded);

  escape->begin(open_at(1.0).situation(), {});

  EXPECT_EQ(step(*escape, open_at(1.1).tick(1)).status, EscapeStatus::kActive);
  EXPECT_EQ(step(*escape, open_at(1.3).tick(9)).status, EscapeStatus::kEnded);  // by 0.2 m and more
}

/// Held from all sides: bumpers every 45 degrees, so that neighbouring contacts are 0.12 m apart.
class Held : public Scene {
 public:
  Held() {
    at(0, 0, 0).target(5, 0);
    odometry_ = Scene::situation().odometry;
    odometry_.blocked = true;
    for (int i = 0; i < 8; ++i) {
      odometry_.contact_bearings_rad.push_back(core::wrap_angle_rad(core::radians(45.0 * i)));
    }
  }
  Situation situation(std::uint64_t tick) const {
    return {tick, odometry_, scan(), nullptr, target(), target(), 0.2};
  }

 private:
  domain::Odometry odometry_;
};

TEST_P(RememberedWayTest, IsUnreachableOnlyWhenTheCutHasStoodForAMinuteAndIsSeenOnceMore) {
  const auto escape = make();
  const Held held;
  escape->begin(held.situation(0), {});

  // 60 s are 120 ticks; then it looks for the last time.
  for (std::uint64_t tick = 0; tick <= 120; ++tick) {
    const Answer answer = memory_.tick(*escape, held.situation(tick));
    EXPECT_EQ(answer.status, EscapeStatus::kLooksAgain) << tick;
    EXPECT_GT(std::fabs(answer.guidance.override_motion.turn_rad), 0.0) << tick;
  }
  const Answer answer = memory_.tick(*escape, held.situation(121));

  EXPECT_EQ(answer.status, EscapeStatus::kUnreachable);
  EXPECT_FALSE(answer.guidance.why.empty());
}

TEST_P(RememberedWayTest, ACutThatOpenedProvesNothing) {
  const auto escape = make();
  const Held held;
  escape->begin(held.situation(0), {});
  for (std::uint64_t tick = 0; tick < 50; ++tick) memory_.tick(*escape, held.situation(tick));

  // Whoever stood ahead has gone.
  for (std::uint64_t tick = 50; tick < 60; ++tick) {
    memory_.tick(*escape, Scene().at(0, 0, 0).target(5, 0).tick(tick).situation());
  }

  // Now they are back, and stay: another 120 ticks, and one.
  for (std::uint64_t tick = 60; tick <= 180; ++tick) {
    EXPECT_NE(memory_.tick(*escape, held.situation(tick)).status, EscapeStatus::kUnreachable)
        << tick;
  }
  EXPECT_EQ(memory_.tick(*escape, held.situation(181)).status, EscapeStatus::kUnreachable);
}

TEST_P(RememberedWayTest, KeepsItsProofInItsState) {
  const auto escape = make();
  const Held held;
  escape->begin(held.situation(0), {});
  for (std::uint64_t tick = 0; tick <= 100; ++tick) memory_.tick(*escape, held.situation(tick));
  core::StateWriter writer;
  escape->save(writer);
  const auto loaded = make();

  core::StateReader reader(writer.bytes());
  loaded->load(reader);

  EXPECT_TRUE(reader.complete()) << reader.fault();
  for (std::uint64_t tick = 101; tick <= 120; ++tick) memory_.tick(*loaded, held.situation(tick));
  EXPECT_EQ(memory_.tick(*loaded, held.situation(121)).status, EscapeStatus::kUnreachable);
}

TEST_P(RememberedWayTest, TakesAPlaceThatItDoesNotGetToForClosed) {
  MapFollowing::Parameters parameters = patient();
  parameters.held_s = 2.0;
  const auto escape = make(parameters);
  const auto blocked_at = [](std::uint64_t tick) { return before_a_wall().tick(tick); };
  escape->begin(blocked_at(0).situation(), {});
  const Answer first = step(*escape, blocked_at(0));

  for (std::uint64_t tick = 1; tick < 30; ++tick) step(*escape, blocked_at(tick));
  const Answer later = step(*escape, blocked_at(31));

  // It has not moved for 2 s, and for longer than a free one needs: the way begins in
  // another direction.
  const core::Vec2 before(first.guidance.target_x_m, first.guidance.target_y_m);
  const core::Vec2 now(later.guidance.target_x_m, later.guidance.target_y_m);
  EXPECT_GT(core::length(now - before), 0.03);
}

/// Before a wall across at x = 0.4 m with a gap of 1.05 diameters, in a world that ends 0.6 m
/// beside it: the laser sees it all.
class BeforeAGap {
 public:
  Situation situation(std::uint64_t tick) {
    odometry_.pose_odom_robot = {0.15, 0.0, 0.0};
    scan_.bearing_first_rad = core::kPi;
    scan_.bearing_step_rad = core::radians(-1.0);
    scan_.range_max_m = 4.0;
    scan_.ranges_m.clear();
    for (int i = 0; i < 360; ++i) scan_.ranges_m.push_back(range_m(core::radians(180.0 - i)));
    return {tick, odometry_, scan_, nullptr, {3.0, 0.0}, {3.0, 0.0}, 0.2};
  }

 private:
  /// Walls at y = -0.6 and 0.6 and at x = -0.4; that at x = 0.4 has the gap.
  double range_m(double bearing_rad) const {
    const core::Vec2 along = core::direction(bearing_rad);
    double distance_m = 9.0;
    if (along.y() != 0.0) distance_m = 0.6 / std::fabs(along.y());
    if (along.x() < 0.0) distance_m = std::min(distance_m, -0.55 / along.x());
    if (along.x() > 0.0) {
      const double to_wall_m = 0.25 / along.x();
      if (std::fabs(to_wall_m * along.y()) >= 0.1575) distance_m = std::min(distance_m, to_wall_m);
    }
    return std::min(4.0, distance_m - setup().robot.radius_m);
  }

  domain::Odometry odometry_;
  domain::Scan scan_;
};

TEST_P(RememberedWayTest, NeverTakesWhatHoldsItForAProof) {
  MapFollowing::Parameters parameters = patient();
  parameters.held_s = 2.0;
  parameters.proof_s = 5.0;
  const auto escape = make(parameters);
  BeforeAGap gap;
  escape->begin(gap.situation(0), {});

  // Held before the only way for 300 s, again and again.
  for (std::uint64_t tick = 0; tick < 600; ++tick) {
    ASSERT_NE(memory_.tick(*escape, gap.situation(tick)).status, EscapeStatus::kUnreachable)
        << tick;
  }
}

TEST_P(RememberedWayTest, GoesOnTheSameAfterSavingAndLoading) {
  const auto escape = make();
  escape->begin(before_a_wall().situation(), {});
  step(*escape, before_a_wall());
  core::StateWriter writer;
  escape->save(writer);
  const auto loaded = make();

  core::StateReader reader(writer.bytes());
  loaded->load(reader);

  EXPECT_TRUE(reader.complete());
  const Scene next = before_a_wall().at(0, 0.1, 90).tick(3);
  const Answer a = step(*escape, next);
  const Answer b = step(*loaded, next);
  EXPECT_EQ(a.guidance.target_x_m, b.guidance.target_x_m);
  EXPECT_EQ(a.guidance.target_y_m, b.guidance.target_y_m);
}

INSTANTIATE_TEST_SUITE_P(All, RememberedWayTest,
                         ::testing::Values(Search::kDistance, Search::kNeural, Search::kAStar),
                         [](const auto& test) {
                           return test.param == Search::kDistance ? "Distance"
                                  : test.param == Search::kNeural ? "Neural"
                                                                  : "AStar";
                         });

TEST(MapDetour, IsQuietWhereTheWayKnownIsStraight) {
  MapDetour detector({}, setup());
  Memory memory;

  for (std::uint64_t tick = 0; tick < 20; ++tick) {
    const Scene scene = Scene().at(0.2 * static_cast<double>(tick), 0, 0).target(5, 0).tick(tick);
    EXPECT_FALSE(detector.observe(memory.seen(scene.situation())).has_value());
  }
}

TEST(MapDetour, NoticesThatEveryWayLeadsAwayFirst) {
  MapDetourParameters parameters;
  parameters.rise_m = 0.05;
  MapDetour detector(parameters, setup());
  Memory memory;
  // Right before the wall, 5 m from the target: round its known end, at (0.2, 0.6) and farther, are
  // sqrt(4.8^2 + 0.6^2) = 4.84 m; seen wider it is more than 5.05 m.
  bool noticed = false;

  for (int i = -6; i <= 6 && !noticed; ++i) {
    const Scene scene = before_a_wall().at(0, 0.25 * i, 0).tick(static_cast<std::uint64_t>(i + 6));
    noticed = detector.observe(memory.seen(scene.situation())).has_value();
  }

  EXPECT_TRUE(noticed);
}

TEST(MapDetour, NoticesARobotThatDoesNotGetOn) {
  MapDetourParameters parameters;
  parameters.patience_s = 10.0;
  MapDetour detector(parameters, setup());
  Memory memory;

  const auto trapped_at = [&](std::uint64_t tick) {
    const Scene scene = Scene().at(0, 0, 0).target(5, 0).tick(tick);
    return detector.observe(memory.seen(scene.situation())).has_value();
  };
  // 10 s are 20 ticks.
  for (std::uint64_t tick = 0; tick < 20; ++tick) EXPECT_FALSE(trapped_at(tick)) << tick;
  EXPECT_TRUE(trapped_at(20));
}

}  // namespace
}  // namespace clew::recover
