// SPDX-License-Identifier: Apache-2.0
#include "security/signature.hpp"

#include <openssl/evp.h>
#include <openssl/sha.h>

#include <array>
#include <fstream>
#include <system_error>
#include <vector>

#include "core/check.hpp"
#include "security/kept_file.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

constexpr char kFirstLine[] = "clew signature 1\n";
constexpr char kDigestName[] = "sha256: ";
constexpr char kCertificateBegin[] = "-----BEGIN CERTIFICATE-----\n";
constexpr char kSignatureBegin[] = "-----BEGIN SIGNATURE-----\n";
constexpr char kSignatureEnd[] = "-----END SIGNATURE-----\n";

using DigestPtr = std::unique_ptr<EVP_MD_CTX, OpensslDeleter<EVP_MD_CTX_free>>;

std::string hex(const unsigned char* bytes, std::size_t size) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

/// Of a file of any size.
Result<std::string> digest_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const DigestPtr digest(EVP_MD_CTX_new());
  CLEW_CHECK(digest != nullptr && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1,
             openssl_reason());
  std::vector<char> block(1 << 20);
  while (stream.good()) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto got = static_cast<std::size_t>(stream.gcount());
    CLEW_CHECK(EVP_DigestUpdate(digest.get(), block.data(), got) == 1, openssl_reason());
  }
  if (!stream.eof()) {
    return Error{"cannot be read: " + std::generic_category().message(errno), path};
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> bytes{};
  CLEW_CHECK(EVP_DigestFinal_ex(digest.get(), bytes.data(), nullptr) == 1, openssl_reason());
  return hex(bytes.data(), bytes.size());
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

Result<std::string> sign(const std::string& text, EVP_PKEY& key) {
  const DigestPtr context(EVP_MD_CTX_new());
  std::size_t size = 0;
  std::string signature;
  if (EVP_DigestSignInit(context.get(), nullptr, digest_for(key), nullptr, &key) != 1 ||
      EVP_DigestSign(context.get(), nullptr, &size, bytes_of(text), text.size()) != 1) {
    return Error{openssl_reason(), {}};
  }
  signature.resize(size);
  if (EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &size,
                     bytes_of(text), text.size()) != 1) {
    return Error{openssl_reason(), {}};
  }
  signature.resize(size);
  return signature;
}

bool fits(const std::string& text, const std::string& signature, EVP_PKEY& key) {
  const DigestPtr context(EVP_MD_CTX_new());
  const bool good =
      EVP_DigestVerifyInit(context.get(), nullptr, digest_for(key), nullptr, &key) == 1 &&
      EVP_DigestVerify(context.get(), bytes_of(signature), signature.size(), bytes_of(text),
                       text.size()) == 1;
  static_cast<void>(openssl_reason());
  return good;
}

/// In lines of 64 letters, as PEM has it.
std::string to_base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes_of(bytes),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  constexpr std::size_t kLine = 64;
  std::string lines;
  for (std::size_t at = 0; at < text.size(); at += kLine) lines += text.substr(at, kLine) + '\n';
  return lines;
}

std::string from_base64(const std::string& lines) {
  std::vector<unsigned char> bytes(lines.size() + 1);
  int size = 0;
  int rest = 0;
  std::unique_ptr<EVP_ENCODE_CTX, OpensslDeleter<EVP_ENCODE_CTX_free>> context(
      EVP_ENCODE_CTX_new());
  EVP_DecodeInit(context.get());
  if (EVP_DecodeUpdate(context.get(), bytes.data(), &size, bytes_of(lines),
                       static_cast<int>(lines.size())) < 0 ||
      EVP_DecodeFinal(context.get(), bytes.data() + size, &rest) != 1) {
    return {};
  }
  return {bytes.begin(), bytes.begin() + size + rest};
}

std::string fingerprint_of(const X509& certificate) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> bytes{};
  unsigned char* der = nullptr;
  const int size = i2d_PUBKEY(X509_get0_pubkey(&certificate), &der);
  if (size <= 0) return {};
  SHA256(der, static_cast<std::size_t>(size), bytes.data());
  OPENSSL_free(der);
  return "SHA256:" + hex(bytes.data(), bytes.size());
}

/// A file's parts.
struct Parts {
  std::string signed_text;  ///< all before the signature
  std::string digest;
  std::string certificate;
  std::string signature;
};

std::optional<Parts> take_apart(const std::string& text) {
  const std::string head = std::string(kFirstLine) + kDigestName;
  const auto certificate = text.find(kCertificateBegin);
  const auto signature = text.find(kSignatureBegin);
  const auto end = text.find(kSignatureEnd);
  const bool whole = text.compare(0, head.size(), head) == 0 && certificate != std::string::npos &&
                     signature != std::string::npos && end != std::string::npos &&
                     certificate < signature && signature < end &&
                     end + sizeof kSignatureEnd - 1 == text.size();
  if (!whole || certificate != head.size() + 2 * SHA256_DIGEST_LENGTH + 1) return std::nullopt;
  const auto begin = signature + sizeof kSignatureBegin - 1;
  const std::string lines = text.substr(begin, end - begin);
  Parts parts{text.substr(0, signature), text.substr(head.size(), 2 * SHA256_DIGEST_LENGTH),
              text.substr(certificate, signature - certificate), from_base64(lines)};
  // Base64 has several texts for the same bytes; one of them is ours.
  if (to_base64(parts.signature) != lines) return std::nullopt;
  return parts;
}

}  // namespace

std::string signature_file(const std::string& file) { return file + ".sig"; }

Result<void> sign_file(const std::string& file, const CertifiedKey& signer) {
  const auto digest = digest_of(file);
  if (!digest.ok()) return digest.error();
  const KeyPtr key = parse_private_key(signer.private_key);
  if (key == nullptr) return Error{"is no private key (PEM): " + openssl_reason(), {}};
  const std::string text = kFirstLine + (kDigestName + *digest) + '\n' + signer.certificate;
  const auto signature = sign(text, *key);
  if (!signature.ok()) return signature.error();
  return write_kept_file(signature_file(file),
                         text + kSignatureBegin + to_base64(*signature) + kSignatureEnd,
                         Secrecy::kPublic);
}

Result<std::optional<Signature>> read_signature(const std::string& file) {
  const std::string path = signature_file(file);
  if (!std::ifstream(path).good()) return std::optional<Signature>();
  std::vector<CredentialFault> faults;  // who may write the file does not matter
  const std::string text = read_kept_file(path, Secrecy::kPublic, faults);
  if (text.empty()) return Error{faults.front().text, path};
  const auto parts = take_apart(text);
  const auto certificate = parts ? parse_certificate(parts->certificate) : nullptr;
  if (certificate == nullptr) {
    static_cast<void>(openssl_reason());
    return Error{"is no signature of clew sign", path};
  }
  const auto digest = digest_of(file);
  if (!digest.ok()) return digest.error();
  Signature found{subject_text(*certificate), fingerprint_of(*certificate), {}, parts->certificate};
  EVP_PKEY* const key = X509_get0_pubkey(certificate.get());
  if (key == nullptr || !fits(parts->signed_text, parts->signature, *key)) {
    found.fault = "the signature itself was changed, or is of another key";
  } else if (*digest != parts->digest) {
    found.fault = "the file was changed after it was signed";
  }
  return std::optional(std::move(found));
}

Result<std::string> objection_to_signer(const Signature& signature,
                                        const std::string& certificate) {
  const CertificatePtr expected = parse_certificate(certificate);
  if (expected == nullptr) return Error{"is no certificate (PEM): " + openssl_reason(), {}};
  const CertificatePtr signer = parse_certificate(signature.certificate);
  CLEW_CHECK(signer != nullptr, "read_signature() has parsed it");
  if (fingerprint_of(*expected) == fingerprint_of(*signer)) return std::string();
  EVP_PKEY* const key = X509_get0_pubkey(expected.get());
  const bool vouched =
      X509_check_ca(expected.get()) == 1 && key != nullptr && X509_verify(signer.get(), key) == 1;
  static_cast<void>(openssl_reason());
  if (vouched) return std::string();
  return "it was signed by '" + signature.signer + "', not by '" + subject_text(*expected) +
         "' or somebody that this one vouches for";
}

}  // namespace clew::bridge
