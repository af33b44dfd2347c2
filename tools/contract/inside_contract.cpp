// SPDX-License-Identifier: Apache-2.0
/// What must hold of that which behaviours tell of their insides.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "contract/behaviour_contract.hpp"
#include "insides/inside_json.hpp"

namespace clew::contract {
namespace {

using core::Error;
using core::Result;

constexpr int kAskedTicks = 500;
// Asked in every so many ticks, which falls into all phases of a run.
constexpr int kTicksBetweenQuestions = 47;
constexpr int kTicksBetweenLooks = 7;

Error unsound(const std::string& what) { return {what}; }

/// What is wrong with a value; empty if nothing is.
struct Fault {
  std::string operator()(double value) const {
    return std::isfinite(value) ? "" : "a number that is not finite";
  }
  std::string operator()(bool) const { return {}; }
  std::string operator()(const std::string& value) const {
    return value.empty() ? "an empty text" : "";
  }
  std::string operator()(const std::vector<double>& values) const {
    for (const double value : values) {
      if (!std::isfinite(value)) return "a list with a number that is not finite";
    }
    return {};
  }
  std::string operator()(const domain::InsideGrid& grid) const {
    if (grid.columns == 0 || grid.values.size() % grid.columns != 0) return "a grid without rows";
    if (grid.marked && *grid.marked >= grid.values.size()) return "a grid marked outside of it";
    return (*this)(grid.values);
  }
  std::string operator()(const domain::InsideGroup& group) const {
    std::set<std::string> names;
    for (const domain::InsideValue& value : group.values()) {
      if (!names.insert(value.name).second) return "two values of the name " + value.name;
      const std::string fault = std::visit(*this, value.value);
      if (!fault.empty()) return value.name + ": " + fault;
    }
    return {};
  }
  std::string operator()(const domain::InsideValue::Items& items) const {
    for (const domain::InsideGroup& item : items) {
      const std::string fault = (*this)(item);
      if (!fault.empty()) return fault;
    }
    return {};
  }
};

std::string fault_of(const domain::Inside& inside) {
  if (inside.text.empty() || inside.text.back() != '.') return "a text without a full stop";
  for (const domain::PictureLayer& layer : inside.picture.layers) {
    for (const core::Vec2& place : layer.places_odom) {
      if (!std::isfinite(place.x()) || !std::isfinite(place.y())) {
        return layer.name + ": a place that is not finite";
      }
    }
  }
  return Fault{}(inside.values);
}

std::string as_text(const domain::Inside& inside) {
  return inside.text + insides::to_json(inside.values).dump() +
         insides::to_json(inside.picture).dump();
}

/// The value of a name in a group; null if there is none.
const domain::InsideValue* find(const domain::InsideGroup& group, const std::string& name) {
  for (const domain::InsideValue& value : group.values()) {
    if (value.name == name) return &value;
  }
  return nullptr;
}

/// The name of what the subject itself fills in what its stage tells.
std::string name_of_part(const runtime::BehaviourName& behaviour) {
  if (behaviour.part == "shadow") return "shadows";
  if (behaviour.part != "behaviour") return behaviour.part;
  static const std::map<std::string, std::string> kGroups = {{"sense", "sensor"},
                                                             {"classify", "classifier"},
                                                             {"plan", "planner"},
                                                             {"control", "controller"},
                                                             {"drive", "motion"}};
  const auto found = kGroups.find(behaviour.stage);
  return found == kGroups.end() ? std::string() : found->second;
}

/// The group of that name, or the first of several; null if there is none.
const domain::InsideGroup* find_group(const domain::InsideGroup& all, const std::string& name) {
  const domain::InsideValue* value = find(all, name);
  if (value == nullptr) return nullptr;
  if (const auto* items = std::get_if<domain::InsideValue::Items>(&value->value)) {
    return &items->front();
  }
  return std::get_if<domain::InsideGroup>(&value->value);
}

/// What a component adds to the group of a part of it.
std::size_t told_by_component(const domain::InsideGroup& group) {
  return (find(group, "name") == nullptr ? 0U : 1U) + (find(group, "text") == nullptr ? 0U : 1U);
}

std::string fault_of_detector(const domain::InsideGroup& group) {
  const domain::InsideValue* share = find(group, "alarm_share");
  const double* value = share == nullptr ? nullptr : std::get_if<double>(&share->value);
  if (value == nullptr) return "does not tell how near it is to an alarm";
  return 0.0 <= *value && *value <= 1.0 ? "" : fmt::format("an alarm_share of {}", *value);
}

}  // namespace

Result<void> check_insides(const Subject& subject) {
  auto silent = mission(subject);
  if (!silent.ok()) return silent.error();
  auto asked = mission(subject);
  if (!asked.ok()) return asked.error();
  for (int tick = 0; tick < kAskedTicks && !asked->over(); ++tick) {
    silent->step();
    if (tick % kTicksBetweenQuestions != 0) {
      asked->step();
    } else {
      auto restored = mission(subject);
      if (!restored.ok()) return restored.error();
      CLEW_RETURN_IF_ERROR(restored->load(asked->save()));
      std::map<std::string, std::string> told;
      std::string fault;
      asked->step(nullptr, [&](const std::string& stage, const domain::Inside& inside) {
        told[stage] = as_text(inside);
        if (fault.empty()) fault = fault_of(inside);
        if (!fault.empty()) fault = stage + " tells " + fault;
      });
      restored->step(nullptr, [&](const std::string& stage, const domain::Inside& inside) {
        if (fault.empty() && told[stage] != as_text(inside)) {
          fault = stage + " tells something else after save and load";
        }
      });
      if (!fault.empty()) return unsound(fmt::format("tick {}: {}", tick, fault));
    }
    const bool compares_states = tick % kTicksBetweenQuestions == 0;
    if (asked->digest() != silent->digest() ||
        (compares_states && asked->save().nodes != silent->save().nodes)) {
      return unsound(fmt::format("asked for its inside, it is changed at tick {}", tick));
    }
  }
  return {};
}

Result<void> check_tells(const Subject& subject) {
  auto run = mission(subject);
  if (!run.ok()) return run.error();
  const std::string part = subject.behaviour.part;
  const std::string name = name_of_part(subject.behaviour);
  // `none` is never at work at the end of a tick.
  bool worked = part == "escape" && subject.behaviour.name == "none";
  std::string fault;
  const auto listen = [&](const std::string& stage, const domain::Inside& inside) {
    if (stage != subject.behaviour.stage) return;
    const domain::InsideGroup* group = find_group(inside.values, name);
    if (group == nullptr) return;
    worked = true;
    if (group->values().size() <= told_by_component(*group)) fault = "tells nothing of its own";
    if (fault.empty() && part != "escape" && stage == "recover") fault = fault_of_detector(*group);
  };
  for (int tick = 0; tick < kAskedTicks && !run->over(); ++tick) {
    const bool asks = tick % kTicksBetweenLooks == 0;
    run->step(nullptr, asks ? Mission::Listen(listen) : nullptr);
    if (!fault.empty()) return unsound(fmt::format("tick {}: {}", tick, fault));
  }
  if (!worked) return unsound("tells nothing of its own, or was never at work");
  return {};
}

}  // namespace clew::contract
