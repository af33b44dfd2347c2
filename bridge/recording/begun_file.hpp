// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace clew::bridge {

/// Whether a file is one that a recorder had reserved, and died before it held anything but a part
/// of what a recording begins with: there is nothing in it to lose. Errors are those of reading.
core::Result<bool> is_only_begun(const std::string& file);

}  // namespace clew::bridge
