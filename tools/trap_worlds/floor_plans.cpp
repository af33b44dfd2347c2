// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <utility>

#include "core/angle.hpp"
#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

constexpr double kLeastDoor_m = 0.36;
constexpr double kMostDoor_m = 1.0;
constexpr double kCorridor_m = 0.9;
// Walls outside the tree that get an opening, too: each closes a loop.
constexpr double kLoops = 0.15;

/// Rooms side by side in columns and rows; their borders from the left and from below.
struct FloorPlan {
  std::vector<double> x_m{0.0};
  std::vector<double> y_m{0.0};

  std::size_t columns() const { return x_m.size() - 1; }
  std::size_t rows() const { return y_m.size() - 1; }
  Vec2 middle(std::size_t room) const {
    const std::size_t column = room % columns();
    const std::size_t row = room / columns();
    return {0.5 * (x_m[column] + x_m[column + 1]), 0.5 * (y_m[row] + y_m[row + 1])};
  }
  Vec2 half(std::size_t room) const {
    return middle(room) - Vec2(x_m[room % columns()], y_m[room / columns()]);
  }
};

/// A wall between two rooms.
struct InnerWall {
  std::size_t room = 0;
  std::size_t other = 0;
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  bool opens = false;
};

std::vector<InnerWall> inner_walls(const FloorPlan& plan) {
  std::vector<InnerWall> walls;
  for (std::size_t row = 0; row < plan.rows(); ++row) {
    for (std::size_t column = 0; column < plan.columns(); ++column) {
      const std::size_t room = row * plan.columns() + column;
      const Vec2 corner(plan.x_m[column + 1], plan.y_m[row + 1]);
      if (column + 1 < plan.columns()) {
        walls.push_back({room, room + 1, {corner.x(), plan.y_m[row]}, corner});
      }
      if (row + 1 < plan.rows()) {
        walls.push_back({room, room + plan.columns(), {plan.x_m[column], corner.y()}, corner});
      }
    }
  }
  return walls;
}

/// The walls in any order, with openings that form a tree over all rooms (Kruskal 1956), and some
/// more.
std::vector<InnerWall> opened_walls(Dice& dice, const FloorPlan& plan) {
  std::vector<InnerWall> walls = inner_walls(plan);
  for (std::size_t i = walls.size(); i > 1; --i) {
    std::swap(walls[i - 1],
              walls[static_cast<std::size_t>(dice.count(0, static_cast<int>(i) - 1))]);
  }
  std::vector<std::size_t> root(plan.columns() * plan.rows());
  std::iota(root.begin(), root.end(), 0);
  const auto root_of = [&](std::size_t room) {
    while (root[room] != room) room = root[room];
    return room;
  };
  for (InnerWall& wall : walls) {
    const std::size_t one = root_of(wall.room);
    const std::size_t other = root_of(wall.other);
    wall.opens = one != other || dice.between(0.0, 1.0) < kLoops;
    root[one] = other;
  }
  return walls;
}

void add_outer_walls(const FloorPlan& plan, WorldDraft& draft) {
  const Vec2 most(plan.x_m.back(), plan.y_m.back());
  draft.add_walls({{0.0, 0.0}, {most.x(), 0.0}, most, {0.0, most.y()}, {0.0, 0.0}});
  draft.border_m = 0.3;
}

void add_door(Dice& dice, const InnerWall& wall, WorldDraft& draft) {
  const double length_m = core::length(wall.to - wall.from);
  const double door_m = std::min(dice.between(kLeastDoor_m, kMostDoor_m), length_m);
  const double first_m = dice.between(0.0, length_m - door_m);
  const Vec2 along = (wall.to - wall.from) / length_m;
  if (first_m > 0.0) draft.add_walls({wall.from, wall.from + first_m * along});
  if (first_m + door_m < length_m) {
    draft.add_walls({wall.from + (first_m + door_m) * along, wall.to});
  }
}

/// Start and target in two rooms, anywhere in the middle half of each.
void set_out(Dice& dice, const FloorPlan& plan, WorldDraft& draft) {
  const int last = static_cast<int>(plan.columns() * plan.rows()) - 1;
  const int first = dice.count(0, last);
  const int other = (first + dice.count(1, last)) % (last + 1);
  const auto place_in = [&](int room) -> Vec2 {
    const auto index = static_cast<std::size_t>(room);
    const double along_y = dice.between(-0.5, 0.5);
    const Vec2 share(dice.between(-0.5, 0.5), along_y);
    return plan.middle(index) + share.cwiseProduct(plan.half(index));
  };
  draft.start = place_in(first);
  draft.target = place_in(other);
  draft.target_radius_m = dice.between(0.05, 0.3);
  draft.off_target_rad = dice.between(-core::kPi, core::kPi);
}

/// More rooms or corridors with depth: 3 to 3 + `most` a side.
int side_of(Dice& dice, double depth_m, int most) {
  return 3 + std::min(most, dice.count(0, 1) + static_cast<int>(depth_m));
}

/// A thing in a room: round, a piece of wall from its side, or a triangle.
void add_furniture(Dice& dice, const FloorPlan& plan, std::size_t room, WorldDraft& draft) {
  const Vec2 half = plan.half(room);
  const double along_y = dice.between(-0.8, 0.8);
  const Vec2 share(dice.between(-0.8, 0.8), along_y);
  const Vec2 place = plan.middle(room) + share.cwiseProduct(half);
  const double turned_rad = dice.between(-core::kPi, core::kPi);
  switch (dice.count(0, 2)) {
    case 0:
      draft.circles.push_back({place, dice.between(0.05, 0.3)});
      break;
    case 1: {
      const Vec2 side = plan.middle(room) + Vec2(share.x() * half.x(), half.y());
      draft.add_walls({side, side - Vec2(0.0, dice.between(0.3, 1.3) * half.y())});
      break;
    }
    default: {
      // Drawn one by one: what is drawn first must not be a matter of the compiler.
      const double first_m = dice.between(0.2, 0.8);
      const double second_rad = turned_rad + dice.between(0.5, 2.5);
      const double second_m = dice.between(0.2, 0.8);
      draft.polygons.push_back({place, place + first_m * core::direction(turned_rad),
                                place + second_m * core::direction(second_rad)});
    }
  }
}

}  // namespace

WorldDraft draw_rooms(Dice& dice, double depth_m) {
  WorldDraft draft;
  FloorPlan plan;
  const int side = side_of(dice, 0.5 * depth_m, 3);
  for (int i = 0; i < side; ++i) plan.x_m.push_back(plan.x_m.back() + dice.between(1.5, 4.0));
  for (int i = 0; i < side; ++i) plan.y_m.push_back(plan.y_m.back() + dice.between(1.5, 4.0));
  draft.say_count("rooms", side * side);
  add_outer_walls(plan, draft);
  for (const InnerWall& wall : opened_walls(dice, plan)) {
    if (wall.opens) {
      add_door(dice, wall, draft);
    } else {
      draft.add_walls({wall.from, wall.to});
    }
  }
  set_out(dice, plan, draft);
  return draft;
}

WorldDraft draw_maze(Dice& dice, double depth_m) {
  WorldDraft draft;
  FloorPlan plan;
  const int side = side_of(dice, depth_m, 7);
  for (int i = 1; i <= side; ++i) plan.x_m.push_back(kCorridor_m * i);
  plan.y_m = plan.x_m;
  draft.say_count("cells", side * side);
  add_outer_walls(plan, draft);
  for (const InnerWall& wall : opened_walls(dice, plan)) {
    if (!wall.opens) draft.add_walls({wall.from, wall.to});
  }
  set_out(dice, plan, draft);
  return draft;
}

WorldDraft draw_mix(Dice& dice, double depth_m) {
  WorldDraft draft;
  FloorPlan plan;
  const int side = side_of(dice, 0.5 * depth_m, 3);
  const auto width_m = [&] { return dice.coin() ? kCorridor_m : dice.between(1.5, 3.5); };
  for (int i = 0; i < side; ++i) plan.x_m.push_back(plan.x_m.back() + width_m());
  for (int i = 0; i < side; ++i) plan.y_m.push_back(plan.y_m.back() + width_m());
  draft.say_count("rooms and corridors", side * side);
  add_outer_walls(plan, draft);
  for (const InnerWall& wall : opened_walls(dice, plan)) {
    if (!wall.opens) {
      draft.add_walls({wall.from, wall.to});
    } else if (dice.coin()) {
      add_door(dice, wall, draft);
    }
  }
  for (std::size_t room = 0; room < plan.columns() * plan.rows(); ++room) {
    const bool has_room = plan.half(room).minCoeff() > kCorridor_m;
    if (has_room && dice.coin()) add_furniture(dice, plan, room, draft);
  }
  set_out(dice, plan, draft);
  return draft;
}

}  // namespace clew::trap_worlds
