// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "wire/field_list.hpp"
#include "wire/sample.hpp"

namespace clew::tools {

/// `entries.rule` for `entries[3].rule`.
std::string without_indices(const std::string& path);

/// The fields that are `wanted`, or lie in one of them; all, if none is.
std::vector<bridge::Field> chosen_fields(const std::vector<bridge::Field>& fields,
                                         const std::vector<std::string>& wanted);

/// A sample as a line of JSON: `tick`, `sequence`, then its fields, or the wanted ones by their
/// paths.
std::string sample_json(const bridge::SampleView& sample, const std::vector<bridge::Field>& fields,
                        const std::vector<std::string>& wanted);

/// A sample for people: its tick and sequence, and a line a field.
void print_sample(const bridge::SampleView& sample, const std::vector<bridge::Field>& fields);

}  // namespace clew::tools
