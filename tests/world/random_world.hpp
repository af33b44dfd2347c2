// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/random.hpp"
#include "world/world.hpp"

namespace clew::world {

/// Numbers one after the other from a seed, for tests.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(core::RandomKey{seed, 0, 0, 0}) {}

  double between(double low, double high) { return low + (high - low) * random_.uniform(next_++); }
  Vec2 point(double low, double high) {
    const double x = between(low, high);
    return {x, between(low, high)};
  }

 private:
  core::Random random_;
  std::uint32_t next_ = 0;
};

/// A world from the text of its obstacles (`walls: ...`), bounds [0, 0, size, size], start and
/// target in two corners 0.01 m from the boundary.
World make_world(const std::string& obstacles, double size_m = 10.0);

/// A world of 10 m by 10 m with walls, polygons, circles and, if asked for, moving discs.
World random_world(std::uint64_t seed, bool moving);

/// A world of 10 m by 10 m with short walls.
World world_of_walls(std::size_t count, std::uint64_t seed, double size_m);

/// Everything of a world that stands still, as primitives: with the boundary and polygons' sides.
std::vector<World::Segment> all_segments(const World& world);

}  // namespace clew::world
