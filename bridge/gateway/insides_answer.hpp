// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gateway/program_runs.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// What a page is told of a tick: what `clew explain --json` printed, and the line to type for the
/// same. A program that failed is a refusal with what it said.
WebResponse insides_answer(const ProgramEnd& end, const std::string& line);

}  // namespace clew::bridge
