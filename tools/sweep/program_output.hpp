// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::sweep {

/// A program that has ended.
struct ProgramOutput {
  int status = 0;  ///< 128 and more: ended by a signal
  std::string out;
  std::string err;
};

/// Runs a program of the path and waits for it. It does not get the signals of the terminal, so
/// that Ctrl-C does not end it in the middle of what it is told to do. Refused: a program that is
/// not there.
core::Result<ProgramOutput> run_program(const std::vector<std::string>& words);

}  // namespace clew::sweep
