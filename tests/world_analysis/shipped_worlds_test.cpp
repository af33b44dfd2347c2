// SPDX-License-Identifier: Apache-2.0
/// What is computed here against what the shipped worlds' files state, which was found by others.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "small_world.hpp"
#include "tests/source_path.hpp"
#include "world_analysis/bug_bounds.hpp"
#include "world_analysis/reachability.hpp"
#include "world_analysis/shortest_path.hpp"

namespace clew::world_analysis {
namespace {

std::vector<world::World> shipped_worlds() {
  std::vector<world::World> worlds;
  const std::filesystem::path folder = tests::source_path("configs/worlds");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    auto world = world::World::parse(text.str(), entry.path().string());
    if (world.ok() && world->moving().empty()) worlds.push_back(std::move(world).value());
  }
  return worlds;
}

TEST(ShippedWorlds, AreAsSolvableAndAsLongAsTheySay) {
  const auto worlds = shipped_worlds();

  std::size_t with_path = 0;
  for (const world::World& world : worlds) {
    const ClearanceGrid grid(world, 0.0);
    const auto wanted = world.solvable().value_or(true) ? Solvable::kYes : Solvable::kNo;
    EXPECT_EQ(is_solvable(grid, kRadius_m, 0.02), wanted) << world.name();
    const auto path = shortest_path(grid, kRadius_m);
    EXPECT_EQ(path.has_value(), world.shortest_path_m().has_value()) << world.name();
    if (!path || !world.shortest_path_m()) continue;
    ++with_path;
    EXPECT_NEAR(path->length_m / *world.shortest_path_m(), 1.0, 0.01) << world.name();
    // No robot's worst case is shorter than the best way there is.
    const BugBounds bug = bug_bounds(grid, kRadius_m);
    EXPECT_GE(1.01 * bug.bug1_m, path->length_m) << world.name();
    EXPECT_GE(1.01 * bug.bug2_m, path->length_m) << world.name();
  }
  EXPECT_GE(with_path, 60u);
}

}  // namespace
}  // namespace clew::world_analysis
