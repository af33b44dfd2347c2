// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace clew::tools {

/// The path of the clew command that runs, to start component processes with.
std::string own_program();

/// Version and digest of that file: what the results of a bench depend on.
core::Result<std::string> program_fingerprint();

}  // namespace clew::tools
