// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_fields.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace clew::core {
namespace {

constexpr double kMostCount = 1e9;

/// 0.3 as `0.3`.
std::string text_of(double number) {
  std::string text = std::to_string(number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Result<void> check_format(const YamlNode& map, const char* format) {
  if (map.kind() == YamlKind::kMap && !map.find("format")) {
    return map.error("missing key 'format', expected " + std::string(format));
  }
  const auto node = map.at("format");
  if (!node.ok()) return node.error();
  const auto found = node->string();
  if (found.ok() && *found == format) return {};
  return node->error("found " + node->found() + ", expected " + format);
}

Result<void> check_range(const YamlNode& node, double number, Range range) {
  if (number >= range.min && number <= range.max) return {};
  return node.error("found " + text_of(number) + ", expected a number from " + text_of(range.min) +
                    " to " + text_of(range.max));
}

Result<void> read_number(const YamlNode& map, const char* key, Range range, double& field) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto number = node->number();
  if (!number.ok()) return number.error();
  field = *number;
  return check_range(*node, field, range);
}

Result<void> read_angle(const YamlNode& map, const char* key, Range range_deg, double& field_rad) {
  double angle_deg = 0.0;
  CLEW_RETURN_IF_ERROR(read_number(map, key, range_deg, angle_deg));
  field_rad = radians(angle_deg);
  return {};
}

Result<void> read_numbers(const YamlNode& map, const char* key, const char* what, Range range,
                          std::array<double, 3>& fields) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto numbers = node->numbers(fields.size(), what);
  if (!numbers.ok()) return numbers.error();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    fields[i] = (*numbers)[i];
    CLEW_RETURN_IF_ERROR(check_range(*node, fields[i], range));
  }
  return {};
}

Result<std::int64_t> count_of(const YamlNode& node, std::int64_t least, std::int64_t most) {
  const auto number = node.integer();
  if (!number.ok() || (*number >= least && *number <= most)) return number;
  const bool open = most == std::numeric_limits<std::int64_t>::max();
  return node.error("found " + node.found() + ", expected a whole number " +
                    (open ? "of at least " + std::to_string(least)
                          : "from " + std::to_string(least) + " to " + std::to_string(most)));
}

Result<void> read_count(const YamlNode& map, const char* key, std::int64_t least, std::int64_t most,
                        std::uint64_t& field) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto number = count_of(*node, least, most);
  if (!number.ok()) return number.error();
  field = static_cast<std::uint64_t>(*number);
  return {};
}

Result<void> read_names(const YamlNode& map, const char* key, std::vector<std::string>& fields) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto items = node->items();
  if (!items.ok()) return items.error();
  if (items->empty()) return node->error("found an empty list, expected at least one name");
  for (const YamlNode& item : *items) {
    const auto name = item.string();
    if (!name.ok()) return name.error();
    fields.push_back(*name);
  }
  return {};
}

Result<void> read_counts(const YamlNode& map, const char* key,
                         std::array<std::uint32_t, 3>& fields) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto numbers = node->numbers(fields.size(), "three counts");
  if (!numbers.ok()) return numbers.error();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double count = (*numbers)[i];
    if (count < 1.0 || count > kMostCount || count != std::floor(count)) {
      return node->error("found " + text_of(count) + ", expected whole numbers of at least 1");
    }
    fields[i] = static_cast<std::uint32_t>(count);
  }
  return {};
}

}  // namespace clew::core
