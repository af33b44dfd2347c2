// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace clew::runtime {

/// Where the user keeps settings of Clew: `$XDG_CONFIG_HOME/clew`, else `~/.config/clew`, whether
/// it is there or not. A variable with a relative path counts as not set, as the XDG Base Directory
/// Specification says. None: HOME is not set either.
std::optional<std::string> user_config_folder();

}  // namespace clew::runtime
