// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace clew::tools {

/// A command line of clew as a person types it: words that a shell would take apart stand in
/// quotes.
std::string typed_line(const std::vector<std::string>& words);

}  // namespace clew::tools
