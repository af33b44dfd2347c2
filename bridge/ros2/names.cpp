// SPDX-License-Identifier: Apache-2.0
#include "ros2/names.hpp"

#include <cctype>
#include <utility>

namespace clew::ros2 {
namespace {

core::Error name_error(const std::string& name, const std::string& why) {
  return {"'" + name + "' is no name of ROS: " + why};
}

}  // namespace

core::Result<void> check_topic_name(const std::string& name) {
  if (name.empty()) return name_error(name, "it is empty");
  bool at_start = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const auto byte = static_cast<unsigned char>(c);
    if (c == '/') {
      if (at_start && i > 0) return name_error(name, "two slashes in a row");
      at_start = true;
      continue;
    }
    if (c != '_' && std::isalnum(byte) == 0) {
      return name_error(name, "allowed are letters, digits, _ and /");
    }
    if (at_start && std::isdigit(byte) != 0) {
      return name_error(name, "a part begins with a digit");
    }
    at_start = false;
  }
  if (at_start) return name_error(name, "it ends in a slash");
  return {};
}

core::Result<void> check_namespace(const std::string& name) {
  if (name.empty() || name == "/") return {};
  return check_topic_name(name);
}

core::Result<RemapRule> parse_remap_rule(const std::string& text) {
  const std::size_t sign = text.find(":=");
  if (sign == std::string::npos) {
    return core::Error{"'" + text + "' is no rule; expected FROM:=TO, as scan:=front/scan"};
  }
  RemapRule rule{text.substr(0, sign), text.substr(sign + 2)};
  CLEW_RETURN_IF_ERROR(check_topic_name(rule.from));
  CLEW_RETURN_IF_ERROR(check_topic_name(rule.to));
  return rule;
}

Names::Names(const std::string& node_namespace, std::vector<RemapRule> rules)
    : namespace_(node_namespace.empty() || node_namespace.front() != '/' ? '/' + node_namespace
                                                                         : node_namespace),
      rules_(std::move(rules)) {}

std::string Names::absolute(const std::string& name) const {
  if (name.front() == '/') return name;
  return namespace_ == "/" ? '/' + name : namespace_ + '/' + name;
}

std::string Names::topic(const std::string& name) const {
  const std::string whole = absolute(name);
  for (const RemapRule& rule : rules_) {
    if (absolute(rule.from) == whole) return absolute(rule.to);
  }
  return whole;
}

std::string Names::frame(const std::string& name) const {
  return namespace_ == "/" ? name : namespace_.substr(1) + '/' + name;
}

std::string dds_topic(const std::string& topic) { return "rt" + topic; }

}  // namespace clew::ros2
