// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::bridge {

/// The files by which a participant proves who it is and is told what it may do, by their paths
/// (OMG DDS Security 1.1, sections 9.3.2 and 9.4.1). One authority vouches for both.
struct SecurityFiles {
  std::string authority;    ///< its certificate
  std::string certificate;  ///< of the participant
  std::string private_key;
  std::string governance;   ///< what is protected in the domain, signed by the authority
  std::string permissions;  ///< what the participant may write and read, likewise
};

}  // namespace clew::bridge
