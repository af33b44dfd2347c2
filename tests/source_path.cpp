// SPDX-License-Identifier: Apache-2.0
#include "tests/source_path.hpp"

namespace clew::tests {

std::string source_path(const std::string& path) { return CLEW_SOURCE_DIR "/" + path; }

}  // namespace clew::tests
