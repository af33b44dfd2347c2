// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace clew::fleet {

/// The whole path of a folder, which is made if it is not there, with those above it. Refused: what
/// is no folder.
core::Result<std::string> make_folder(const std::string& folder);

/// Refused without `force`: a file that exists.
core::Result<void> check_new_file(const std::string& path, bool force);

}  // namespace clew::fleet
