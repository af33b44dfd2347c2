// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "hunt/property.hpp"

namespace clew::tools {

/// The option --property.
void add_property(CLI::App& app, std::string& text);

/// What was typed for it. Refused, with the column: what is no property, and nothing.
core::Result<hunt::Property> read_property(const std::string& text);

/// The table of fields, for people.
void print_fields();

}  // namespace clew::tools
