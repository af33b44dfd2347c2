// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "domain/words.hpp"
#include "recover/recover_component.hpp"

namespace clew::recover {
namespace {

// What is told of the local map lies within this distance of the robot, in as many cells a side.
constexpr double kSeen_m = 3.0;
constexpr std::size_t kSeenCells = 61;

/// What was seen around the robot: 0 unknown, 1 free, 2 suspected, 3 hit.
void tell_seen(const map::LocalMap& map, const core::Vec2& robot, domain::Inside& inside) {
  const map::SeenMap& seen = map.seen();
  domain::InsideGrid grid{kSeenCells, std::vector<double>(kSeenCells * kSeenCells, 0.0), "x",
                          "y, from the top", kSeenCells * kSeenCells / 2};
  const double step_m = 2.0 * kSeen_m / static_cast<double>(kSeenCells);
  const auto mark_all = [&](map::Mark mark, double value) {
    const core::Vec2 reach(kSeen_m, kSeen_m);
    seen.for_each(mark, robot - reach, robot + reach, [&](const core::Vec2& place) {
      const core::Vec2 steps = (place - robot + reach) / step_m;
      const auto column = std::min(kSeenCells - 1, static_cast<std::size_t>(steps.x()));
      const auto row = std::min(kSeenCells - 1, static_cast<std::size_t>(steps.y()));
      double& cell = grid.values[(kSeenCells - 1 - row) * kSeenCells + column];
      cell = std::max(cell, value);
    });
  };
  mark_all(map::Mark::kFree, 1.0);
  mark_all(map::Mark::kSuspected, 2.0);
  mark_all(map::Mark::kHit, 3.0);
  inside.values.number("seen_tiles", static_cast<double>(seen.state().tiles.size()));
  inside.values.grid("seen_around_robot", std::move(grid));
}

/// What it costs to have the robot's centre there, with the map's own inflation; 0 is blocked.
void tell_costs(const map::LocalMap& map, const core::Vec2& robot, domain::Inside& inside) {
  map::CostmapBuilder builder(map.inflation(), map.seen().cell_m());
  const map::Costmap& costs = builder.update(map.seen(), robot, robot, kSeen_m, kSeen_m);
  domain::InsideGrid grid{kSeenCells, {}, "x", "y, from the top", kSeenCells * kSeenCells / 2};
  const double step_m = 2.0 * kSeen_m / static_cast<double>(kSeenCells);
  for (std::size_t row = kSeenCells; row-- > 0;) {
    for (std::size_t column = 0; column < kSeenCells; ++column) {
      const core::Vec2 offset(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      const auto cell = costs.grid.cell_at(robot - core::Vec2(kSeen_m, kSeen_m) + step_m * offset);
      grid.values.push_back(cell ? static_cast<double>(costs.cost[costs.grid.index(*cell)]) : 1.0);
    }
  }
  inside.values.grid("costs_around_robot", std::move(grid));
}

/// Whether the event of this tick holds a trap that this detector noticed; null if not.
const domain::EventEntry* said_trap(const domain::Event& event, const std::string& name,
                                    bool shadow) {
  for (const domain::EventEntry& entry : event.entries) {
    if (entry.kind == domain::EventKind::kTrap && entry.rule == name && entry.shadow == shadow) {
      return &entry;
    }
  }
  return nullptr;
}

}  // namespace

void RecoverComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  const auto& target = samples.get<domain::Target>();
  const auto& guidance = samples.get<domain::Guidance>();
  const auto& event = samples.get<domain::Event>();
  const Situation situation{samples.tick(),
                            samples.get<domain::Odometry>(),
                            samples.get<domain::Scan>(),
                            samples.find<domain::Landmark>(),
                            target.position(),
                            pursued_odom_,
                            target.radius_m,
                            parts_.local_map ? &*parts_.local_map : nullptr};
  if (!state_.gave_up) tell_detectors(situation, inside);
  if (const auto* trap = said_trap(event, parts_.detector.name, false)) {
    inside.say("In this tick it says trap: " + trap->text + ".");
    inside.values.text("trap", trap->text);
  }
  if (parts_.local_map) {
    tell_seen(*parts_.local_map, situation.pose().position(), inside);
    tell_costs(*parts_.local_map, situation.pose().position(), inside);
  }
  tell_escape(situation, guidance, inside);
  for (const domain::EventEntry& entry : event.entries) {
    if (entry.kind != domain::EventKind::kReflex) continue;
    inside.say("The landmark is one that the immediate memory acts on: a reflex.");
  }
}

/// The detector in command, and those in its shadow.
void RecoverComponent::tell_detectors(const Situation& situation, domain::Inside& inside) const {
  domain::Inside part;
  part.values.text("name", parts_.detector.name);
  part.say("The detector in command is " + parts_.detector.name + ".");
  parts_.detector.behaviour->tell(situation, part);
  inside.add("detector", std::move(part));
  for (const auto& shadow : parts_.shadows) {
    domain::Inside of_shadow;
    shadow.behaviour->tell(situation, of_shadow);
    domain::InsideGroup& item = inside.values.item("shadows");
    item.text("name", shadow.name);
    if (!of_shadow.text.empty()) item.text("text", of_shadow.text);
    for (const domain::InsideValue& value : of_shadow.values.values()) item.put(value);
  }
}

/// The escape at work, and what guidance says in the end.
void RecoverComponent::tell_escape(const Situation& situation, const domain::Guidance& guidance,
                                   domain::Inside& inside) const {
  static constexpr const char* kModes[] = {"seek", "recover", "unreachable"};
  inside.values.text("mode", kModes[static_cast<std::size_t>(guidance.mode)]);
  inside.values.text("why", guidance.why.empty() ? "none" : guidance.why);
  inside.values.flag("overrides", guidance.has_override);
  inside.values.number("virtual_obstacles", static_cast<double>(guidance.virtual_obstacles.size()));
  inside.values.place("active_target", {guidance.target_x_m, guidance.target_y_m});
  if (state_.escaping) {
    domain::Inside part;
    part.values.text("name", parts_.escapes[state_.escape].name);
    part.say("The escape " + parts_.escapes[state_.escape].name + " is at work" +
             (state_.evidence.text.empty() ? "." : ", because of: " + state_.evidence.text + "."));
    parts_.escapes[state_.escape].behaviour->tell(situation, part);
    inside.add("escape", std::move(part));
    if (state_.evidence.earlier) {
      inside.values.place("earlier_visit", state_.evidence.earlier->position_odom);
    }
  }
  if (state_.gave_up) {
    inside.say("The target is held unreachable by " + state_.why + ".");
  } else if (guidance.has_override) {
    inside.say("It overrides the controller: " + domain::say_motion(guidance.override_motion) +
               ".");
  } else if (guidance.target_is_virtual) {
    inside.say("It lets the controller steer for a virtual target.");
  } else if (!state_.escaping) {
    inside.say("No escape is at work: the controller seeks the target.");
  }
}

}  // namespace clew::recover
