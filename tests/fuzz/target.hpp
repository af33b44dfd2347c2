// SPDX-License-Identifier: Apache-2.0
/// Inputs that may come from strangers, each with what reads it. libFuzzer (tools/fuzz) and the
/// mutants of mutants_test.cpp feed the same targets, beginning with the same seeds.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "core/result.hpp"

namespace clew::fuzz {

using Seeds = std::vector<std::string>;

struct Target {
  const char* name;
  /// Reads an input, whatever it is: an input may be refused, with a message, or be good. All else
  /// aborts.
  void (*read)(std::string_view input);
  /// Good inputs: shipped files, files of tests/, and what our own writers write.
  Seeds (*seeds)();
};

// By file of this folder.
std::vector<Target> text_targets();       ///< graphs, worlds, robots, rules, networks, suites
std::vector<Target> picture_targets();    ///< maps and pictures
std::vector<Target> recording_targets();  ///< MCAP, recordings of runs
std::vector<Target> wire_targets();       ///< samples, ROS 2's samples, identities
std::vector<Target> line_targets();       ///< frames of the line, web sockets
std::vector<Target> state_targets();      ///< saved states of components

/// All of them.
std::vector<Target> all_targets();

/// What a reader that refuses owes.
inline void check_refusal(const core::Error& error) {
  CLEW_CHECK(!error.message.empty(), "an error without a message");
}
template <typename Value>
bool is_good(const core::Result<Value>& result) {
  if (!result.ok()) check_refusal(result.error());
  return result.ok();
}

/// Files of the source tree, by their paths from its root.
Seeds files(const std::vector<std::string>& paths);
/// All files of a folder of the source tree with this ending, no larger than `most_bytes`.
Seeds files_of(const std::string& folder, const std::string& ending, std::size_t most_bytes);

}  // namespace clew::fuzz
