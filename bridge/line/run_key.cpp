// SPDX-License-Identifier: Apache-2.0
#include "line/run_key.hpp"

#include <nettle/hmac.h>
#include <nettle/memops.h>
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

const std::uint8_t* bytes_of(const std::string& text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

}  // namespace

RunKey RunKey::make() {
  std::string secret(kSecretBytes, '\0');
  const auto got = ::getrandom(secret.data(), secret.size(), 0);
  CLEW_CHECK(got == static_cast<ssize_t>(secret.size()), "the system gives no random bytes");
  return RunKey(std::move(secret));
}

// HMAC-SHA256 (RFC 2104) of the participant, the stage and the IDL. No text of the three can run
// into the next: the first is of a fixed length, and the others have no ';'. Nettle's: OpenSSL's
// first code takes 2 MiB of each component process.
UserData RunKey::sealed(UserData data, std::string_view guid) const {
  if (secret_.empty()) return data;
  const std::string text =
      std::string(guid.substr(0, kPrefixDigits)) + ';' + data.stage + ';' + data.idl_fingerprint;
  hmac_sha256_ctx context;
  hmac_sha256_set_key(&context, secret_.size(), bytes_of(secret_));
  hmac_sha256_update(&context, text.size(), bytes_of(text));
  std::array<std::uint8_t, kSealBytes> code{};
  hmac_sha256_digest(&context, code.size(), code.data());
  constexpr char kDigits[] = "0123456789abcdef";
  data.seal.clear();
  for (const std::uint8_t byte : code) {
    data.seal += kDigits[byte >> 4];
    data.seal += kDigits[byte & 15];
  }
  return data;
}

bool RunKey::fits(const UserData& data, std::string_view guid) const {
  const std::string expected = sealed({data.idl_fingerprint, data.stage}, guid).seal;
  return secret_.empty() || (data.seal.size() == expected.size() &&
                             memeql_sec(data.seal.data(), expected.data(), expected.size()) != 0);
}

}  // namespace clew::bridge
