// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "security/credentials.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {

/// Cyclone DDS must begin the handshake with Fast DDS, since it refuses the form of key that Fast
/// DDS 2.9 proposes; whose subject is in the lower half begins.
SubjectHalf half_for(Vendor vendor);

/// An authority and the identities that it vouches for, as files:
///
///     DIR/ca.pem, ca.key, governance.p7s
///     DIR/sense.cyclonedds/certificate.pem, private.key, permissions.p7s
///
/// A run needs all but `ca.key`, which may be kept elsewhere. An identity is of one vendor.
class KeyDirectory {
 public:
  explicit KeyDirectory(std::string path) : path_(std::move(path)) {}

  /// Makes the directory with a new authority. Refused: one that has an authority already.
  core::Result<void> create(const std::string& authority, const Validity& validity) const;
  /// Makes an identity, in place of one that is there.
  core::Result<void> mint(const std::string& name, Vendor vendor, const Rights& rights,
                          const Validity& validity) const;

  /// What all identities share.
  struct Shared {
    CertifiedKey authority;  ///< its private key may be empty
    std::string governance;
  };
  /// Reads it, and everything that is wrong with it and the directory; files are named with their
  /// paths.
  Shared read_shared(std::time_t now, std::vector<CredentialFault>& faults) const;
  /// The credentials of an identity, and everything that is wrong with its own files.
  SecurityTexts read_identity(const Shared& shared, const std::string& name, Vendor vendor,
                              const Rights& rights, std::time_t now,
                              std::vector<CredentialFault>& faults) const;
  /// Those that are there, in order.
  std::vector<std::pair<std::string, Vendor>> identities() const;

 private:
  std::string path_to(const std::string& file) const { return path_ + '/' + file; }

  std::string path_;
};

}  // namespace clew::bridge
