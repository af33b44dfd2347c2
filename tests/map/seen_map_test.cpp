// SPDX-License-Identifier: Apache-2.0
#include "map/seen_map.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/angle.hpp"

namespace clew::map {
namespace {

constexpr double kCell_m = 0.1;

bool known(const SeenMap& seen, const Vec2& place) {
  return seen.is(Mark::kFree, place) || seen.is(Mark::kHit, place) ||
         seen.is(Mark::kSuspected, place);
}

TEST(SeenMap, MarksTheCellsThatLieWhollyInASectorAndNoOthers) {
  SeenMap seen(kCell_m, 100);
  const Vec2 apex(0.33, -0.21);
  const double radius_m = 1.7;
  const double right_rad = core::radians(-20.0);
  const double opening_rad = core::radians(75.0);

  seen.mark_free(Sector(apex, radius_m, right_rad, opening_rad));

  // A convex set holds a square if it holds its four corners.
  const auto within = [&](const Vec2& place) {
    const Vec2 off = place - apex;
    const double turn_rad = core::wrap_angle_rad(core::atan2(off.y(), off.x()) - right_rad);
    return core::length(off) <= radius_m && turn_rad >= 0.0 && turn_rad <= opening_rad;
  };
  int free = 0;
  for (int row = -30; row < 30; ++row) {
    for (int column = -30; column < 30; ++column) {
      const Vec2 corner(column * kCell_m, row * kCell_m);
      const bool whole = within(corner) && within(corner + Vec2(kCell_m, 0)) &&
                         within(corner + Vec2(0, kCell_m)) &&
                         within(corner + Vec2(kCell_m, kCell_m));
      const bool marked = seen.is(Mark::kFree, corner + 0.5 * Vec2(kCell_m, kCell_m));
      EXPECT_EQ(marked, whole) << corner.transpose();
      free += marked ? 1 : 0;
    }
  }
  EXPECT_GT(free, 100);  // of a sector of 1.9 square metres
}

TEST(SeenMap, TheNewestEvidenceWins) {
  SeenMap seen(kCell_m, 100);
  const Vec2 place(0.55, 0.45);

  seen.mark_hit(place);
  EXPECT_TRUE(seen.is(Mark::kHit, place));
  seen.mark_free(Sector(place, 0.5));
  EXPECT_TRUE(seen.is(Mark::kFree, place));
  EXPECT_FALSE(seen.is(Mark::kHit, place));
  seen.mark_hit(place);
  EXPECT_TRUE(seen.is(Mark::kHit, place));
  EXPECT_FALSE(seen.is(Mark::kFree, place));
}

TEST(SeenMap, ASuspicionDoesNotOutdoAHit) {
  SeenMap seen(kCell_m, 100);
  const Vec2 place(-0.55, -0.45);
  seen.mark_hit(place);

  seen.mark_suspected(place);

  EXPECT_TRUE(seen.is(Mark::kHit, place));
  EXPECT_FALSE(seen.is(Mark::kSuspected, place));
}

TEST(SeenMap, FindsObstaclesWithinARectangle) {
  SeenMap seen(kCell_m, 100);
  seen.mark_hit({0.05, 0.05});
  seen.mark_suspected({-7.05, 3.05});  // in another tile
  seen.mark_hit({5.05, 0.05});         // outside
  std::vector<Vec2> hits;
  std::vector<Vec2> suspected;

  seen.for_each(Mark::kHit, {-8, -1}, {1, 4}, [&](const Vec2& at) { hits.push_back(at); });
  seen.for_each(Mark::kSuspected, {-8, -1}, {1, 4},
                [&](const Vec2& at) { suspected.push_back(at); });

  ASSERT_EQ(hits.size(), 1U);
  EXPECT_NEAR(core::length(hits[0] - Vec2(0.05, 0.05)), 0.0, 1e-9);
  ASSERT_EQ(suspected.size(), 1U);
  EXPECT_NEAR(core::length(suspected[0] - Vec2(-7.05, 3.05)), 0.0, 1e-9);
}

TEST(SeenMap, HoldsNoMoreTilesThanItsCapacity) {
  SeenMap seen(kCell_m, 2);

  for (int i = 0; i < 10; ++i) seen.mark_hit({i * seen.tile_m() + 0.05, 0.05});

  EXPECT_EQ(seen.state().tiles.size(), 2U);
  EXPECT_TRUE(known(seen, {0.05, 0.05}));
  EXPECT_TRUE(known(seen, {seen.tile_m() + 0.05, 0.05}));
  EXPECT_FALSE(known(seen, {2 * seen.tile_m() + 0.05, 0.05}));
}

TEST(SeenMap, GoesOnAfterSavingAndLoading) {
  SeenMap seen(kCell_m, 100);
  seen.mark_free(Sector(Vec2(1, 1), 1.5));
  seen.mark_suspected({4, -4});
  core::StateWriter writer;
  writer(seen.state());
  SeenMap loaded(kCell_m, 100);

  core::StateReader reader(writer.bytes());
  SeenMap::State state;
  reader(state);
  loaded.restore(std::move(state));

  EXPECT_TRUE(reader.complete());
  core::StateWriter again;
  again(loaded.state());
  EXPECT_EQ(again.bytes(), writer.bytes());
  EXPECT_TRUE(loaded.is(Mark::kFree, {1, 1}));
}

/// Tiles here and there; the box is that of those near enough, looked at one by one.
TEST(SeenMap, FindsTheBoxOfTheTilesWithinReach) {
  SeenMap seen(kCell_m, 1000);
  const double tile_m = seen.tile_m();
  for (int i = 0; i < 60; ++i) {
    seen.mark_hit({tile_m * (i * 37 % 41 - 20.0 + 0.5), tile_m * (i * 23 % 43 - 21.0 + 0.5)});
  }
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2 place(tile_m * (i * 7 % 30 - 15.0 + 0.01 * i), tile_m * (i * 11 % 30 - 15.0));
    const double reach_m = i % 30 == 7 ? 1e4 : tile_m * (0.5 + i % 23);
    std::optional<SeenMap::Box> expected;
    for (const auto& entry : seen.state().tiles) {
      const SeenMap::TileKey& key = entry.first;
      if (seen.distance_m(key, place) > reach_m) continue;
      if (!expected) expected = SeenMap::Box{key, key};
      auto& [least, most] = *expected;
      least = {std::min(least.first, key.first), std::min(least.second, key.second)};
      most = {std::max(most.first, key.first), std::max(most.second, key.second)};
    }

    const auto box = seen.box_within(place, reach_m);

    ASSERT_EQ(box.has_value(), expected.has_value()) << i;
    if (!box) continue;
    ++found;
    EXPECT_EQ(box->least, expected->least) << i;
    EXPECT_EQ(box->most, expected->most) << i;
  }
  EXPECT_GT(found, 200);
  EXPECT_LT(found, 300);
}

}  // namespace
}  // namespace clew::map
