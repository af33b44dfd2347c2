// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "security/certificate.hpp"

namespace clew::bridge {

/// The file beside a file with its signature: `r.mcap.sig`. So the bytes of a recording stay what
/// the run alone decides, and it can be signed twice or not at all.
std::string signature_file(const std::string& file);

/// Writes it, with the signer's certificate. What is signed is the SHA-256 of the file.
core::Result<void> sign_file(const std::string& file, const CertifiedKey& signer);

/// What a signature says.
struct Signature {
  std::string signer;  ///< the certificate's subject: anybody may call himself so
  std::string key;     ///< `SHA256:<hexadecimal digits>` of the public key, which nobody else has
  std::string fault;   ///< why it does not hold; empty if it does
  std::string certificate;
};

/// Reads the signature of a file; none if there is no file of it. An error if that is none.
core::Result<std::optional<Signature>> read_signature(const std::string& file);

/// Why a signature that holds is not of the owner of `certificate` (PEM), or of somebody that he
/// vouches for; empty if it is. An error if that is no certificate.
core::Result<std::string> objection_to_signer(const Signature& signature,
                                              const std::string& certificate);

}  // namespace clew::bridge
