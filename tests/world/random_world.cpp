// SPDX-License-Identifier: Apache-2.0
#include "random_world.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "world/polygon.hpp"

namespace clew::world {
namespace {

// A star around a centre, with points at growing angles: simple, and convex only by chance.
std::string star(Dice& dice, const Vec2& centre) {
  const int points = 3 + static_cast<int>(dice.between(0.0, 6.0));
  std::string text = "[";
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * core::kPi * (i + dice.between(0.0, 0.9)) / points;
    const Vec2 p = centre + dice.between(0.2, 1.2) * core::direction(angle);
    text += fmt::format("[{}, {}],", p.x(), p.y());
  }
  return text + "],";
}

}  // namespace

World make_world(const std::string& obstacles, double size_m) {
  const std::string yaml = fmt::format(
      "format: clew-world/1\nname: test\nbounds: [0, 0, {0}, {0}]\nstart: [0.01, 0.01, 0]\n"
      "target: [{1}, {1}]\ntarget_radius: 0.2\n{2}\n",
      size_m, size_m - 0.01, obstacles);
  auto world = World::parse(yaml, "test.yaml");
  if (!world.ok()) ADD_FAILURE() << world.error().text();
  return *std::move(world);
}

// Everything keeps 0.5 m from the corners with start and target.
World random_world(std::uint64_t seed, bool moving) {
  Dice dice(seed);
  std::string text = "walls: [";
  for (int i = 0; i < 12; ++i) {
    const Vec2 a = dice.point(1.0, 9.0);
    const Vec2 b = a + Vec2(dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
    text += fmt::format("[{}, {}, {}, {}],", a.x(), a.y(), b.x(), b.y());
  }
  text += "]\npolygons: [";
  for (int i = 0; i < 4; ++i) text += star(dice, dice.point(2.0, 8.0));
  text += "]\ncircles: [";
  for (int i = 0; i < 6; ++i) {
    const Vec2 c = dice.point(1.5, 8.5);
    text += fmt::format("[{}, {}, {}],", c.x(), c.y(), dice.between(0.05, 0.6));
  }
  text += "]\nmoving: [";
  for (int i = 0; moving && i < 3; ++i) {
    const Vec2 a = dice.point(1.5, 8.5);
    const Vec2 b = dice.point(1.5, 8.5);
    text += fmt::format(
        "{{circle: [{0}, {1}, {2}], path: [[0, {0}, {1}], [{3}, {4}, {5}], "
        "[{6}, {0}, {1}]], loop: true}},",
        a.x(), a.y(), dice.between(0.1, 0.4), dice.between(3.0, 8.0), b.x(), b.y(),
        dice.between(9.0, 15.0));
  }
  return make_world(text + "]");
}

World world_of_walls(std::size_t count, std::uint64_t seed, double size_m) {
  Dice dice(seed);
  std::string text = "walls: [\n";
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = dice.point(1.0, size_m - 1.0);
    const Vec2 b = a + Vec2(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5));
    text += fmt::format("  [{:.4f}, {:.4f}, {:.4f}, {:.4f}],\n", a.x(), a.y(), b.x(), b.y());
  }
  return make_world(text + "]", size_m);
}

std::vector<World::Segment> all_segments(const World& world) {
  std::vector<World::Segment> segments = world.walls();
  std::vector<Polygon> outlines = world.polygons();
  const Vec2 min = world.bounds_min();
  const Vec2 max = world.bounds_max();
  outlines.push_back({min, {max.x(), min.y()}, max, {min.x(), max.y()}});
  for (const Polygon& outline : outlines) {
    for (const World::Segment& edge : edges_of(outline)) segments.push_back(edge);
  }
  return segments;
}

}  // namespace clew::world
