// SPDX-License-Identifier: Apache-2.0
#include "security/credentials.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <iterator>

namespace clew::bridge {
namespace {

using core::Result;
using Faults = std::vector<CredentialFault>;

/// Strength of a key in bits of a cipher (NIST SP 800-57): that of RSA with 2048 bits.
constexpr int kLeastSecurityBits = 112;

std::string date(std::time_t time) {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(time));
}

std::time_t to_time(const ASN1_TIME* time) {
  std::tm parts{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return 0;
  return ::timegm(&parts);
}

Validity validity_of(const X509& certificate) {
  return {to_time(X509_get0_notBefore(&certificate)), to_time(X509_get0_notAfter(&certificate))};
}

void check_time(const char* file, const Validity& validity, std::time_t now, Faults& faults) {
  if (now < validity.not_before) {
    faults.push_back({file, "is not valid before " + date(validity.not_before)});
  }
  if (now > validity.not_after) faults.push_back({file, "expired on " + date(validity.not_after)});
}

void check_strength(const char* file, const X509& certificate, Faults& faults) {
  const EVP_PKEY* const key = X509_get0_pubkey(&certificate);
  const int bits = key != nullptr ? EVP_PKEY_get_security_bits(key) : 0;
  if (bits >= kLeastSecurityBits) return;
  faults.push_back({file, fmt::format("its key has a strength of {} bits; allowed: at least {}, as "
                                      "of P-256 or RSA with 2048 bits",
                                      bits, kLeastSecurityBits)});
}

/// Null if the text is no certificate, which is a fault unless there is none.
CertificatePtr read_certificate(const char* file, const std::string& text, Faults& faults) {
  if (text.empty()) return nullptr;
  CertificatePtr certificate = parse_certificate(text);
  if (certificate == nullptr) {
    faults.push_back({file, "is no certificate (PEM): " + openssl_reason()});
  }
  return certificate;
}

void check_key(const char* file, const std::string& text, const char* certificate_file,
               const X509& certificate, Faults& faults) {
  if (text.empty()) return;
  const KeyPtr key = parse_private_key(text);
  if (key == nullptr) {
    faults.push_back({file, "is no private key (PEM, without a passphrase): " + openssl_reason()});
  } else if (X509_check_private_key(&certificate, key.get()) != 1) {
    static_cast<void>(openssl_reason());
    faults.push_back({file, "is not the key of " + std::string(certificate_file)});
  }
}

std::string listed(const std::set<std::string>& topics) {
  return fmt::format("{}", fmt::join(topics, ", "));
}

void check_topics(const char* doing, const std::set<std::string>& wanted,
                  const std::set<std::string>& granted, Faults& faults) {
  std::set<std::string> missing;
  std::set_difference(wanted.begin(), wanted.end(), granted.begin(), granted.end(),
                      std::inserter(missing, missing.end()));
  if (!missing.empty()) {
    faults.push_back(
        {kPermissionsFile, fmt::format("it may not {} {}; found: {}", doing, listed(missing),
                                       granted.empty() ? "nothing" : listed(granted))});
  }
  for (const std::string& topic : granted) {
    if (topic.find_first_of("*?[") == std::string::npos) continue;
    faults.push_back({kPermissionsFile, fmt::format("it may {} every topic like '{}'; allowed: "
                                                    "topics by their names",
                                                    doing, topic)});
  }
}

void check_grants(const std::string& document, const X509& certificate, const CredentialUse& use,
                  std::time_t now, Faults& faults) {
  const auto grants = read_permissions(document);
  if (!grants.ok()) {
    faults.push_back({kPermissionsFile, grants.error().message});
    return;
  }
  const std::string subject = subject_text(certificate);
  const auto grant = std::find_if(grants->begin(), grants->end(),
                                  [&](const Grant& one) { return one.subject == subject; });
  if (grant == grants->end()) {
    faults.push_back({kPermissionsFile,
                      fmt::format("is of '{}', and the certificate of '{}'",
                                  grants->empty() ? "nobody" : grants->front().subject, subject)});
    return;
  }
  check_time(kPermissionsFile, grant->validity, now, faults);
  check_topics("write", use.rights.writes, grant->rights.writes, faults);
  check_topics("read", use.rights.reads, grant->rights.reads, faults);
}

void check_half(const X509& certificate, SubjectHalf half, Faults& faults) {
  if (half_of(certificate) == half) return;
  faults.push_back(
      {kCertificateFile,
       fmt::format("the SHA-256 of its subject '{}' begins with a {}: between the "
                   "vendors, Cyclone DDS must begin a handshake; another name helps",
                   subject_text(certificate), half == SubjectHalf::kLower ? "1" : "0")});
}

bool vouches_for(const X509& authority, const X509& certificate) {
  EVP_PKEY* const key = X509_get0_pubkey(&authority);
  const bool good =
      key != nullptr && X509_verify(const_cast<X509*>(&certificate), key) == 1 &&
      X509_NAME_cmp(X509_get_issuer_name(&certificate), X509_get_subject_name(&authority)) == 0;
  static_cast<void>(openssl_reason());
  return good;
}

}  // namespace

Faults check_authority(const CertifiedKey& authority, const std::string& governance,
                       std::time_t now) {
  Faults faults;
  const auto certificate = read_certificate(kAuthorityFile, authority.certificate, faults);
  if (certificate == nullptr) return faults;
  check_time(kAuthorityFile, validity_of(*certificate), now, faults);
  check_strength(kAuthorityFile, *certificate, faults);
  if (X509_check_ca(certificate.get()) != 1) {
    faults.push_back({kAuthorityFile, "is not the certificate of an authority (CA:TRUE)"});
  }
  check_key(kAuthorityKeyFile, authority.private_key, kAuthorityFile, *certificate, faults);
  if (governance.empty()) return faults;
  const auto rules = verify_text(governance, *certificate);
  if (!rules.ok()) {
    faults.push_back({kGovernanceFile, rules.error().message});
  } else if (std::string weakness = governance_weakness(*rules); !weakness.empty()) {
    faults.push_back({kGovernanceFile, std::move(weakness)});
  }
  return faults;
}

Faults check_identity(const SecurityTexts& credentials, const CredentialUse& use, std::time_t now) {
  Faults faults;
  const auto certificate = read_certificate(kCertificateFile, credentials.certificate, faults);
  const CertificatePtr authority = parse_certificate(credentials.authority);
  if (certificate == nullptr || authority == nullptr) {
    static_cast<void>(openssl_reason());  // told by check_authority
    return faults;
  }
  check_time(kCertificateFile, validity_of(*certificate), now, faults);
  check_strength(kCertificateFile, *certificate, faults);
  if (!vouches_for(*authority, *certificate)) {
    faults.push_back({kCertificateFile,
                      "was issued by another authority; expected: " + subject_text(*authority)});
  }
  check_half(*certificate, use.half, faults);
  check_key(kPrivateKeyFile, credentials.private_key, kCertificateFile, *certificate, faults);
  if (credentials.permissions.empty()) return faults;
  const auto permissions = verify_text(credentials.permissions, *authority);
  if (!permissions.ok()) {
    faults.push_back({kPermissionsFile, permissions.error().message});
  } else {
    check_grants(*permissions, *certificate, use, now, faults);
  }
  return faults;
}

Result<SecurityTexts> mint_identity(const CertifiedKey& authority, const std::string& governance,
                                    const std::string& name, const CredentialUse& use,
                                    const Validity& validity) {
  const auto own = issue_certificate(authority, name, use.half, validity);
  if (!own.ok()) return own.error();
  const CertificatePtr certificate = parse_certificate(own->certificate);
  const auto permissions =
      sign_text(permissions_text({subject_text(*certificate), validity, use.rights}), authority);
  if (!permissions.ok()) return permissions.error();
  return SecurityTexts{authority.certificate, own->certificate, own->private_key, governance,
                       *permissions};
}

}  // namespace clew::bridge
