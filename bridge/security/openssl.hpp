// SPDX-License-Identifier: Apache-2.0
/// OpenSSL's objects with owners, and its texts.
#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>

#include <memory>
#include <string>
#include <string_view>

namespace clew::bridge {

template <auto free_object>
struct OpensslDeleter {
  template <typename T>
  void operator()(T* object) const {
    free_object(object);
  }
};

using BioPtr = std::unique_ptr<BIO, OpensslDeleter<BIO_free_all>>;
using KeyPtr = std::unique_ptr<EVP_PKEY, OpensslDeleter<EVP_PKEY_free>>;
using CertificatePtr = std::unique_ptr<X509, OpensslDeleter<X509_free>>;
using Pkcs7Ptr = std::unique_ptr<PKCS7, OpensslDeleter<PKCS7_free>>;

/// To read `text`, which must outlive it.
BioPtr reading_bio(std::string_view text);
/// To write to memory, and what was written.
BioPtr writing_bio();
std::string written_text(BIO& bio);

/// Null if the text is none. A key with a passphrase is not read: nobody is there to be asked.
CertificatePtr parse_certificate(std::string_view pem);
KeyPtr parse_private_key(std::string_view pem);

/// The subject as RFC 2253 writes it, which is how permissions name it: `CN=sense-1`.
std::string subject_text(const X509& certificate);

/// Why the last call of OpenSSL failed; takes note of it, so that the next failure is told alone.
std::string openssl_reason();

}  // namespace clew::bridge
