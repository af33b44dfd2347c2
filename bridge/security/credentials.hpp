// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "security/certificate.hpp"
#include "security/policy.hpp"

namespace clew::bridge {

/// The contents of SecurityFiles.
struct SecurityTexts {
  std::string authority;
  std::string certificate;
  std::string private_key;
  std::string governance;
  std::string permissions;
};

/// What credentials are wanted for.
struct CredentialUse {
  SubjectHalf half = SubjectHalf::kLower;
  Rights rights;  ///< at least
};

/// Where a fault is, as a file's name in a KeyDirectory, and what it is.
struct CredentialFault {
  std::string file;
  std::string text;
};

/// Everything that is wrong with an authority and its governance, at the time `now`. Here and below
/// an empty text is passed over: whoever reads the file tells that it is not there.
std::vector<CredentialFault> check_authority(const CertifiedKey& authority,
                                             const std::string& governance, std::time_t now);
/// Everything that is wrong with a participant's own certificate, key and permissions. Both vendors
/// find most of it, too: each some, in words of its own, and only once the run has begun.
std::vector<CredentialFault> check_identity(const SecurityTexts& credentials,
                                            const CredentialUse& use, std::time_t now);

/// New credentials of a participant for `use`, vouched for by `authority`. `governance` is signed
/// already.
core::Result<SecurityTexts> mint_identity(const CertifiedKey& authority,
                                          const std::string& governance, const std::string& name,
                                          const CredentialUse& use, const Validity& validity);

/// The names of their files.
inline constexpr char kAuthorityFile[] = "ca.pem";
inline constexpr char kAuthorityKeyFile[] = "ca.key";
inline constexpr char kGovernanceFile[] = "governance.p7s";
inline constexpr char kCertificateFile[] = "certificate.pem";
inline constexpr char kPrivateKeyFile[] = "private.key";
inline constexpr char kPermissionsFile[] = "permissions.p7s";

}  // namespace clew::bridge
