// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::tools {

/// Draws fields of recordings over time into `output`, a line each: `state.speed_mps`,
/// `scan.ranges_m[3]`. Refused: topics and fields that a recording lacks, and fields that are no
/// numbers.
core::Result<void> plot_fields(const std::vector<std::string>& recordings,
                               const std::vector<std::string>& fields, const std::string& output);

}  // namespace clew::tools
