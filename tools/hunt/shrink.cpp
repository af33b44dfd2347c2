// SPDX-License-Identifier: Apache-2.0
#include "hunt/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hunt/delta_debugging.hpp"
#include "hunt/world_edit.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using core::Vec2;
using world::WorldFile;

constexpr double kLeastWall_m = 0.1;
/// A robot that goes in circles could be started further along for ever.
constexpr std::size_t kMostAdvances = 3;

/// The world with those of its parts whose numbers are given, in rising order.
WorldFile with_parts(const WorldFile& world, const std::vector<std::size_t>& parts) {
  WorldFile reduced = world;
  std::size_t first = 0;
  const auto keep = [&](auto& items) {
    const auto all = std::move(items);
    items = {};
    for (const std::size_t part : parts) {
      if (part >= first && part < first + all.size()) items.push_back(all[part - first]);
    }
    first += all.size();
  };
  keep(reduced.walls);
  keep(reduced.polygons);
  keep(reduced.circles);
  keep(reduced.moving);
  keep(reduced.subgoals);
  return reduced;
}

double rounded(double value, double step) {
  // A multiple of 0.1 as 3.7 and not as 3.7000000000000002.
  const double per_one = std::round(1.0 / step);
  return std::round(value * per_one) / per_one;
}

WorldFile rounded(WorldFile world, double step) {
  const auto round = [step](Vec2& p) { p = Vec2(rounded(p.x(), step), rounded(p.y(), step)); };
  round(world.bounds_min);
  round(world.bounds_max);
  for (auto& wall : world.walls) {
    round(wall.a);
    round(wall.b);
  }
  for (auto& polygon : world.polygons) std::for_each(polygon.begin(), polygon.end(), round);
  for (auto& circle : world.circles) {
    round(circle.centre);
    circle.radius_m = rounded(circle.radius_m, step);
  }
  for (auto& moving : world.moving) {
    for (auto& point : moving.path) round(point.position);
  }
  round(world.target);
  world.start.x_m = rounded(world.start.x_m, step);
  world.start.y_m = rounded(world.start.y_m, step);
  world.start.heading_rad = rounded(world.start.heading_rad, step);
  return world;
}

/// Whether a wall has become a point.
bool has_vanished(const WorldFile& world) {
  return std::any_of(world.walls.begin(), world.walls.end(), [](const auto& wall) {
    return core::length(wall.b - wall.a) < kLeastWall_m / 2.0;
  });
}

/// The bounds that leave this much room around all that is in the world.
WorldFile with_room(WorldFile world, double room_m) {
  Vec2 low = world.target;
  Vec2 high = world.target;
  const auto add = [&](const Vec2& p, double radius_m) {
    low = Vec2(std::min(low.x(), p.x() - radius_m), std::min(low.y(), p.y() - radius_m));
    high = Vec2(std::max(high.x(), p.x() + radius_m), std::max(high.y(), p.y() + radius_m));
  };
  add(world.start.position(), 0.0);
  for (const auto& wall : world.walls) {
    add(wall.a, 0.0);
    add(wall.b, 0.0);
  }
  for (const auto& polygon : world.polygons) {
    for (const Vec2& corner : polygon) add(corner, 0.0);
  }
  for (const auto& circle : world.circles) add(circle.centre, circle.radius_m);
  for (const auto& moving : world.moving) {
    for (const auto& point : moving.path) add(point.position, moving.radius_m);
  }
  for (const Vec2& subgoal : world.subgoals) add(subgoal, 0.0);
  const Vec2 room(room_m, room_m);
  world.bounds_min = world.bounds_min.cwiseMax(low - room);
  world.bounds_max = world.bounds_max.cwiseMin(high + room);
  return world;
}

/// A case that fails, and how it fails: what every smaller one must do as well.
class Shrinker {
 public:
  Shrinker(const Property& property, const Workshop& workshop, const ShrinkOptions& options)
      : property_(property), workshop_(workshop), options_(options) {}

  Result<Shrunk> run(const RunCase& which) {
    CLEW_RETURN_IF_ERROR(begin(which));
    if (result_.end != Shrunk::End::kMinimal) return result_;
    while (goes_on() && reduce_once()) {
    }
    if (!error_.message.empty()) return error_;
    if (interrupted_) {
      result_.end = Shrunk::End::kInterrupted;
    } else if (result_.runs >= options_.most_runs) {
      result_.end = Shrunk::End::kOutOfRuns;
    }
    result_.parts_after = parts_of(world_);
    return result_;
  }

 private:
  bool goes_on() const {
    return result_.runs < options_.most_runs && !interrupted_ && error_.message.empty();
  }

  Result<void> begin(const RunCase& which) {
    auto world = world::read_world_file(which.world_text, which.world_file);
    if (!world.ok()) return world.error();
    world_ = std::move(world).value();
    result_.which = which;
    result_.parts_before = result_.parts_after = parts_of(world_);
    const auto plan = plan_case(which, workshop_);
    if (!plan.ok()) return plan.error();
    radius_m_ = plan->setup.behaviour.robot.radius_m;
    const auto outcome = run_case(which, property_, workshop_);
    if (!outcome.ok()) return outcome.error();
    ++result_.runs;
    if (!*outcome) {
      result_.end = Shrunk::End::kInterrupted;
      return {};
    }
    take(**outcome);
    const Verdict verdict = property_.judge((*outcome)->values);
    result_.end = !verdict.holds   ? Shrunk::End::kUndecided
                  : *verdict.holds ? Shrunk::End::kHolds
                                   : Shrunk::End::kMinimal;
    if (result_.end != Shrunk::End::kMinimal) return {};
    world_.about = "Shrunk from " + world_.name + ": " + property_.text() + " fails.";
    // What the file states may be left out or not quite true; from here on it is computed.
    WorldFile settled = world_;
    CLEW_RETURN_IF_ERROR(settle_claims(settled, radius_m_));
    solvable_ = settled.solvable;
    return {};
  }

  void take(const CaseOutcome& outcome) {
    result_.outcome = outcome.values.word(Field::kOutcome);
    result_.hash = outcome.hash;
    ticks_ = outcome.ticks;
  }

  /// Whether the property fails in the same way there; then it is what is shrunk from now on.
  bool take_if_it_fails(WorldFile candidate, std::uint64_t seed) {
    if (!goes_on()) return false;
    // A world that is none any more, or that is solvable where it was not, is no smaller case.
    if (!settle_claims(candidate, radius_m_).ok() || candidate.solvable != solvable_) return false;
    RunCase smaller = result_.which;
    smaller.seed = seed;
    smaller.world_text = world_text(candidate);
    const auto outcome = run_case(smaller, property_, workshop_);
    ++result_.runs;
    if (!outcome.ok()) return false;  // it asks for what the smaller world does not have
    if (!*outcome) {
      interrupted_ = true;
      return false;
    }
    const bool fails = property_.judge((*outcome)->values).holds == false &&
                       (*outcome)->values.word(Field::kOutcome) == result_.outcome;
    if (fails) {
      result_.which = std::move(smaller);
      world_ = std::move(candidate);
      take(**outcome);
    }
    if (options_.progress) options_.progress(result_.runs, parts_of(world_));
    return fails;
  }
  bool take_if_it_fails(WorldFile candidate) {
    return take_if_it_fails(std::move(candidate), result_.which.seed);
  }

  /// All kinds of reduction once; false if none found anything.
  bool reduce_once() {
    bool reduced = remove_parts();
    reduced = stop_movers() || reduced;
    reduced = advance_start() || reduced;
    reduced = shorten_walls() || reduced;
    reduced = drop_corners() || reduced;
    reduced = close_in() || reduced;
    reduced = make_round() || reduced;
    if (result_.which.seed != 1) reduced = take_if_it_fails(world_, 1) || reduced;
    return reduced;
  }

  bool remove_parts() {
    const WorldFile whole = world_;
    std::vector<std::size_t> parts(parts_of(whole));
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    const auto left = minimise(parts, [&](const std::vector<std::size_t>& kept) {
      return take_if_it_fails(with_parts(whole, kept));
    });
    return left.size() < parts.size();
  }

  bool stop_movers() {
    bool reduced = false;
    for (std::size_t i = 0; i < world_.moving.size(); ++i) {
      if (world_.moving[i].path.size() < 2) continue;
      WorldFile candidate = world_;
      candidate.moving[i].path.resize(1);
      candidate.moving[i].loop = false;
      reduced = take_if_it_fails(std::move(candidate)) || reduced;
    }
    return reduced;
  }

  /// To the last place on its way from which the robot still fails, of some.
  bool advance_start() {
    if (!goes_on() || ticks_ < 2 || advances_ == kMostAdvances) return false;
    const auto track = track_of(result_.which, workshop_);
    if (!track.ok()) {
      error_ = track.error();
      return false;
    }
    ++result_.runs;
    for (const double share : {0.9, 0.75, 0.5, 0.25, 0.1}) {
      WorldFile candidate = world_;
      const auto tick = static_cast<std::size_t>(share * static_cast<double>(track->size()));
      candidate.start = (*track)[std::min(tick, track->size() - 1)];
      const double moved_m = core::length(candidate.start.position() - world_.start.position());
      if (moved_m < kLeastWall_m) continue;
      if (!take_if_it_fails(rounded_start(std::move(candidate)))) continue;
      ++advances_;
      return true;
    }
    return false;
  }

  static WorldFile rounded_start(WorldFile world) {
    world.start.x_m = rounded(world.start.x_m, 1e-3);
    world.start.y_m = rounded(world.start.y_m, 1e-3);
    world.start.heading_rad = rounded(world.start.heading_rad, 1e-3);
    return world;
  }

  /// Halves each wall from either end as long as it helps.
  bool shorten_walls() {
    bool reduced = false;
    for (std::size_t i = 0; i < world_.walls.size(); ++i) {
      for (const bool from_a : {true, false}) {
        for (double share : {0.5, 0.25}) {
          while (core::length(world_.walls[i].b - world_.walls[i].a) > kLeastWall_m) {
            WorldFile candidate = world_;
            auto& wall = candidate.walls[i];
            (from_a ? wall.a : wall.b) += share * (from_a ? wall.b - wall.a : wall.a - wall.b);
            if (!take_if_it_fails(std::move(candidate))) break;
            reduced = true;
          }
        }
      }
    }
    return reduced;
  }

  bool drop_corners() {
    bool reduced = false;
    for (std::size_t i = 0; i < world_.polygons.size(); ++i) {
      for (std::size_t corner = world_.polygons[i].size(); corner-- > 0;) {
        if (world_.polygons[i].size() <= 3) break;
        WorldFile candidate = world_;
        candidate.polygons[i] = without(candidate.polygons[i], corner, corner + 1);
        reduced = take_if_it_fails(std::move(candidate)) || reduced;
      }
    }
    return reduced;
  }

  bool close_in() {
    for (const double room_m : {0.5, 1.0, 2.0}) {
      WorldFile candidate = with_room(world_, room_m);
      const Vec2 before = world_.bounds_max - world_.bounds_min;
      const Vec2 after = candidate.bounds_max - candidate.bounds_min;
      if (before.x() * before.y() - after.x() * after.y() < kLeastWall_m) continue;
      if (take_if_it_fails(std::move(candidate))) return true;
    }
    return false;
  }

  bool make_round() {
    const std::string before = world_text(world_);
    for (const double step : {0.5, 0.1, 0.01}) {
      WorldFile candidate = rounded(world_, step);
      if (has_vanished(candidate)) continue;
      settle_stated(candidate);
      if (world_text(candidate) == before) return false;
      if (take_if_it_fails(std::move(candidate))) return true;
    }
    return false;
  }

  /// So that two worlds can be compared by their texts.
  void settle_stated(WorldFile& candidate) const {
    candidate.solvable = world_.solvable;
    candidate.shortest_path_m = world_.shortest_path_m;
  }

  const Property& property_;
  const Workshop& workshop_;
  const ShrinkOptions& options_;
  WorldFile world_;  ///< of result_.which
  double radius_m_ = 0.0;
  std::optional<bool> solvable_;
  std::uint64_t ticks_ = 0;
  std::size_t advances_ = 0;
  bool interrupted_ = false;
  core::Error error_;
  Shrunk result_;
};

}  // namespace

std::size_t parts_of(const WorldFile& world) {
  return world.walls.size() + world.polygons.size() + world.circles.size() + world.moving.size() +
         world.subgoals.size();
}

Result<Shrunk> shrink(const RunCase& which, const Property& property, const Workshop& workshop,
                      const ShrinkOptions& options) {
  return Shrinker(property, workshop, options).run(which);
}

}  // namespace clew::hunt
