// SPDX-License-Identifier: Apache-2.0
#include "trap_worlds/generated_world.hpp"

#include <gtest/gtest.h>

#include <map>
#include <queue>
#include <set>

#include "core/geometry.hpp"
#include "world/world.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::trap_worlds {
namespace {

constexpr double kRadius_m = 0.15;
constexpr int kCount = 3;

const Family& family(const std::string& name) {
  for (const Family& candidate : families()) {
    if (candidate.name == name) return candidate;
  }
  ADD_FAILURE() << "no family " << name;
  return families().front();
}

world::World parsed(const GeneratedWorld& generated) {
  auto world = world::World::parse(generated.text, generated.name);
  if (!world.ok()) ADD_FAILURE() << world.error().text();
  return std::move(world).value();
}

/// The length of the shortest way of steps of 0.08 m in eight directions from the start, each a
/// motion of the robot's own disc; none if no place within the target's radius is reached, nor one
/// a step from the target with a free line to it. It shares nothing with the lattice that the
/// generator computes on.
std::optional<double> flood_length_m(const world::World& world) {
  constexpr double kStep_m = 0.08;
  const double time_s = world_analysis::settled_time_s(world).value_or(0.0);
  using Cell = std::pair<int, int>;
  std::map<Cell, double> lengths_m;
  std::set<Cell> done;
  std::priority_queue<std::pair<double, Cell>> open;
  const auto position = [&](const Cell& cell) {
    return core::Vec2(world.start().x_m + kStep_m * cell.first,
                      world.start().y_m + kStep_m * cell.second);
  };
  lengths_m[{0, 0}] = 0.0;
  open.push({0.0, {0, 0}});
  while (!open.empty()) {
    const Cell cell = open.top().second;
    open.pop();
    if (!done.insert(cell).second) continue;
    const core::Vec2 from = position(cell);
    const double off_m = core::length(from - world.target());
    const auto is_free = [&](const core::Vec2& to) {
      return !world.sweep_disc(from, to, kRadius_m, time_s, 0.0).contact;
    };
    if (off_m <= world.target_radius_m()) return lengths_m[cell];
    if (off_m <= kStep_m && is_free(world.target())) return lengths_m[cell] + off_m;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Cell next{cell.first + dx, cell.second + dy};
        const core::Vec2 to = position(next);
        const double length_m = lengths_m[cell] + core::length(to - from);
        const auto known = lengths_m.find(next);
        if (known != lengths_m.end() && known->second <= length_m) continue;
        if (!is_free(to)) continue;
        lengths_m[next] = length_m;
        open.push({-length_m, next});
      }
    }
  }
  return std::nullopt;
}

TEST(GeneratedWorld, TheSameOrderGivesTheSameBytes) {
  for (const Family& candidate : families()) {
    const WorldOrder order{&candidate, 7, 1, kCount};

    EXPECT_EQ(generate_world(order).text, generate_world(order).text) << candidate.name;
  }
}

TEST(GeneratedWorld, IsKnownToTheByte) {
  // A change of these bytes changes the worlds behind published tables.
  const GeneratedWorld world = generate_world({&family("dead-end-corridor"), 1, 0, 2});

  EXPECT_EQ(world.text, R"(format: clew-world/1
name: dead-end-corridor-s1-01
about: "narrow corridor toward the target, closed at its end; depth 0.30 sensing ranges (0.45 m), width 1.13 m; deepest trap 0.45 m. Seed 1, 1 of 2."
bounds: [-2.57, -3.3, 2.567, 3.486]
walls: [
  [-0.57, -0.446, -0.567, 0.004],
  [-0.567, 0.004, 0.567, -0.004],
  [0.567, -0.004, 0.565, -0.454]]
start: [-0.05, -1.3, 1.401]
target: [0.428, 1.486]
target_radius: 0.2
solvable: true
shortest_path: 3.132
)");
}

TEST(GeneratedWorld, AnotherSeedOrNumberGivesAnotherWorld) {
  std::set<std::string> texts;

  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    for (int number = 0; number < kCount; ++number) {
      texts.insert(generate_world({&family("u"), seed, number, kCount}).text);
    }
  }

  EXPECT_EQ(texts.size(), 3u * kCount);
}

TEST(GeneratedWorld, DepthsGoFromTheLeastToTheMost) {
  EXPECT_DOUBLE_EQ(generate_world({&family("u"), 1, 0, kCount}).depth_ranges, 0.3);
  EXPECT_NEAR(generate_world({&family("u"), 1, kCount - 1, kCount}).depth_ranges, 4.0, 1e-12);
}

TEST(GeneratedWorld, StatesItsFamilyAndParameters) {
  const auto world = parsed(generate_world({&family("u"), 5, 1, kCount}));

  EXPECT_EQ(world.name(), "u-s5-02");
  EXPECT_NE(world.about().find("U open to the start; depth 1.10 sensing ranges (1.64 m), width "),
            std::string::npos)
      << world.about();
  EXPECT_NE(world.about().find("Seed 5, 2 of 3."), std::string::npos) << world.about();
}

class EveryFamily : public testing::TestWithParam<Family> {};

TEST_P(EveryFamily, IsAsSolvableAndAsLongAsItsFilesSay) {
  for (int number = 0; number < kCount; ++number) {
    const auto world = parsed(generate_world({&GetParam(), 3, number, kCount}));
    SCOPED_TRACE(world.name());

    const auto length_m = flood_length_m(world);

    EXPECT_EQ(world.solvable(), GetParam().solvable);
    EXPECT_EQ(length_m.has_value(), GetParam().solvable);
    // Where something moves, the way of the walls may or may not be told.
    if (world.moving().empty()) {
      EXPECT_EQ(world.shortest_path_m().has_value(), GetParam().solvable);
    }
    if (!length_m || !world.shortest_path_m()) continue;
    // Eight directions are at most 8.3 % longer, corners at most a step each, and the flood ends at
    // the target's rim.
    EXPECT_LE(*length_m, 1.1 * *world.shortest_path_m() + 0.3);
    EXPECT_GE(*length_m, 0.99 * *world.shortest_path_m() - world.target_radius_m() - 0.1);
  }
}

TEST_P(EveryFamily, HasTheTrapsThatItClaims) {
  for (int number = 0; number < kCount; ++number) {
    const auto world = parsed(generate_world({&GetParam(), 4, number, kCount}));
    SCOPED_TRACE(world.name());
    const world_analysis::ClearanceGrid grid(world, *world_analysis::settled_time_s(world));
    const world_analysis::TrapMap map(grid, kRadius_m, kLeastTrapDepth_m);

    if (GetParam().traps != TrapClaim::kAny && is_of_traps(GetParam())) {
      EXPECT_EQ(map.traps().empty(), GetParam().traps == TrapClaim::kNone);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::ValuesIn(families()),
                         [](const testing::TestParamInfo<Family>& one) {
                           std::string name = one.param.name;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(Families, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Family& candidate : families()) names.insert(candidate.name);

  EXPECT_EQ(names.size(), families().size());
}

}  // namespace
}  // namespace clew::trap_worlds
