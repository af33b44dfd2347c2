// SPDX-License-Identifier: Apache-2.0
#include "clew/version.hpp"

#include "wire/codec.hpp"

namespace clew::tools {

std::string version_text() {
  return "clew " CLEW_VERSION " (Fast DDS " CLEW_FASTDDS_VERSION
         ", Cyclone DDS " CLEW_CYCLONEDDS_VERSION ", IDL " +
         std::string(bridge::idl_fingerprint()) + ")";
}

}  // namespace clew::tools
