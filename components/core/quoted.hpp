// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::core {

/// A text as a YAML file has it between double quotes, on one line; reading gives the same text.
std::string yaml_quoted(const std::string& text);

/// A word as a shell takes it: as it is, or between single quotes where it must be.
std::string shell_word(const std::string& word);

/// A field as a CSV file has it: as it is, or between double quotes where it must be.
std::string csv_field(const std::string& text);

}  // namespace clew::core
