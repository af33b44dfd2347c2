// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace clew::bridge {

/// Starts a program in a group of its own, with no input, no signal blocked, and its output going
/// to these files. Returns 0, or the number of the error.
int start_program(std::vector<std::string> words, int out, int err, pid_t& process);

}  // namespace clew::bridge
