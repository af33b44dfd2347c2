// SPDX-License-Identifier: Apache-2.0
/// Files that people write: whatever their text, it is refused or read.
#include "bench/suite.hpp"
#include "classify/som.hpp"
#include "control/attraction/krishna_kalra_rules.hpp"
#include "control/behaviourist/behaviourist_rules.hpp"
#include "control/gaps/virtual_target_rules.hpp"
#include "control/infrared/neuro_fuzzy_nets.hpp"
#include "domains/bridge_file.hpp"
#include "recover/escapes/following/wall_rules.hpp"
#include "recover/escapes/immediate_memory.hpp"
#include "runtime/graph.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "target.hpp"
#include "world/world.hpp"
#include "world/world_file.hpp"

namespace clew::fuzz {
namespace {

core::Resource resource(std::string_view text) { return {"file.yaml", std::string(text)}; }

// A graph that is good has another text, of the same graph.
void read_graph(std::string_view text) {
  const auto graph = runtime::load_graph(resource(text), "g", {}, stages::all());
  if (!is_good(graph)) return;
  const std::string expanded = graph->expanded_yaml();
  const auto again = runtime::load_graph(resource(expanded), "g", {}, stages::all());
  CLEW_CHECK(again.ok(), "an expanded graph is refused: " + again.error().text());
  CLEW_CHECK(again->expanded_yaml() == expanded, "an expanded graph is expanded otherwise");
}

void read_world(std::string_view text) {
  static_cast<void>(is_good(world::read_world_file(text, "file.yaml")));
}

void read_robot(std::string_view text) {
  const auto robot = runtime::read_robot(resource(text), "r");
  if (is_good(robot)) CLEW_CHECK(robot->radius_m > 0.0, "a robot without a body");
}

void read_rule_base(std::string_view text) {
  const auto file = resource(text);
  static_cast<void>(is_good(control::KrishnaKalraRules::parse(file)));
  static_cast<void>(is_good(control::VirtualTargetRules::parse(file)));
  static_cast<void>(is_good(control::BehaviouristRules::parse(file)));
  static_cast<void>(is_good(recover::WallRules::parse(file)));
  static_cast<void>(is_good(recover::ImmediateMemory::parse(file)));
}

void read_network(std::string_view text) {
  const auto file = resource(text);
  static_cast<void>(is_good(classify::Som::parse(file)));
  static_cast<void>(is_good(control::NeuroFuzzyNets::parse(file)));
}

void read_suite(std::string_view text) {
  static_cast<void>(is_good(bench::read_suite(resource(text), "s")));
  static_cast<void>(is_good(bench::read_variation(std::string(text.substr(0, 200)))));
  static_cast<void>(is_good(bench::read_grouping(std::string(text.substr(0, 40)))));
}

void read_bridge_file(std::string_view text) {
  static_cast<void>(is_good(domains::read_bridge_file(resource(text))));
}

Seeds graphs() {
  Seeds seeds = files_of("configs/graphs", ".yaml", 4000);
  // Deployment, way-points, noise.
  seeds.push_back(
      "world: open-field\nrobot: disc-015\nseed: 7\nmax_ticks: 100\n"
      "mission: {waypoints: [[1, 2, 0.5], [3, 4]]}\n"
      "sense: {behaviour: cones, noise_stddev_m: 0.01, process: {middleware: fastdds}}\n"
      "control: {behaviour: krishna_kalra_fuzzy, process: {group: near}}\n"
      "drive: {behaviour: turn_then_step, process: {restart_limit: 3}}\n");
  return seeds;
}
Seeds worlds() { return files_of("configs/worlds", ".yaml", 2500); }
Seeds robots() { return files_of("configs/robots", ".yaml", 2500); }
Seeds rule_bases() {
  return files({"configs/rulebases/krishna_kalra_control.yaml",
                "configs/rulebases/krishna_kalra_actions.yaml",
                "configs/rulebases/nakhaeinia_nvt.yaml", "configs/rulebases/pin_bender_fba.yaml",
                "configs/rulebases/obstacle_following.yaml"});
}
Seeds networks() {
  return files({"configs/rulebases/krishna_kalra_som.yaml",
                "configs/rulebases/wang_yang_meng_printed.yaml",
                "configs/rulebases/wang_yang_meng_trained.yaml"});
}
Seeds suites() { return files_of("configs/suites", ".yaml", 4000); }
Seeds bridge_files() {
  return {
      "format: clew-bridge/1\ndomains:\n  robot: {run: my-run}\n"
      "  site: {domain: 20, middleware: fastdds, network: true}\ntopics:\n"
      "  - {topic: scan, from: robot, to: site, as: r1/scan, rate_hz: 5, where: stamp.tick > 9, "
      "depth: 3, reliability: best_effort}\n"
      "  - {topic: rt/*, from: site, to: [robot], as: rt/site/*}\n"};
}

}  // namespace

std::vector<Target> text_targets() {
  return {{"graph", read_graph, graphs},
          {"world", read_world, worlds},
          {"robot", read_robot, robots},
          {"rule_base", read_rule_base, rule_bases},
          {"network", read_network, networks},
          {"suite", read_suite, suites},
          {"bridge_file", read_bridge_file, bridge_files}};
}

}  // namespace clew::fuzz
