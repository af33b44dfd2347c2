// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "replay/sample_comparison.hpp"

namespace clew::tools {

/// {topic, tick, field, a, b} of the first field that differs, or null. Numbers that JSON does not
/// have are texts.
nlohmann::ordered_json difference_json(const std::optional<bridge::SampleDifference>& difference);

/// A value as JSON; null for none.
nlohmann::ordered_json value_json(const std::optional<bridge::FieldValue>& value);

/// Where two samples differ, and every field that does, as a table whose columns are called
/// `a_name` and `b_name`.
void print_difference(const bridge::SampleDifference& difference, const char* a_name,
                      const char* b_name);

/// A message's fields, one a line, each beginning with `prefix`; lists of values on one line.
void print_fields(const std::string& prefix, const std::vector<bridge::Field>& fields);

}  // namespace clew::tools
