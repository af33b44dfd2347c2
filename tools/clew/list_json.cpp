// SPDX-License-Identifier: Apache-2.0
#include "clew/list_json.hpp"

#include <variant>
#include <vector>

#include "runtime/plugin_list.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using nlohmann::ordered_json;
using runtime::PortInfo;

ordered_json text_or_null(const std::string& text) {
  return text.empty() ? ordered_json(nullptr) : ordered_json(text);
}

ordered_json parameters_json(const std::vector<core::ParameterInfo>& infos) {
  ordered_json parameters = ordered_json::array();
  for (const core::ParameterInfo& info : infos) {
    ordered_json range = nullptr;
    if (info.range) range = {info.range->min, info.range->max};
    ordered_json value;
    std::visit([&](const auto& one) { value = one; }, info.default_value);
    parameters.push_back({{"name", info.name},
                          {"default", std::move(value)},
                          {"unit", text_or_null(info.unit)},
                          {"range", std::move(range)},
                          {"choices", info.choices},
                          {"folder", text_or_null(info.folder)},
                          {"about", info.doc}});
  }
  return parameters;
}

const char* need_word(PortInfo::Need need) {
  switch (need) {
    case PortInfo::Need::kRequired:
      return "required";
    case PortInfo::Need::kOptional:
      return "optional";
    case PortInfo::Need::kFallback:
      break;
  }
  return "fallback";
}

ordered_json port_json(const PortInfo& port) {
  return {{"topic", domain::topic_name(port.topic)},
          {"type", domain::type_name(port.topic)},
          {"direction", port.direction == PortInfo::Direction::kInput ? "in" : "out"},
          {"need", need_word(port.need)},
          {"delayed", port.delayed},
          {"about", port.doc}};
}

}  // namespace

ordered_json json_of(const runtime::StageInfo& stage, const std::string& part,
                     const std::string& name) {
  ordered_json json = {{"stage", stage.name}, {"about", stage.summary}};
  if (part.empty() && name.empty()) {
    json["ports"] = ordered_json::array();
    for (const PortInfo& port : stage.ports) json["ports"].push_back(port_json(port));
    json["parameters"] = parameters_json(stage.parameters);
  }
  json["behaviours"] = ordered_json::array();
  for (const runtime::PartInfo& each : stage.parts) {
    if (!part.empty() && each.name != part) continue;
    for (const runtime::VariantInfo& variant : each.variants) {
      if (!name.empty() && variant.name != name) continue;
      const auto* plugin = runtime::plugin_of({stage.name, each.name, variant.name});
      json["behaviours"].push_back({{"part", each.name},
                                    {"name", variant.name},
                                    {"plugin", text_or_null(plugin ? plugin->name : "")},
                                    {"about", variant.summary},
                                    {"parameters", parameters_json(variant.parameters)}});
    }
  }
  return json;
}

ordered_json json_of_topics() {
  ordered_json topics = ordered_json::array();
  for (const domain::Topic topic : domain::kAllTopics) {
    std::vector<std::string> writers;
    std::vector<std::string> readers;
    for (const runtime::StageInfo& stage : stages::all()) {
      for (const PortInfo& port : stage.ports) {
        if (port.topic != topic) continue;
        (port.direction == PortInfo::Direction::kOutput ? writers : readers).push_back(stage.name);
      }
    }
    topics.push_back({{"topic", domain::topic_name(topic)},
                      {"type", domain::type_name(topic)},
                      {"writers", writers},
                      {"readers", readers}});
  }
  return topics;
}

}  // namespace clew::tools
