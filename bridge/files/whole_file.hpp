// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace clew::files {

/// Writes a file anew. Refused, with the system's reason: what cannot be opened, and what does not
/// arrive whole, on a full disk for one. Then the file is what it was before: the new one is
/// written beside it and takes its place when it is whole. Links, devices and files of others are
/// written in place.
core::Result<void> write_file(const std::string& path, const std::string& bytes);

/// All bytes of a file.
core::Result<std::string> read_file(const std::string& path);

/// Makes a directory and those above it; one that is there is good.
core::Result<void> make_directory(const std::string& path);

/// Writes all bytes to an open file: the rest, too, where the system takes less than it was given,
/// so that errno tells why it takes no more. False if they did not all arrive.
bool write_all(int file, const std::string& bytes);

}  // namespace clew::files
