// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "security/openssl.hpp"

namespace clew::bridge {

/// From when to when something holds, in seconds of the Unix epoch.
struct Validity {
  std::time_t not_before = 0;
  std::time_t not_after = 0;
};

/// A key and the certificate of it, both PEM.
struct CertifiedKey {
  std::string certificate;
  std::string private_key;
};

/// Whose turn it is to begin a handshake follows from the first bit of the SHA-256 of a subject,
/// from which both vendors make the GUID of a participant (DDS Security 1.1, table 52).
enum class SubjectHalf : std::uint8_t { kLower, kUpper };
SubjectHalf half_of(const X509& certificate);

/// A new authority that vouches for itself, on the curve P-256, as all keys here are: both vendors
/// know it, and it is the fastest.
CertifiedKey make_authority(const std::string& name, const Validity& validity);

/// A new key for signatures of files (Ed25519, RFC 8032), for which nobody else vouches.
CertifiedKey make_signing_key(const std::string& name, const Validity& validity);
/// The key and the certificate that a text holds among other things. Refused: one of which one
/// is missing, or the two do not belong together.
core::Result<CertifiedKey> read_certified_key(const std::string& pem);
/// The digest that goes with a key's signatures; null where it is a part of them, as with Ed25519.
const EVP_MD* digest_for(const EVP_PKEY& key);

/// A new key that `authority` vouches for. The subject is `CN=<name>-<number>`, with the first
/// number that puts it into `half`.
core::Result<CertifiedKey> issue_certificate(const CertifiedKey& authority, const std::string& name,
                                             SubjectHalf half, const Validity& validity);

/// What a computer does in a run over several hosts: it starts components for others, or it runs
/// graphs and has others start components.
enum class HostRole : std::uint8_t { kHost, kRunner };
std::string_view role_name(HostRole role);  ///< `host`, `run`
/// The same for a computer's end of a connection (TLS). The certificate says its role and its name
/// as `URI:clew:<role>:<name>`, which no component's certificate does.
core::Result<CertifiedKey> issue_host_certificate(const CertifiedKey& authority, HostRole role,
                                                  const std::string& name,
                                                  const Validity& validity);
/// The name that a certificate has in that role; none if it has not.
std::optional<std::string> host_name_in(X509& certificate, HostRole role);

/// The text with the authority's signature, as S/MIME (RFC 5751), which is what both vendors read.
core::Result<std::string> sign_text(const std::string& text, const CertifiedKey& authority);
/// The text inside, if it was signed with the key of `authority` and not changed since.
core::Result<std::string> verify_text(const std::string& signed_text, X509& authority);

}  // namespace clew::bridge
