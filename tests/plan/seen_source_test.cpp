// SPDX-License-Identifier: Apache-2.0
#include "plan/seen_source.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::plan {
namespace {

using core::Vec2;
using map::Clearance;

constexpr RoomNeeds kNeeds{0.15, 0.1};

/// One ray of a robot at the origin that looks along x.
domain::Scan ray(double range_m) {
  domain::Scan scan;
  scan.range_max_m = 4.0;
  scan.bearing_step_rad = core::radians(1.0);
  scan.ranges_m.push_back(range_m);
  return scan;
}

SeenSource source_that_saw(double range_m, std::int64_t capacity_tiles = 4096) {
  SeenSource source({0.025, capacity_tiles, 0.1}, kNeeds);
  source.see({}, ray(range_m));
  return source;
}

Clearance room_at(SeenSource& source, const Vec2& place) {
  const RoomView view = source.read(Vec2::Zero(), Vec2(3.0, 0.0));
  return view.room[view.grid.index(*view.grid.cell_at(place))];
}

TEST(SeenSource, TakesTheUnknownForFree) {
  SeenSource source({}, kNeeds);

  EXPECT_EQ(room_at(source, {2.0, 0.5}), Clearance::kOpen);
  EXPECT_TRUE(source.line_of_sight({0.0, 0.0}, {3.0, 0.0}, Clearance::kOpen));
  EXPECT_TRUE(source.changes());
}

TEST(SeenSource, TellsTheRoomBesideWhatItHasSeen) {
  // From the skin of a robot of 0.15 m to x = 1.5.
  SeenSource source = source_that_saw(1.35);

  // A hit lies up to 0.018 m from the middle of its cell, and a place up to 0.035 m from its.
  EXPECT_EQ(room_at(source, {1.5, 0.0}), Clearance::kNone);
  EXPECT_EQ(room_at(source, {1.5, 0.12}), Clearance::kTouching);
  EXPECT_EQ(room_at(source, {1.5, 0.20}), Clearance::kNarrow);
  EXPECT_EQ(room_at(source, {1.5, 0.31}), Clearance::kOpen);
}

TEST(SeenSource, HasAStraightWayOnlyWithTheRoomThatIsAskedFor) {
  SeenSource source = source_that_saw(1.35);

  // 0.18 m beside the hit: enough for the robot, and not for the margin beside it.
  EXPECT_FALSE(source.line_of_sight({0.0, 0.18}, {3.0, 0.18}, Clearance::kOpen));
  EXPECT_TRUE(source.line_of_sight({0.0, 0.18}, {3.0, 0.18}, Clearance::kNarrow));
  EXPECT_FALSE(source.line_of_sight({0.0, 0.05}, {3.0, 0.05}, Clearance::kTouching));
  // What is before or behind a line does not bar it.
  EXPECT_TRUE(source.line_of_sight({0.0, 0.0}, {1.3, 0.0}, Clearance::kOpen));
}

TEST(SeenSource, BelievesTheNewestEvidence) {
  SeenSource source = source_that_saw(1.35);
  domain::Scan farther = ray(4.0);
  farther.beam_width_rad = core::radians(15.0);

  source.see({}, farther);

  EXPECT_EQ(room_at(source, {1.5, 0.0}), Clearance::kOpen);
}

TEST(SeenSource, KeepsToItsCapacity) {
  // Tiles of 64 cells of 0.025 m: the hit at x = 2.5 lies in another than the robot.
  SeenSource source = source_that_saw(2.35, 1);

  EXPECT_EQ(room_at(source, {2.5, 0.0}), Clearance::kOpen);
}

TEST(SeenSource, RemembersAfterLoading) {
  const SeenSource source = source_that_saw(1.35);
  core::StateWriter writer;
  source.save(writer);
  SeenSource restored({}, kNeeds);
  core::StateReader reader(writer.bytes());

  restored.load(reader);

  ASSERT_TRUE(reader.complete());
  EXPECT_EQ(room_at(restored, {1.5, 0.0}), Clearance::kNone);
}

}  // namespace
}  // namespace clew::plan
