// SPDX-License-Identifier: Apache-2.0
#include "hunt/shrink.hpp"

#include <gtest/gtest.h>

#include "hunt/world_edit.hpp"
#include "runtime/config_source.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

const runtime::ConfigPath& configs() {
  static const runtime::ConfigPath all({tests::source_path("configs")});
  return all;
}

const Workshop& workshop() {
  static const Workshop all{configs(), stages::all()};
  return all;
}

Property property(const std::string& text) { return std::move(Property::parse(text, "p")).value(); }

/// The graph without recovery in the U that it never leaves, with things around that do not matter.
RunCase caught() {
  RunCase which;
  which.graph.graph = "reactive";
  which.graph.max_ticks = 300;
  which.world_file = "cluttered.yaml";
  which.seed = 77;
  which.world_text = R"(format: clew-world/1
name: cluttered
bounds: [0, 0, 12, 12]
walls: [[3, 3.5, 3, 7.5], [3, 7.5, 7, 7.5], [7, 7.5, 7, 3.5], [9, 1, 11, 1], [9, 2, 11, 2], [1, 10, 2, 11]]
polygons: [[[9, 9], [10, 9], [10.5, 9.5], [10, 10], [9, 10]]]
circles: [[1, 5, 0.3], [1, 8, 0.4], [10, 5, 0.5]]
moving: [{circle: [9, 7, 0.2], path: [[0, 9, 7], [5, 10, 7]]}]
start: [5, 1.5, 1.571]
target: [5.1, 9]
target_radius: 0.2
)";
  return which;
}

TEST(Shrink, LeavesTheTrapAndNothingElse) {
  const Property sought = property("outcome == reached");

  const auto shrunk = shrink(caught(), sought, workshop(), {});

  ASSERT_TRUE(shrunk.ok()) << shrunk.error().text();
  EXPECT_EQ(shrunk->end, Shrunk::End::kMinimal);
  EXPECT_EQ(shrunk->parts_before, 11u);
  EXPECT_LE(shrunk->parts_after, 3u);
  EXPECT_GE(shrunk->parts_after, 1u);
  EXPECT_EQ(shrunk->outcome, "timeout");
  EXPECT_EQ(shrunk->which.seed, 1u);
  const auto again = run_case(shrunk->which, sought, workshop());
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(sought.judge((*again)->values).holds, false);
  EXPECT_EQ((*again)->hash, shrunk->hash);
}

TEST(Shrink, LeavesNoPartThatCanBeMissed) {
  const Property sought = property("outcome == reached");
  const auto shrunk = shrink(caught(), sought, workshop(), {});
  ASSERT_TRUE(shrunk.ok());
  const auto world = world::read_world_file(shrunk->which.world_text, "w");
  ASSERT_TRUE(world.ok());

  for (std::size_t i = 0; i < world->walls.size(); ++i) {
    world::WorldFile less = *world;
    less.walls.erase(less.walls.begin() + static_cast<std::ptrdiff_t>(i));
    RunCase which = shrunk->which;
    which.world_text = world_text(less);
    const auto outcome = run_case(which, sought, workshop());
    ASSERT_TRUE(outcome.ok()) << outcome.error().text();
    EXPECT_EQ(sought.judge((*outcome)->values).holds, true) << "without wall " << i;
  }
}

TEST(Shrink, SaysThatThereIsNothingToShrink) {
  const auto holds = shrink(caught(), property("outcome == timeout"), workshop(), {});
  const auto undecided = shrink(caught(), property("1 / collisions > 0"), workshop(), {});

  ASSERT_TRUE(holds.ok());
  EXPECT_EQ(holds->end, Shrunk::End::kHolds);
  ASSERT_TRUE(undecided.ok());
  EXPECT_EQ(undecided->end, Shrunk::End::kUndecided);
}

TEST(Shrink, StopsWhenItsRunsAreUsedUp) {
  ShrinkOptions options;
  options.most_runs = 5;

  const auto shrunk = shrink(caught(), property("outcome == reached"), workshop(), options);

  ASSERT_TRUE(shrunk.ok());
  EXPECT_EQ(shrunk->end, Shrunk::End::kOutOfRuns);
  EXPECT_EQ(shrunk->runs, 5u);
}

}  // namespace
}  // namespace clew::hunt
