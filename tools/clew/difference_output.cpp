// SPDX-License-Identifier: Apache-2.0
#include "clew/difference_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clew::tools {
namespace {

using bridge::FieldValue;
using nlohmann::ordered_json;

constexpr std::size_t kMostFields = 40;  // of a difference that are printed

struct ValueJson {
  ordered_json operator()(double value) const {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(bridge::field_text(value));
  }
  template <typename Other>
  ordered_json operator()(const Other& value) const {
    return value;
  }
};

std::string text_of(const std::optional<FieldValue>& value) {
  return value ? bridge::field_text(*value) : "-";
}

/// `ranges_m` for `ranges_m[3]`; empty for what is no plain item of a list.
std::string list_of(const std::string& path) {
  if (path.empty() || path.back() != ']') return {};
  return path.substr(0, path.rfind('['));
}

}  // namespace

ordered_json value_json(const std::optional<FieldValue>& value) {
  return value ? std::visit(ValueJson{}, *value) : ordered_json(nullptr);
}

ordered_json difference_json(const std::optional<bridge::SampleDifference>& difference) {
  if (!difference) return nullptr;
  const bridge::FieldDifference& field = difference->fields.front();
  return {{"topic", domain::topic_name(difference->topic)},
          {"tick", difference->tick},
          {"field", field.path},
          {"a", value_json(field.a)},
          {"b", value_json(field.b)}};
}

void print_difference(const bridge::SampleDifference& difference, const char* a_name,
                      const char* b_name) {
  const std::size_t shown = std::min(difference.fields.size(), kMostFields);
  std::size_t path_width = 0;
  std::size_t a_width = std::string_view(a_name).size();
  for (std::size_t i = 0; i < shown; ++i) {
    path_width = std::max(path_width, difference.fields[i].path.size());
    a_width = std::max(a_width, text_of(difference.fields[i].a).size());
  }
  const std::string place =
      fmt::format("tick {}, {}", difference.tick, domain::topic_name(difference.topic));
  path_width = std::max(path_width, place.size());
  fmt::print("  {:<{}}  {:<{}}  {}\n", place, path_width, a_name, a_width, b_name);
  for (std::size_t i = 0; i < shown; ++i) {
    const bridge::FieldDifference& field = difference.fields[i];
    fmt::print("  {:<{}}  {:<{}}  {}\n", field.path, path_width, text_of(field.a), a_width,
               text_of(field.b));
  }
  if (shown < difference.fields.size()) {
    fmt::print("  and {} fields more\n", difference.fields.size() - shown);
  }
}

void print_fields(const std::string& prefix, const std::vector<bridge::Field>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string list = list_of(fields[i].path);
    if (list.empty()) {
      fmt::print("{}{} = {}\n", prefix, fields[i].path, bridge::field_text(fields[i].value));
      continue;
    }
    std::string items = bridge::field_text(fields[i].value);
    while (i + 1 < fields.size() && list_of(fields[i + 1].path) == list) {
      items += ", " + bridge::field_text(fields[++i].value);
    }
    fmt::print("{}{} = [{}]\n", prefix, list, items);
  }
}

}  // namespace clew::tools
