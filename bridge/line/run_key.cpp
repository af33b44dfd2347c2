// SPDX-License-Identifier: Apache-2.0
#include "line/run_key.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/random.h>

#include <array>

#include "core/check.hpp"

namespace clew::bridge {
namespace {

constexpr std::size_t kSecretBytes = 32;
/// Of the code, so that USER_DATA stays short: 128 bits.
constexpr std::size_t kSealBytes = 16;
/// What the GUIDs of a participant and of its endpoints begin with, in hexadecimal digits.
constexpr std::size_t kPrefixDigits = 24;

}  // namespace

RunKey RunKey::make() {
  std::string secret(kSecretBytes, '\0');
  const auto got = ::getrandom(secret.data(), secret.size(), 0);
  CLEW_CHECK(got == static_cast<ssize_t>(secret.size()), "the system gives no random bytes");
  return RunKey(std::move(secret));
}

// HMAC-SHA256 (RFC 2104) of the participant, the stage and the IDL. No text of the three can run
// into the next: the first is of a fixed length, and the others have no ';'.
UserData RunKey::sealed(UserData data, std::string_view guid) const {
  if (secret_.empty()) return data;
  const std::string text =
      std::string(guid.substr(0, kPrefixDigits)) + ';' + data.stage + ';' + data.idl_fingerprint;
  std::array<unsigned char, EVP_MAX_MD_SIZE> code{};
  unsigned size = 0;
  const unsigned char* done =
      HMAC(EVP_sha256(), secret_.data(), static_cast<int>(secret_.size()),
           reinterpret_cast<const unsigned char*>(text.data()), text.size(), code.data(), &size);
  CLEW_CHECK(done != nullptr && size >= kSealBytes, "OpenSSL has no HMAC-SHA256");
  constexpr char kDigits[] = "0123456789abcdef";
  data.seal.clear();
  for (std::size_t i = 0; i < kSealBytes; ++i) {
    data.seal += kDigits[code[i] >> 4];
    data.seal += kDigits[code[i] & 15];
  }
  return data;
}

bool RunKey::fits(const UserData& data, std::string_view guid) const {
  const std::string expected = sealed({data.idl_fingerprint, data.stage}, guid).seal;
  return secret_.empty() ||
         (data.seal.size() == expected.size() &&
          CRYPTO_memcmp(data.seal.data(), expected.data(), expected.size()) == 0);
}

}  // namespace clew::bridge
