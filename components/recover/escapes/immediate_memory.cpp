// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/immediate_memory.hpp"

#include <cmath>

#include "core/yaml_fields.hpp"
#include "domain/landmark_classes.hpp"

namespace clew::recover {
namespace {

using core::Result;
using core::YamlNode;

constexpr double kHalfClass = 0.5;

Result<ImmediateMemory::Action> read_action(const YamlNode& node) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"classes", "turn_deg"}));
  ImmediateMemory::Action action;
  CLEW_RETURN_IF_ERROR(core::read_numbers(node, "classes", "three classes",
                                          {0.0, domain::kLastClass}, action.classes));
  for (const double value : action.classes) {
    if (value != std::floor(value)) return node.find("classes")->error("a class is a whole number");
  }
  CLEW_RETURN_IF_ERROR(core::read_angle(node, "turn_deg", {-180.0, 180.0}, action.turn_rad));
  return action;
}

}  // namespace

Result<ImmediateMemory> ImmediateMemory::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "actions"}));
  CLEW_RETURN_IF_ERROR(core::check_format(*root, "clew-krishna-kalra-actions/1"));
  const auto list = root->at("actions");
  if (!list.ok()) return list.error();
  const auto items = list->items();
  if (!items.ok()) return items.error();
  std::vector<Action> actions;
  for (const YamlNode& item : *items) {
    const auto action = read_action(item);
    if (!action.ok()) return action.error();
    for (const Action& other : actions) {
      if (other.classes == action->classes) {
        return item.error("this landmark has an action already");
      }
    }
    actions.push_back(*action);
  }
  return ImmediateMemory(std::move(actions));
}

std::optional<double> ImmediateMemory::turn_rad(const domain::Landmark& landmark) const {
  for (const domain::Recognition& recognition : landmark.recognitions) {
    if (recognition.network != domain::Network::kSom) continue;
    const Action* nearest = nullptr;
    double nearest_distance = kHalfClass;
    for (const Action& action : actions_) {
      const double d =
          std::sqrt(domain::squared_class_distance(action.classes, recognition.prototype_classes));
      if (d <= nearest_distance) {
        nearest = &action;
        nearest_distance = d;
      }
    }
    if (nearest != nullptr) return nearest->turn_rad;
  }
  return std::nullopt;
}

}  // namespace clew::recover
