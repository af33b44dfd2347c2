// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include "core/math.hpp"
#include "domain/words.hpp"
#include "recover/escapes/cut_proof.hpp"
#include "recover/escapes/map_following.hpp"

namespace clew::recover {
namespace {

// What is told of the costs: as many cells on each side of the robot.
constexpr std::int32_t kReach = 40;
constexpr double kCosts_m = 2.1;

domain::PictureCell cell_of(const map::Grid& grid, const map::Cell& cell, double value) {
  const core::Vec2 middle = grid.centre(cell);
  const double half_m = 0.5 * grid.cell_m;
  return {{middle + core::Vec2(-half_m, -half_m), middle + core::Vec2(half_m, -half_m),
           middle + core::Vec2(half_m, half_m), middle + core::Vec2(-half_m, half_m)},
          value};
}

/// The cheapest and the dearest cell that the robot fits into, of those around it.
std::pair<double, double> range_of(const map::Costmap& costs, const map::Cell& robot) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::int32_t row = robot.row - kReach; row <= robot.row + kReach; ++row) {
    for (std::int32_t column = robot.column - kReach; column <= robot.column + kReach; ++column) {
      if (!costs.grid.contains({column, row})) continue;
      const double cost = static_cast<double>(costs.cost[costs.grid.index({column, row})]);
      if (cost > 0.0) least = std::min(least, cost);
      most = std::max(most, cost);
    }
  }
  return {std::min(least, most), most};
}

/// The costs around the robot by which a path would be sought now.
void tell_costs(const map::Costmap& costs, const core::Vec2& place, domain::Inside& inside) {
  const auto robot = costs.grid.cell_at(place);
  if (!robot) return;
  const auto [least, most] = range_of(costs, *robot);
  const double span = core::log(std::max(most, 1.0) / std::max(least, 1.0));
  domain::PictureLayer dear{"cost of a metre", domain::PictureLayer::Kind::kValues, {}, {}};
  domain::PictureLayer blocked{
      "no room for the body", domain::PictureLayer::Kind::kBlocked, {}, {}};
  domain::InsideGrid told{2 * kReach + 1, {}, "cell, along x", "cell, y from the top", {}};
  for (std::int32_t row = robot->row + kReach; row >= robot->row - kReach; --row) {
    for (std::int32_t column = robot->column - kReach; column <= robot->column + kReach; ++column) {
      const map::Cell cell{column, row};
      const bool known = costs.grid.contains(cell);
      const double cost = known ? static_cast<double>(costs.cost[costs.grid.index(cell)]) : least;
      // Where there is no room costs more than all that can be paid.
      told.values.push_back(cost > 0.0 ? cost : most + 1.0);
      if (!known || cost == least) continue;
      const double share = span > 0.0 ? core::log(cost / least) / span : 1.0;
      if (cost > 0.0) dear.cells.push_back(cell_of(costs.grid, cell, share));
      if (cost <= 0.0) blocked.cells.push_back(cell_of(costs.grid, cell, 0.0));
    }
  }
  told.marked = told.values.size() / 2;
  domain::InsideGroup& group = inside.values.group("costs");
  group.number("cell", costs.grid.cell_m, "m");
  group.number("cheapest", least);
  group.number("dearest", most);
  group.number("cells_without_room", static_cast<double>(blocked.cells.size()));
  group.grid("cost_of_a_metre", std::move(told));
  inside.picture.layers.push_back(std::move(dear));
  inside.picture.layers.push_back(std::move(blocked));
}

}  // namespace

void MapFollowing::tell(const Situation& situation, domain::Inside& inside) const {
  const core::Vec2 place = situation.pose().position();
  tell_costs(path_.costs_around(path_request(situation), kCosts_m), place, inside);
  const double still_s = static_cast<double>(situation.tick - state_.progress_tick) * tick_s_;
  inside.values.flag("path_exists", path_.exists());
  inside.values.bound("ended_last_at", state_.ended_at_m, "m");
  inside.values.number("without_progress", still_s, "s");
  inside.values.number("patience", parameters_.patience_s, "s");
  inside.values.number("refused_places", static_cast<double>(path_.refused_odom().size()));
  if (path_.exists()) {
    const double length_m = path_.length_m(place);
    const double rise_m = path_.rise_m(place, situation.target_odom);
    inside.values.number("path_length", length_m, "m");
    inside.values.number("path_rise", rise_m, "m");
    inside.values.number("leaves_below_rise", parameters_.leave_rise_m, "m");
    for (const core::Vec2& corner : path_.corners_odom()) {
      domain::InsideGroup& item = inside.values.item("path");
      item.number("x", corner.x(), "m");
      item.number("y", corner.y(), "m");
    }
    inside.picture.layers.push_back(
        {"known path", domain::PictureLayer::Kind::kWay, {}, path_.corners_odom()});
    inside.say("The known path is " + domain::say_metres(length_m) + " long with " +
               domain::say_count(path_.corners_odom().size(), "corner") +
               ", and leads away from the target by " + domain::say_metres(rise_m) +
               " before it leads there.");
  } else {
    inside.say("What was seen closes every way.");
  }
  inside.picture.layers.push_back(
      {"places that were refused", domain::PictureLayer::Kind::kPoints, {}, path_.refused_odom()});
  proof_.tell(situation, inside);
}

void CutProof::tell(const Situation& situation, domain::Inside& inside) const {
  domain::InsideGroup& proof = inside.values.group("proof_that_nothing_leads_there");
  proof.flag("cut", state_.cut);
  proof.flag("last_look", state_.last_look);
  proof.number("needed", proof_s_, "s");
  if (!state_.cut) return;
  const double stood_s = static_cast<double>(situation.tick - state_.since_tick) * tick_s_;
  proof.number("stood_for", stood_s, "s");
  inside.say("Every way has been cut for " + domain::say_seconds(stood_s) + "; after " +
             domain::say_seconds(proof_s_) + " and one look more the target is unreachable.");
}

}  // namespace clew::recover
