// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "security/credentials.hpp"

namespace clew::bridge {

enum class Secrecy : std::uint8_t {
  kPublic,  ///< anybody may read it, nobody else write
  kSecret   ///< nobody else may read it
};

/// The contents of a file that trust is built on. A fault, and empty: what is missing, unreadable,
/// empty, larger than 64 KiB or no regular file. A fault: what others own, may write, or, of a
/// secret, read.
std::string read_kept_file(const std::string& path, Secrecy secrecy,
                           std::vector<CredentialFault>& faults);

/// A fault: a directory that is missing, or that others own or may write to.
void check_kept_directory(const std::string& path, std::vector<CredentialFault>& faults);

/// Writes a file whole or not at all, readable as its secrecy allows from the first byte on.
core::Result<void> write_kept_file(const std::string& path, const std::string& text,
                                   Secrecy secrecy);

}  // namespace clew::bridge
