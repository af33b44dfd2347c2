// SPDX-License-Identifier: Apache-2.0
#include "hosts/host_identity.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/x509_vfy.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "security/kept_file.hpp"
#include "security/key_directory.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

std::string date(const ASN1_TIME* time) {
  std::tm parts{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return "an unknown date";
  return fmt::format("{:%Y-%m-%d}", parts);
}

/// Why OpenSSL does not believe it; empty if it does.
std::string verify(X509& certificate, X509& authority, std::time_t now) {
  X509_STORE* const store = X509_STORE_new();
  X509_STORE_CTX* const context = X509_STORE_CTX_new();
  std::string fault = "cannot be checked";
  if (store != nullptr && context != nullptr && X509_STORE_add_cert(store, &authority) == 1 &&
      X509_STORE_CTX_init(context, store, &certificate, nullptr) == 1) {
    X509_VERIFY_PARAM_set_time(X509_STORE_CTX_get0_param(context), now);
    const bool good = X509_verify_cert(context) == 1;
    fault = good ? "" : X509_verify_cert_error_string(X509_STORE_CTX_get_error(context));
  }
  X509_STORE_CTX_free(context);
  X509_STORE_free(store);
  static_cast<void>(openssl_reason());
  return fault;
}

std::string fault_with_key(const HostIdentity& identity) {
  const CertificatePtr certificate = parse_certificate(identity.own.certificate);
  const KeyPtr key = parse_private_key(identity.own.private_key);
  if (key == nullptr) return "is no private key (PEM, without a passphrase)";
  const bool fits = X509_check_private_key(certificate.get(), key.get()) == 1;
  static_cast<void>(openssl_reason());
  return fits ? "" : "is not the key of the certificate beside it";
}

}  // namespace

std::string fault_of(X509& certificate, X509& authority, HostRole role, const std::string& expected,
                     std::time_t now) {
  std::time_t when = now;
  if (X509_cmp_time(X509_get0_notAfter(&certificate), &when) < 0) {
    return "expired on " + date(X509_get0_notAfter(&certificate));
  }
  if (X509_cmp_time(X509_get0_notBefore(&certificate), &when) > 0) {
    return "is valid only from " + date(X509_get0_notBefore(&certificate)) + " on";
  }
  if (const std::string why = verify(certificate, authority, now); !why.empty()) {
    return "is not vouched for by the authority " + subject_text(authority) + " (" + why + ")";
  }
  const auto name = host_name_in(certificate, role);
  if (!name) {
    return "is that of " + subject_text(certificate) + "; expected one of the kind '" +
           std::string(role_name(role)) + "', as 'clew keys host' makes it";
  }
  if (!expected.empty() && *name != expected) {
    return "is that of " + std::string(role_name(role)) + " '" + *name + "'; expected '" +
           expected + "'";
  }
  return {};
}

Result<HostIdentity> HostIdentity::read(const std::string& directory, HostRole role,
                                        std::time_t now) {
  std::vector<CredentialFault> faults;
  check_kept_directory(directory, faults);
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  const auto path = [&](const char* file) { return directory + '/' + file; };
  HostIdentity identity;
  identity.authority = read_kept_file(path(kAuthorityFile), Secrecy::kPublic, faults);
  identity.own.certificate = read_kept_file(path(kCertificateFile), Secrecy::kPublic, faults);
  identity.own.private_key = read_kept_file(path(kPrivateKeyFile), Secrecy::kSecret, faults);
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  const CertificatePtr authority = parse_certificate(identity.authority);
  if (authority == nullptr) return Error{"is no certificate (PEM)", path(kAuthorityFile)};
  const CertificatePtr certificate = parse_certificate(identity.own.certificate);
  if (certificate == nullptr) return Error{"is no certificate (PEM)", path(kCertificateFile)};
  const std::string fault = fault_of(*certificate, *authority, role, {}, now);
  if (!fault.empty()) return Error{fault, path(kCertificateFile)};
  const std::string of_key = fault_with_key(identity);
  if (!of_key.empty()) return Error{of_key, path(kPrivateKeyFile)};
  identity.name = *host_name_in(*certificate, role);
  return identity;
}

std::string host_identity_directory(const std::string& keys, const std::string& name,
                                    HostRole role) {
  return keys + '/' + name + '.' + std::string(role_name(role));
}

Result<void> mint_host_identity(const std::string& keys, const std::string& name, HostRole role,
                                const Validity& validity) {
  std::vector<CredentialFault> faults;
  const auto shared = KeyDirectory(keys).read_shared(validity.not_before, faults);
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  const std::string authority_key = keys + '/' + kAuthorityKeyFile;
  if (shared.authority.private_key.empty()) {
    return Error{"is not there; without it nothing can be signed", authority_key};
  }
  const auto issued = issue_host_certificate(shared.authority, role, name, validity);
  if (!issued.ok()) return Error{issued.error().message, authority_key};
  const std::string folder = host_identity_directory(keys, name, role);
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    return Error{std::string("cannot be made: ") + std::strerror(errno), folder};
  }
  const auto path = [&](const char* file) { return folder + '/' + file; };
  CLEW_RETURN_IF_ERROR(
      write_kept_file(path(kPrivateKeyFile), issued->private_key, Secrecy::kSecret));
  CLEW_RETURN_IF_ERROR(
      write_kept_file(path(kCertificateFile), issued->certificate, Secrecy::kPublic));
  return write_kept_file(path(kAuthorityFile), shared.authority.certificate, Secrecy::kPublic);
}

}  // namespace clew::bridge
