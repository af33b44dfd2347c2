// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/parameters.hpp"

namespace clew::tools {

/// A parameter's default as a person writes it in a graph file, without its unit.
std::string default_text(const core::ParameterInfo& info);

/// What a parameter may be: `0 to 1`, `four | eight`, `a file of configs/maps`; empty if anything.
std::string allowed_text(const core::ParameterInfo& info);

/// The parameters as a table in Markdown, for a README.
std::string parameter_table(const std::vector<core::ParameterInfo>& infos);

}  // namespace clew::tools
