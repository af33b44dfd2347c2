// SPDX-License-Identifier: Apache-2.0
#include "security/certificate.hpp"

#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/sha.h>
#include <openssl/x509v3.h>

#include <array>

#include "core/check.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

const std::string kHostUri = "clew:";
constexpr char kCurve[] = "P-256";
/// Of a serial number: RFC 5280 allows 20, and asks for a positive number.
constexpr std::size_t kSerialBytes = 16;
constexpr long kVersion3 = 2;

KeyPtr make_key() {
  KeyPtr key(EVP_EC_gen(kCurve));
  CLEW_CHECK(key != nullptr, openssl_reason());
  return key;
}

std::string to_pem(X509& certificate) {
  const BioPtr out = writing_bio();
  CLEW_CHECK(PEM_write_bio_X509(out.get(), &certificate) == 1, openssl_reason());
  return written_text(*out);
}

std::string to_pem(EVP_PKEY& key) {
  const BioPtr out = writing_bio();
  CLEW_CHECK(PEM_write_bio_PrivateKey(out.get(), &key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
             openssl_reason());
  return written_text(*out);
}

void set_serial(X509& certificate) {
  std::array<unsigned char, kSerialBytes> bytes{};
  CLEW_CHECK(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1, openssl_reason());
  BIGNUM* const number = BN_bin2bn(bytes.data(), static_cast<int>(bytes.size()), nullptr);
  CLEW_CHECK(number != nullptr &&
                 BN_to_ASN1_INTEGER(number, X509_get_serialNumber(&certificate)) != nullptr,
             openssl_reason());
  BN_free(number);
}

void set_subject(X509& certificate, const std::string& common_name) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(common_name.data());
  X509_NAME* const subject = X509_NAME_new();
  CLEW_CHECK(X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, bytes,
                                        static_cast<int>(common_name.size()), -1, 0) == 1 &&
                 X509_set_subject_name(&certificate, subject) == 1,
             openssl_reason());
  X509_NAME_free(subject);
}

void add_extension(X509& certificate, int kind, const char* value) {
  X509_EXTENSION* const extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value);
  CLEW_CHECK(extension != nullptr && X509_add_ext(&certificate, extension, -1) == 1,
             openssl_reason());
  X509_EXTENSION_free(extension);
}

/// With everything but its subject and who vouches for it.
CertificatePtr begin_certificate(EVP_PKEY& key, const Validity& validity) {
  CertificatePtr certificate(X509_new());
  CLEW_CHECK(certificate != nullptr, openssl_reason());
  X509_set_version(certificate.get(), kVersion3);
  set_serial(*certificate);
  CLEW_CHECK(
      ASN1_TIME_set(X509_getm_notBefore(certificate.get()), validity.not_before) != nullptr &&
          ASN1_TIME_set(X509_getm_notAfter(certificate.get()), validity.not_after) != nullptr &&
          X509_set_pubkey(certificate.get(), &key) == 1,
      openssl_reason());
  return certificate;
}

void finish_certificate(X509& certificate, const X509& issuer, EVP_PKEY& issuer_key) {
  CLEW_CHECK(X509_set_issuer_name(&certificate, X509_get_subject_name(&issuer)) == 1 &&
                 X509_sign(&certificate, &issuer_key, digest_for(issuer_key)) > 0,
             openssl_reason());
}

}  // namespace

SubjectHalf half_of(const X509& certificate) {
  unsigned char* der = nullptr;
  const int size = i2d_X509_NAME(X509_get_subject_name(&certificate), &der);
  CLEW_CHECK(size > 0, openssl_reason());
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(der, static_cast<std::size_t>(size), digest.data());
  OPENSSL_free(der);
  return (digest.front() & 0x80) == 0 ? SubjectHalf::kLower : SubjectHalf::kUpper;
}

// The authority signs governance and permissions itself, which is what its digitalSignature is for.
CertifiedKey make_authority(const std::string& name, const Validity& validity) {
  const KeyPtr key = make_key();
  const CertificatePtr certificate = begin_certificate(*key, validity);
  set_subject(*certificate, name);
  add_extension(*certificate, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  add_extension(*certificate, NID_key_usage, "critical,digitalSignature,keyCertSign,cRLSign");
  finish_certificate(*certificate, *certificate, *key);
  return {to_pem(*certificate), to_pem(*key)};
}

CertifiedKey make_signing_key(const std::string& name, const Validity& validity) {
  const KeyPtr key(EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"));
  CLEW_CHECK(key != nullptr, openssl_reason());
  const CertificatePtr certificate = begin_certificate(*key, validity);
  set_subject(*certificate, name);
  add_extension(*certificate, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(*certificate, NID_key_usage, "critical,digitalSignature");
  finish_certificate(*certificate, *certificate, *key);
  return {to_pem(*certificate), to_pem(*key)};
}

Result<CertifiedKey> read_certified_key(const std::string& pem) {
  const CertificatePtr certificate = parse_certificate(pem);
  if (certificate == nullptr) return Error{"holds no certificate (PEM): " + openssl_reason(), {}};
  const KeyPtr key = parse_private_key(pem);
  if (key == nullptr) {
    return Error{"holds no private key (PEM, without a passphrase): " + openssl_reason(), {}};
  }
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    static_cast<void>(openssl_reason());
    return Error{"its key is not that of its certificate", {}};
  }
  return CertifiedKey{to_pem(*certificate), to_pem(*key)};
}

const EVP_MD* digest_for(const EVP_PKEY& key) {
  return EVP_PKEY_get_base_id(&key) == EVP_PKEY_ED25519 ? nullptr : EVP_sha256();
}

Result<CertifiedKey> issue_certificate(const CertifiedKey& authority, const std::string& name,
                                       SubjectHalf half, const Validity& validity) {
  const CertificatePtr issuer = parse_certificate(authority.certificate);
  const KeyPtr issuer_key = parse_private_key(authority.private_key);
  if (issuer == nullptr || issuer_key == nullptr) return Error{openssl_reason(), {}};
  const KeyPtr key = make_key();
  const CertificatePtr certificate = begin_certificate(*key, validity);
  int number = 0;
  do {
    set_subject(*certificate, name + '-' + std::to_string(++number));
  } while (half_of(*certificate) != half);
  add_extension(*certificate, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(*certificate, NID_key_usage, "critical,digitalSignature,keyAgreement");
  // Not for S/MIME: Cyclone DDS would believe permissions that a participant signs for itself.
  add_extension(*certificate, NID_ext_key_usage, "clientAuth,serverAuth");
  finish_certificate(*certificate, *issuer, *issuer_key);
  return CertifiedKey{to_pem(*certificate), to_pem(*key)};
}

std::string_view role_name(HostRole role) { return role == HostRole::kHost ? "host" : "run"; }

Result<CertifiedKey> issue_host_certificate(const CertifiedKey& authority, HostRole role,
                                            const std::string& name, const Validity& validity) {
  const CertificatePtr issuer = parse_certificate(authority.certificate);
  const KeyPtr issuer_key = parse_private_key(authority.private_key);
  if (issuer == nullptr || issuer_key == nullptr) return Error{openssl_reason(), {}};
  const KeyPtr key = make_key();
  const CertificatePtr certificate = begin_certificate(*key, validity);
  const std::string who = std::string(role_name(role)) + ':' + name;
  set_subject(*certificate, who);
  add_extension(*certificate, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(*certificate, NID_key_usage, "critical,digitalSignature");
  add_extension(*certificate, NID_ext_key_usage,
                role == HostRole::kHost ? "serverAuth" : "clientAuth");
  add_extension(*certificate, NID_subject_alt_name, (kHostUri + who).insert(0, "URI:").c_str());
  finish_certificate(*certificate, *issuer, *issuer_key);
  return CertifiedKey{to_pem(*certificate), to_pem(*key)};
}

std::optional<std::string> host_name_in(X509& certificate, HostRole role) {
  auto* const names = static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr));
  const std::string beginning = kHostUri + std::string(role_name(role)) + ':';
  std::optional<std::string> found;
  for (int i = 0; i < sk_GENERAL_NAME_num(names); ++i) {
    const GENERAL_NAME* const one = sk_GENERAL_NAME_value(names, i);
    if (one->type != GEN_URI) continue;
    const auto* const bytes = ASN1_STRING_get0_data(one->d.uniformResourceIdentifier);
    const std::string uri(
        reinterpret_cast<const char*>(bytes),
        static_cast<std::size_t>(ASN1_STRING_length(one->d.uniformResourceIdentifier)));
    if (uri.rfind(beginning, 0) == 0) found = uri.substr(beginning.size());
  }
  GENERAL_NAMES_free(names);
  static_cast<void>(openssl_reason());
  return found;
}

Result<std::string> sign_text(const std::string& text, const CertifiedKey& authority) {
  const CertificatePtr certificate = parse_certificate(authority.certificate);
  const KeyPtr key = parse_private_key(authority.private_key);
  if (certificate == nullptr || key == nullptr) return Error{openssl_reason(), {}};
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED;
  const BioPtr in = reading_bio(text);
  const Pkcs7Ptr signature(PKCS7_sign(certificate.get(), key.get(), nullptr, in.get(), kFlags));
  if (signature == nullptr) return Error{openssl_reason(), {}};
  const BioPtr out = writing_bio();
  const BioPtr again = reading_bio(text);
  if (SMIME_write_PKCS7(out.get(), signature.get(), again.get(), kFlags) != 1) {
    return Error{openssl_reason(), {}};
  }
  return written_text(*out);
}

Result<std::string> verify_text(const std::string& signed_text, X509& authority) {
  const BioPtr in = reading_bio(signed_text);
  BIO* content = nullptr;
  const Pkcs7Ptr signature(SMIME_read_PKCS7(in.get(), &content));
  const BioPtr owned(content);
  if (signature == nullptr || content == nullptr) {
    static_cast<void>(openssl_reason());
    return Error{"is not a signed text (S/MIME)", {}};
  }
  STACK_OF(X509)* const signers = sk_X509_new_null();
  sk_X509_push(signers, &authority);
  const BioPtr out = writing_bio();
  // Signed with this key and no other: the certificates inside the signature prove nothing.
  const int good = PKCS7_verify(signature.get(), signers, nullptr, content, out.get(),
                                PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN);
  sk_X509_free(signers);
  if (good != 1) {
    const std::string reason = openssl_reason();
    return Error{reason == "signer certificate not found"
                     ? "was signed by somebody else"
                     : "was changed after it was signed (" + reason + ")",
                 {}};
  }
  return written_text(*out);
}

}  // namespace clew::bridge
