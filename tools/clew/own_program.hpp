// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::tools {

/// The path of the clew command that runs, to start component processes with.
std::string own_program();

}  // namespace clew::tools
