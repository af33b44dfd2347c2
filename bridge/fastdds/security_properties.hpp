// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "dds/security_files.hpp"

namespace clew::bridge {

/// The properties of a participant by which Fast DDS takes part in a secured domain.
inline std::map<std::string, std::string> fastdds_security_properties(const SecurityFiles& files) {
  const auto file = [](const std::string& path) { return "file://" + path; };
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  return {{"dds.sec.auth.plugin", "builtin.PKI-DH"},
          {identity + "identity_ca", file(files.authority)},
          {identity + "identity_certificate", file(files.certificate)},
          {identity + "private_key", file(files.private_key)},
          {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"},
          {"dds.sec.access.plugin", "builtin.Access-Permissions"},
          {access + "permissions_ca", file(files.authority)},
          {access + "governance", file(files.governance)},
          {access + "permissions", file(files.permissions)}};
}

}  // namespace clew::bridge
