// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "core/nearest_name.hpp"
#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

using core::ParameterInfo;
using core::ParameterValue;
using core::Result;
using core::YamlNode;

core::Error in_parameter(const ParameterInfo& info, core::Error error) {
  error.message = info.name + ": " + error.message;
  return error;
}

Result<void> check_range(const ParameterInfo& info, double value, const YamlNode& node) {
  if (!info.range || (value >= info.range->min && value <= info.range->max)) return {};
  const std::string unit = info.unit.empty() || info.unit == "1" ? "" : ' ' + info.unit;
  return node.error(fmt::format("{} is {}; allowed: {} to {}{}", info.name, value, info.range->min,
                                info.range->max, unit));
}

Result<void> check_word(const ParameterInfo& info, const std::string& word, const YamlNode& node) {
  if (info.choices.empty() ||
      std::find(info.choices.begin(), info.choices.end(), word) != info.choices.end()) {
    return {};
  }
  return node.error(core::unknown_name(info.name, word, info.choices));
}

Result<ParameterValue> read_words(const ParameterInfo& info, const YamlNode& node) {
  const auto items = node.items();
  if (!items.ok()) return in_parameter(info, items.error());
  std::vector<std::string> words;
  for (const YamlNode& item : *items) {
    auto word = item.string();
    if (!word.ok()) return in_parameter(info, word.error());
    CLEW_RETURN_IF_ERROR(check_word(info, *word, item));
    if (std::find(words.begin(), words.end(), *word) != words.end()) {
      return item.error(info.name + ": '" + *word + "' stands twice in the list");
    }
    words.push_back(*word);
  }
  return ParameterValue(words);
}

// The type of the default is the type of the parameter.
Result<ParameterValue> read_value(const ParameterInfo& info, const YamlNode& node) {
  const ParameterValue& like = info.default_value;
  if (std::holds_alternative<bool>(like)) {
    const auto value = node.boolean();
    if (!value.ok()) return in_parameter(info, value.error());
    return ParameterValue(*value);
  }
  if (std::holds_alternative<std::int64_t>(like)) {
    const auto value = node.integer();
    if (!value.ok()) return in_parameter(info, value.error());
    CLEW_RETURN_IF_ERROR(check_range(info, static_cast<double>(*value), node));
    return ParameterValue(*value);
  }
  if (std::holds_alternative<double>(like)) {
    const auto value = node.number();
    if (!value.ok()) return in_parameter(info, value.error());
    CLEW_RETURN_IF_ERROR(check_range(info, *value, node));
    return ParameterValue(*value);
  }
  if (std::holds_alternative<std::string>(like)) {
    const auto value = node.string();
    if (!value.ok()) return in_parameter(info, value.error());
    CLEW_RETURN_IF_ERROR(check_word(info, *value, node));
    return ParameterValue(*value);
  }
  return read_words(info, node);
}

}  // namespace

Result<core::ParameterValues> resolve_parameters(const std::vector<ParameterInfo>& infos,
                                                 const std::vector<RawParameter>& given,
                                                 const std::string& owner) {
  core::ParameterValues values = core::default_values(infos);
  for (const RawParameter& parameter : given) {
    const auto info = std::find_if(infos.begin(), infos.end(), [&](const ParameterInfo& candidate) {
      return candidate.name == parameter.name;
    });
    if (info == infos.end()) {
      std::vector<std::string> known;
      for (const ParameterInfo& candidate : infos) known.push_back(candidate.name);
      return parameter.where.error(
          core::unknown_name("parameter of " + owner, parameter.name, known));
    }
    auto value = read_value(*info, parameter.value);
    if (!value.ok()) return value.error();
    values[info->name] = std::move(value).value();
  }
  return values;
}

}  // namespace clew::runtime
