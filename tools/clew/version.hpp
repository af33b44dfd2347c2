// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::tools {

/// `clew 0.1.0 (Fast DDS 2.9.1, Cyclone DDS 0.10.2, IDL <fingerprint>)`.
std::string version_text();

}  // namespace clew::tools
