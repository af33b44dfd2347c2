// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "control/infrared/infrared_expert.hpp"
#include "control/infrared/neuro_fuzzy.hpp"
#include "domain/words.hpp"

namespace clew::control {
namespace {

constexpr std::array<const char*, NeuroFuzzyNets::kCount> kNetNames = {"left_1", "right_1",
                                                                       "left_2", "right_2"};
// Values along each axis of the control surface.
constexpr std::size_t kSpeeds = 18;

std::string say_speeds(const WheelSpeeds& speeds) {
  return domain::say_number(speeds.left_mps) + " m/s on the left and " +
         domain::say_number(speeds.right_mps) + " m/s on the right";
}

void tell_speeds(const char* name, const WheelSpeeds& speeds, domain::Inside& inside) {
  domain::InsideGroup& group = inside.values.group(name);
  group.number("left", speeds.left_mps, "mps");
  group.number("right", speeds.right_mps, "mps");
}

void tell_sides(const InfraredDistances& distances_m, domain::Inside& inside) {
  domain::InsideGroup& group = inside.values.group("free");
  group.number("ahead", distances_m[kAhead], "m");
  group.number("back", distances_m[kBack], "m");
  group.number("left", distances_m[kLeft], "m");
  group.number("right", distances_m[kRight], "m");
  inside.say("Free are " + domain::say_metres(distances_m[kAhead]) + " ahead, " +
             domain::say_metres(distances_m[kLeft]) + " on the left, " +
             domain::say_metres(distances_m[kRight]) + " on the right and " +
             domain::say_metres(distances_m[kBack]) + " behind.");
}

/// Memberships of both readings, and how far each of the 16 rules holds.
void tell_net(std::size_t place, const NeuroFuzzyNets::Net& net, double first, double second,
              domain::Inside& inside) {
  const auto p = net.memberships(0, first);
  const auto q = net.memberships(1, second);
  domain::InsideGrid strengths{
      NeuroFuzzyNets::kSets, {}, "sets of the second reading", "sets of the first reading", {}};
  for (const double row : p) {
    for (const double column : q) strengths.values.push_back(row * column);
  }
  const auto strongest = std::max_element(strengths.values.begin(), strengths.values.end());
  strengths.marked = static_cast<std::size_t>(strongest - strengths.values.begin());
  domain::InsideGroup& item = inside.values.item("networks");
  item.text("network", kNetNames[place]);
  item.list("first_memberships", {p.begin(), p.end()});
  item.list("second_memberships", {q.begin(), q.end()});
  item.grid("rule_strengths", std::move(strengths));
  item.number("speed", net.infer(first, second), "mps");
}

/// What the wheels' difference is for any reading ahead and on the left, the others as they are.
void tell_net_surface(const NeuroFuzzyNets& nets, const InfraredReadings& readings,
                      domain::Inside& inside) {
  domain::InsideGrid surface{
      kSpeeds, {}, "reading on the left, 0 to 255", "reading ahead, 0 to 255", {}};
  constexpr double kStep = 255.0 / static_cast<double>(kSpeeds - 1);
  for (std::size_t row = 0; row < kSpeeds; ++row) {
    for (std::size_t column = 0; column < kSpeeds; ++column) {
      InfraredReadings there = readings;
      there[kAhead] = static_cast<double>(row) * kStep;
      there[kLeft] = static_cast<double>(column) * kStep;
      const WheelSpeeds speeds = nets.speeds(there);
      surface.values.push_back(speeds.right_mps - speeds.left_mps);
    }
  }
  surface.marked = static_cast<std::size_t>(readings[kAhead] / kStep + 0.5) * kSpeeds +
                   static_cast<std::size_t>(readings[kLeft] / kStep + 0.5);
  inside.values.grid("right_minus_left_surface", std::move(surface), "mps");
}

}  // namespace

void NeuroFuzzy::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom, domain::Inside& inside) const {
  const InfraredReadings readings = infrareds_.readings(scan);
  const InfraredDistances distances_m = infrareds_.distances_m(scan);
  tell_sides(distances_m, inside);
  inside.values.list("readings_ahead_back_left_right", {readings.begin(), readings.end()});
  for (std::size_t i = 0; i < NeuroFuzzyNets::kCount; ++i) {
    const bool ahead = i == NeuroFuzzyNets::kLeft1 || i == NeuroFuzzyNets::kRight1;
    tell_net(i, nets_.nets[i], readings[ahead ? kAhead : kLeft], readings[ahead ? kBack : kRight],
             inside);
  }
  const WheelSpeeds by_nets = nets_.speeds(readings);
  const WheelSpeeds by_target =
      target_term(target_, core::bearing_rad(odometry.pose_odom_robot, target_odom), distances_m);
  tell_speeds("by_networks", by_nets, inside);
  tell_speeds("by_target_term", by_target, inside);
  tell_net_surface(nets_, readings, inside);
  inside.say("The networks want " + say_speeds(by_nets) + "; the target term adds " +
             say_speeds(by_target) + ".");
}

void InfraredExpert::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                          const core::Vec2& target_odom, domain::Inside& inside) const {
  const InfraredDistances distances_m = infrareds_.distances_m(scan);
  tell_sides(distances_m, inside);
  const WheelSpeeds opinion = expert_opinion(parameters_, distances_m);
  const WheelSpeeds by_target = target_term(
      parameters_.target, core::bearing_rad(odometry.pose_odom_robot, target_odom), distances_m);
  tell_speeds("by_expert", opinion, inside);
  tell_speeds("by_target_term", by_target, inside);
  inside.say("The expert wants " + say_speeds(opinion) + "; the target term adds " +
             say_speeds(by_target) + ".");
}

}  // namespace clew::control
