// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "control/infrared/neuro_fuzzy_nets.hpp"
#include "core/angle.hpp"
#include "core/fuzzy.hpp"
#include "core/yaml_reader.hpp"
#include "recover/escapes/following/wall_follower.hpp"
#include "rules/readings.hpp"
#include "rules/sampling.hpp"

namespace clew::rules {

using core::Error;
using core::Result;

Result<void> read_wall_following(const core::Resource& file, RuleBase& base) {
  const auto rules = recover::WallRules::parse(file);
  if (!rules.ok()) return rules.error();
  const Axis ahead{"least reading ahead", "of the range", 0.0, 1.0};
  const Axis side{"reading on the wall's side", "of the range", 0.0, 1.0};
  const auto blocked = [&](double u) {
    return core::falling_membership(u, rules->blocked_full_ratio, rules->blocked_none_ratio);
  };
  const auto close = [&](double u) {
    return core::falling_membership(u, rules->close_ratio, rules->good_ratio);
  };
  const auto far = [&](double u) {
    return 1.0 - core::falling_membership(u, rules->good_ratio, rules->far_ratio);
  };
  base.variables = {{ahead,
                     {sample_set("blocked", ahead, blocked),
                      sample_set("free", ahead, [&](double u) { return 1.0 - blocked(u); })}},
                    {side,
                     {sample_set("close", side, close),
                      sample_set("good", side, [&](double u) { return 1.0 - close(u) - far(u); }),
                      sample_set("far", side, far)}}};
  base.rules = {
      fmt::format("if the way ahead is blocked, turn {:g} deg to the wall, step {:g} m",
                  core::degrees(rules->blocked_turn_rad), rules->blocked_step_m),
      fmt::format("if it is free and the wall is close, turn {:g} deg to the wall, step {:g} m",
                  core::degrees(rules->close_turn_rad), rules->free_step_m),
      fmt::format("if it is free and the wall is good, go straight on, step {:g} m",
                  rules->free_step_m),
      fmt::format("if it is free and the wall is far, turn {:g} deg to the wall, step {:g} m",
                  core::degrees(rules->far_turn_rad), rules->free_step_m)};
  const recover::WallFollower follower(*rules);
  const auto follow = [&](double at_side, double in_front) {
    domain::Scan scan;
    scan.range_max_m = 1.0;
    scan.ranges_m.push_back(at_side);
    for (std::size_t i = 1; i < recover::WallFollower::kBeams; ++i)
      scan.ranges_m.push_back(in_front);
    return follower.follow(scan, recover::Side::kLeft);
  };
  base.surfaces = {
      sample_surface({"turn to the wall", "deg", {}, side, ahead, 0, {}},
                     [&](double s, double f) { return core::degrees(follow(s, f).turn_rad); }),
      sample_surface({"step", "m", {}, side, ahead, 0, {}},
                     [&](double s, double f) { return follow(s, f).step_m; })};
  return {};
}

namespace {

using control::NeuroFuzzyNets;

constexpr std::array<const char*, NeuroFuzzyNets::kSets> kSetNames = {"too close", "close", "far",
                                                                      "too far"};
struct NetName {
  const char* net;
  const char* first;
  const char* second;
};
constexpr std::array<NetName, NeuroFuzzyNets::kCount> kNets = {
    {{"V_L1", "reading ahead", "reading at the back"},
     {"V_R1", "reading ahead", "reading at the back"},
     {"V_L2", "reading on the left", "reading on the right"},
     {"V_R2", "reading on the left", "reading on the right"}}};

}  // namespace

Result<void> read_neuro_fuzzy(const core::Resource& file, RuleBase& base) {
  const auto nets = NeuroFuzzyNets::parse(file);
  if (!nets.ok()) return nets.error();
  for (std::size_t i = 0; i < nets->nets.size(); ++i) {
    const auto& net = nets->nets[i];
    for (std::size_t input = 0; input < 2; ++input) {
      const Axis axis{
          fmt::format("{}: {}", kNets[i].net, input == 0 ? kNets[i].first : kNets[i].second),
          "of 255, near is low", 0.0, 255.0};
      Variable variable{axis, {}};
      for (std::size_t set = 0; set < NeuroFuzzyNets::kSets; ++set) {
        variable.sets.push_back(sample_set(kSetNames[set], axis, [&](double reading) {
          return net.memberships(input, reading)[set];
        }));
      }
      base.variables.push_back(std::move(variable));
    }
    for (std::size_t row = 0; row < NeuroFuzzyNets::kSets; ++row) {
      for (std::size_t column = 0; column < NeuroFuzzyNets::kSets; ++column) {
        base.rules.push_back(fmt::format("if {} is {} and {} is {}, {} is {:g} m/s", kNets[i].first,
                                         kSetNames[row], kNets[i].second, kSetNames[column],
                                         kNets[i].net, net.outputs[row][column]));
      }
    }
  }
  const auto speeds = [&](double left, double ahead) {
    control::InfraredReadings readings{};
    readings[control::kAhead] = ahead;
    readings[control::kLeft] = left;
    readings[control::kBack] = readings[control::kRight] = 255.0;
    return nets->speeds(readings);
  };
  const std::string given = "nothing is behind or on the right";
  const Axis left{"reading on the left", "of 255", 0.0, 255.0};
  const Axis ahead{"reading ahead", "of 255", 0.0, 255.0};
  base.surfaces = {sample_surface({"right wheel less left", "m/s", given, left, ahead, 0, {}},
                                  [&](double l, double a) {
                                    return speeds(l, a).right_mps - speeds(l, a).left_mps;
                                  }),
                   sample_surface({"mean of the wheels", "m/s", given, left, ahead, 0, {}},
                                  [&](double l, double a) {
                                    return 0.5 * (speeds(l, a).right_mps + speeds(l, a).left_mps);
                                  })};
  return {};
}

namespace {

struct Reader {
  Result<void> (*read)(const core::Resource&, RuleBase&) = nullptr;  ///< null: no fuzzy sets
};

/// By the format that a file names.
Result<Reader> reader_of(const core::Resource& file) {
  static const std::map<std::string, Reader> kReaders = {
      {"clew-krishna-kalra-control/1", {read_krishna_kalra}},
      {"clew-nakhaeinia-nvt/1", {read_virtual_target}},
      {"clew-fuzzy-behaviourist/1", {read_behaviourist}},
      {"clew-obstacle-following/1", {read_wall_following}},
      {"clew-neuro-fuzzy-rules/1", {read_neuro_fuzzy}},
      {"clew-neuro-fuzzy-trained/1", {read_neuro_fuzzy}}};
  const auto root = core::YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  const auto node = root->at("format");
  if (!node.ok()) return node.error();
  const auto format = node->string();
  if (!format.ok()) return format.error();
  const auto found = kReaders.find(*format);
  return found == kReaders.end() ? Reader{} : found->second;
}

/// Whether the stage has named this file already.
bool is_known(const RuleBases& bases, const std::string& stage, const std::string& name) {
  const auto same = [&](const RuleBase& base) { return base.stage == stage && base.name == name; };
  return std::any_of(bases.fuzzy.begin(), bases.fuzzy.end(), same) ||
         std::find(bases.others.begin(), bases.others.end(), name) != bases.others.end();
}

}  // namespace

Result<RuleBases> rule_bases_of(const runtime::RunPlan& plan) {
  RuleBases bases;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    for (const runtime::NamedFile& named : stage.files) {
      if (named.folder != "rulebases" || is_known(bases, stage.info->name, named.name)) continue;
      const auto file = plan.setup.behaviour.resources.find(named.folder, named.name);
      if (!file.ok()) return file.error();
      const auto reader = reader_of(*file);
      if (!reader.ok()) return reader.error();
      if (reader->read == nullptr) {
        bases.others.push_back(named.name);
        continue;
      }
      RuleBase base{stage.info->name, named.parameter, named.name, {}, {}, {}};
      CLEW_RETURN_IF_ERROR(reader->read(*file, base));
      bases.fuzzy.push_back(std::move(base));
    }
  }
  return bases;
}

}  // namespace clew::rules
