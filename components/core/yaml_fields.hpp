// SPDX-License-Identifier: Apache-2.0
/// What all data files have in common: a format line, and numbers within limits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "core/yaml_reader.hpp"

namespace clew::core {

/// Whether the map says `format: <format>`.
Result<void> check_format(const YamlNode& map, const char* format);

/// Whether the number read from `node` is within its range, both ends included.
Result<void> check_range(const YamlNode& node, double number, Range range);

/// The number at a key that must be there, within its range.
Result<void> read_number(const YamlNode& map, const char* key, Range range, double& field);

/// The angle at a key that must be there, written in degrees within `range_deg`.
Result<void> read_angle(const YamlNode& map, const char* key, Range range_deg, double& field_rad);

/// Three numbers at a key that must be there, each within its range; `what` they are, for messages.
Result<void> read_numbers(const YamlNode& map, const char* key, const char* what, Range range,
                          std::array<double, 3>& fields);

/// The whole number that `node` is, within its range, both ends included.
Result<std::int64_t> count_of(const YamlNode& node, std::int64_t least, std::int64_t most);

/// The whole number at a key that must be there, within its range, both ends included.
Result<void> read_count(const YamlNode& map, const char* key, std::int64_t least, std::int64_t most,
                        std::uint64_t& field);

/// The names at a key that must be there, one or more.
Result<void> read_names(const YamlNode& map, const char* key, std::vector<std::string>& fields);

/// Three counts at a key that must be there, each a whole number of at least 1.
Result<void> read_counts(const YamlNode& map, const char* key,
                         std::array<std::uint32_t, 3>& fields);

}  // namespace clew::core
