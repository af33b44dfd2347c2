// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "security/certificate.hpp"
#include "security/credentials.hpp"

namespace clew::bridge {

/// By what a computer proves who it is to others of the same authority. As files, in a directory
/// that can be carried to it:
///
///     NAME.host/ca.pem, certificate.pem, private.key
struct HostIdentity {
  std::string authority;  ///< its certificate
  CertifiedKey own;
  std::string name;  ///< as the own certificate says

  /// Reads it. Refused: anything missing, expired, of another authority, for another role, or a
  /// key that others may read; the error says the first fault.
  static core::Result<HostIdentity> read(const std::string& directory, HostRole role,
                                         std::time_t now);
};

/// `DIR/NAME.host` or `DIR/NAME.run`.
std::string host_identity_directory(const std::string& keys, const std::string& name,
                                    HostRole role);
/// Makes an identity with the authority of a KeyDirectory, in place of one that is there.
core::Result<void> mint_host_identity(const std::string& keys, const std::string& name,
                                      HostRole role, const Validity& validity);

/// What is wrong with a certificate in that role at the time `now`; empty if nothing is. `expected`
/// is the name that it must have, or empty.
std::string fault_of(X509& certificate, X509& authority, HostRole role, const std::string& expected,
                     std::time_t now);

}  // namespace clew::bridge
