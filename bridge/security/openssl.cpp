// SPDX-License-Identifier: Apache-2.0
#include "security/openssl.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>

namespace clew::bridge {
namespace {

/// Instead of asking at the terminal.
int no_passphrase(char*, int, int, void*) { return -1; }

}  // namespace

BioPtr reading_bio(std::string_view text) {
  return BioPtr(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

BioPtr writing_bio() { return BioPtr(BIO_new(BIO_s_mem())); }

std::string written_text(BIO& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(&bio, &data);
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

CertificatePtr parse_certificate(std::string_view pem) {
  return CertificatePtr(PEM_read_bio_X509(reading_bio(pem).get(), nullptr, no_passphrase, nullptr));
}

KeyPtr parse_private_key(std::string_view pem) {
  return KeyPtr(PEM_read_bio_PrivateKey(reading_bio(pem).get(), nullptr, no_passphrase, nullptr));
}

std::string subject_text(const X509& certificate) {
  const BioPtr out = writing_bio();
  X509_NAME_print_ex(out.get(), X509_get_subject_name(&certificate), 0,
                     XN_FLAG_RFC2253 & ~static_cast<unsigned long>(ASN1_STRFLGS_ESC_MSB));
  return written_text(*out);
}

std::string openssl_reason() {
  const unsigned long code = ERR_get_error();
  ERR_clear_error();
  const char* const reason = ERR_reason_error_string(code);
  return reason != nullptr ? reason : "unknown reason";
}

}  // namespace clew::bridge
