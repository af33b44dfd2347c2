// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cctype>

#include "core/quoted.hpp"
#include "runtime/goals.hpp"
#include "runtime/plugin_list.hpp"
#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

// Whether YAML takes the bare text for a text.
bool is_plain(const std::string& text) {
  for (const char* word : {"", "true", "false", "null", "Null", "NULL"}) {
    if (text == word) return false;
  }
  if (std::isalpha(static_cast<unsigned char>(text.front())) == 0) return false;
  for (char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') return false;
  }
  return true;
}

std::string yaml_word(const std::string& text) {
  return is_plain(text) ? text : core::yaml_quoted(text);
}

std::string list(const std::vector<std::string>& words) {
  std::string text = "[";
  for (const std::string& word : words) text += (text.size() > 1 ? ", " : "") + yaml_word(word);
  return text + ']';
}

struct ValueText {
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(double v) const { return fmt::format("{}", v); }
  std::string operator()(const std::string& v) const { return yaml_word(v); }
  std::string operator()(const std::vector<std::string>& v) const { return list(v); }
};

// In the order of the declarations.
std::string parameters_text(const std::vector<core::ParameterInfo>& infos,
                            const core::ParameterValues& values, const std::string& indent) {
  std::string text;
  for (const core::ParameterInfo& info : infos) {
    text += indent + info.name + ": " + std::visit(ValueText{}, values.at(info.name)) + '\n';
  }
  return text;
}

const VariantInfo& variant_named(const PartInfo& part, const std::string& name) {
  const VariantInfo* found = part.find(name);
  CLEW_CHECK(found != nullptr, part.name + " '" + name + "' was not checked");
  return *found;
}

std::string part_text(const PartInfo& part, const std::vector<PartChoice>& choices) {
  if (part.name == kBehaviourPart) {
    const PartChoice& choice = choices.front();
    return "  behaviour: " + yaml_word(choice.name) + '\n' +
           parameters_text(variant_named(part, choice.name).parameters, choice.parameters, "  ");
  }
  if (choices.empty()) return "  " + part.name + ": []\n";
  std::string text = "  " + part.name + ":\n";
  for (const PartChoice& choice : choices) {
    const std::string lead = part.is_list ? "    - " : "    ";
    const std::string values =
        parameters_text(variant_named(part, choice.name).parameters, choice.parameters, "        ");
    text += lead + yaml_word(choice.name) + ':' + (values.empty() ? " {}\n" : '\n' + values);
  }
  return text;
}

}  // namespace

std::string GraphStage::expanded_yaml() const {
  std::string text = info->name + ":\n";
  if (!deployment.exec.empty()) {
    text += "  exec: " + list(deployment.exec) + '\n';
    if (deployment.json_lines) text += "  via: json_lines\n";
    if (deployment.stateless) text += "  restart: stateless\n";
    if (config.parts.empty()) return text;
  }
  if (deployment.ros2) {
    text += "  ros2:" + std::string(deployment.ros2->empty() ? " {}\n" : "\n");
    for (const auto& [key, value] : *deployment.ros2) {
      text += "    " + key + ": " + yaml_word(value) + '\n';
    }
  }
  for (const PartInfo& part : info->parts) text += part_text(part, config.parts.at(part.name));
  if (!deployment.is_ours()) return text;
  return text + parameters_text(info->parameters, config.parameters, "  ");
}

std::string Graph::expanded_yaml() const {
  std::string text = fmt::format("world: {}\nrobot: {}\nseed: {}\nmax_ticks: {}\n",
                                 yaml_word(world), yaml_word(robot), seed, max_ticks);
  if (robot_index > 0) text += fmt::format("robot_index: {}\n", robot_index);
  text += plugins_text(*this);
  text += goals_yaml(goals);
  for (const GraphStage& stage : stages) text += stage.expanded_yaml();
  return text;
}

}  // namespace clew::runtime
