// SPDX-License-Identifier: Apache-2.0
/// Where the source tree lies. One object file knows it, so that the others are the same in every
/// clone, and a compiler's cache that one clone has filled serves the next one.
#pragma once

#include <string>

namespace clew::tests {

/// The path of a file or folder of the source tree, by its path from the project's root.
std::string source_path(const std::string& path);

}  // namespace clew::tests
