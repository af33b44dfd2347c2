// SPDX-License-Identifier: Apache-2.0
/// `clew run` of a fleet.
#pragma once

#include <optional>

#include "clew/run_options.hpp"
#include "core/resources.hpp"
#include "run/end_signals.hpp"

namespace clew::tools {

/// The fleet file that `clew run` was asked for, if it is one: graphs come first.
std::optional<core::Resource> fleet_of(const RunOptions& options);

/// Runs it and prints the result; the exit status.
int run_fleet_command(const RunOptions& options, const core::Resource& file,
                      bridge::EndSignals& signals);

}  // namespace clew::tools
