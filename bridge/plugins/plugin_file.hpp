// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "plugin/descriptor.hpp"

namespace clew::bridge {

/// A plug-in as a file. Nothing of it has run.
struct PluginFile {
  std::string path;    ///< absolute
  std::string digest;  ///< XXH3-128 of its bytes
  plugin::Descriptor descriptor;

  std::string name() const { return descriptor.name.data(); }
  std::string version() const { return descriptor.version.data(); }
};

/// Reads the descriptor of a shared library, without loading it. Refused: what is no shared library
/// of this machine's kind, one without a descriptor, and names or versions with other characters
/// than a-z, A-Z, 0-9, `_`, `-` and `.`.
core::Result<PluginFile> read_plugin_file(const std::string& path);

/// Refused: a plug-in that was built with other headers or by a compiler that lays types out in
/// another way than this program's.
core::Result<void> check_fits(const PluginFile& file);

}  // namespace clew::bridge
