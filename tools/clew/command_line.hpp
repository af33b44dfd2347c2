// SPDX-License-Identifier: Apache-2.0
/// What the commands' own lines have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "runtime/graph.hpp"

namespace clew::tools {

/// A number that means the same to every reader: 010 is 8 to some, and 10 to others.
CLI::Validator decimal_number();

/// A whole number from 0 on: counts, which a graph file holds, too.
CLI::Validator whole_number();

/// A number from `low` to `high`, and no NaN, which passes every comparison that is made to refuse
/// it.
CLI::Validator number_between(double low, double high);

/// A size from `least` bytes on, which becomes that of bytes: `2000000`, `2MB`, `0.5GB`.
CLI::Validator size_in_bytes(std::uint64_t least);

/// A name that is not empty: of a file to write, of a run.
CLI::Validator given_name();

/// The options with which `run` and `check` change a graph.
void add_overrides(CLI::App& app, runtime::GraphOverrides& overrides);

}  // namespace clew::tools
