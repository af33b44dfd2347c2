// SPDX-License-Identifier: Apache-2.0
#include "clew/recorded_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/quoted.hpp"

namespace clew::tools {
namespace {

using bridge::Field;
using nlohmann::ordered_json;

constexpr std::string_view kLength = ".length";

struct PlainJson {
  ordered_json operator()(double value) const {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  }
  template <typename Other>
  ordered_json operator()(const Other& value) const {
    return value;
  }
};

/// The place in `root` of a path such as `entries[0].rule`, made where it is missing.
ordered_json& place_of(ordered_json& root, std::string_view path) {
  ordered_json* place = &root;
  while (!path.empty()) {
    if (path.front() == '[') {
      const std::size_t end = path.find(']');
      const auto index =
          static_cast<std::size_t>(std::atoll(std::string(path.substr(1, end - 1)).c_str()));
      place = &(*place)[index];
      path.remove_prefix(end + 1);
    } else {
      if (path.front() == '.') path.remove_prefix(1);
      const std::string_view name = path.substr(0, path.find_first_of(".["));
      place = &(*place)[std::string(name)];
      path.remove_prefix(name.size());
    }
  }
  return *place;
}

struct CellText {
  std::string operator()(const std::string& value) const { return core::csv_field(value); }
  std::string operator()(std::string_view value) const { return std::string(value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::uint64_t value) const { return std::to_string(value); }
};

}  // namespace

core::Result<std::vector<Field>> FieldReader::fields_of(const bridge::SampleView& sample) {
  return domain::visit_topic(sample.topic, [&](auto constant) -> core::Result<std::vector<Field>> {
    constexpr auto kIndex = index_of(decltype(constant)::value);
    auto& message = std::get<kIndex>(messages_);
    const auto decoded = bridge::decode(sample.cdr, &message, bridge::Values::kAny);
    if (decoded.ok()) return bridge::fields_of(message);
    return core::Error{fmt::format("tick {} of {}: {}", sample.tick,
                                   domain::topic_name(sample.topic), decoded.error().message)};
  });
}

void keep_recorded(const bridge::RunRecording& recording, domain::Topic topic,
                   std::vector<Field>& fields) {
  fields.erase(
      std::remove_if(fields.begin(), fields.end(),
                     [&](const Field& field) { return !recording.has_field(topic, field.path); }),
      fields.end());
}

bool is_length(const std::string& path) {
  return path.size() > kLength.size() &&
         path.compare(path.size() - kLength.size(), kLength.size(), kLength) == 0;
}

bool lies_in(const std::string& path, const std::string& wanted) {
  if (path.compare(0, wanted.size(), wanted) != 0) return false;
  return path.size() == wanted.size() || path[wanted.size()] == '.' || path[wanted.size()] == '[';
}

ordered_json fields_json(const std::vector<Field>& fields) {
  ordered_json json = ordered_json::object();
  for (const Field& field : fields) {
    if (is_length(field.path)) {
      // A list without items is one, too.
      place_of(json, field.path.substr(0, field.path.size() - kLength.size())) =
          ordered_json::array();
    } else {
      place_of(json, field.path) = std::visit(PlainJson{}, field.value);
    }
  }
  return json;
}

ordered_json field_json(const std::vector<Field>& fields, const std::string& wanted) {
  std::vector<Field> inside;
  for (const Field& field : fields) {
    if (lies_in(field.path, wanted)) inside.push_back(field);
  }
  if (inside.empty()) return nullptr;
  // Below what is wanted, paths begin with what is behind it.
  for (Field& field : inside) field.path = "wanted" + field.path.substr(wanted.size());
  return fields_json(inside)["wanted"];
}

void FieldColumns::add(const std::vector<Field>& fields) {
  std::size_t next = 0;
  for (const Field& field : fields) {
    if (is_length(field.path)) continue;
    const bool is_next = next < paths_.size() && paths_[next] == field.path;
    const auto known = is_next ? paths_.begin() + static_cast<std::ptrdiff_t>(next)
                               : std::find(paths_.begin(), paths_.end(), field.path);
    if (known == paths_.end()) {
      paths_.insert(paths_.begin() + static_cast<std::ptrdiff_t>(next), field.path);
    } else {
      next = static_cast<std::size_t>(known - paths_.begin());
    }
    ++next;
  }
}

std::string FieldColumns::row(const std::vector<Field>& fields) const {
  std::map<std::string_view, const bridge::FieldValue*> values;
  for (const Field& field : fields) values.emplace(field.path, &field.value);
  std::string text;
  for (const std::string& path : paths_) {
    const auto value = values.find(path);
    if (!text.empty() || &path != &paths_.front()) text += ',';
    if (value != values.end()) text += std::visit(CellText{}, *value->second);
  }
  return text;
}

}  // namespace clew::tools
