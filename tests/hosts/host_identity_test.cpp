// SPDX-License-Identifier: Apache-2.0
#include "hosts/host_identity.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <ostream>

#include "temporary_keys.hpp"

namespace clew::bridge {
namespace {

const std::string kFolder = "robot.host";

std::string refusal_of(const TemporaryKeys& keys, HostRole role = HostRole::kHost) {
  const auto read = HostIdentity::read(keys.path(kFolder), role, std::time(nullptr));
  if (read.ok()) return "none";
  const std::string text = read.error().text();
  return text.rfind(keys.path(), 0) == 0 ? text.substr(keys.path().size() + 1) : text;
}

void mint(const TemporaryKeys& keys, const Validity& validity = days_around_now(1, 10),
          HostRole role = HostRole::kHost) {
  const auto minted = mint_host_identity(keys.path(), "robot", role, validity);
  ASSERT_TRUE(minted.ok()) << minted.error().text();
}

TEST(HostIdentity, IsAFolderThatCanBeCarriedAway) {
  const TemporaryKeys keys;
  mint(keys);
  const std::string elsewhere = keys.path() + "-robot";
  std::filesystem::rename(keys.path(kFolder), elsewhere);

  const auto read = HostIdentity::read(elsewhere, HostRole::kHost, std::time(nullptr));

  std::filesystem::remove_all(elsewhere);
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read->name, "robot");
}

struct Bad {
  std::string name;
  std::function<void(const TemporaryKeys&)> spoil;
  std::string fault;  ///< in part
};
std::ostream& operator<<(std::ostream& out, const Bad& bad) { return out << bad.name; }

class BadHostIdentity : public testing::TestWithParam<Bad> {};

TEST_P(BadHostIdentity, IsRefusedWithItsFile) {
  const TemporaryKeys keys;
  mint(keys);
  ASSERT_EQ(refusal_of(keys), "none");

  GetParam().spoil(keys);

  EXPECT_NE(refusal_of(keys).find(GetParam().fault), std::string::npos) << refusal_of(keys);
}

void copy(const TemporaryKeys& from, const std::string& file, const TemporaryKeys& to,
          const std::string& as) {
  to.write(as, from.read(file));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadHostIdentity,
    testing::Values(
        Bad{"no folder", [](const auto& keys) { std::filesystem::remove_all(keys.path(kFolder)); },
            "robot.host: is no directory of keys: No such file"},
        Bad{"a key that others may read",
            [](const auto& keys) { keys.set_mode(kFolder + "/private.key", 0644); },
            "robot.host/private.key: may be read by others: its mode is 0644; allowed: 0600"},
        Bad{"a folder that others may change",
            [](const auto& keys) { keys.set_mode(kFolder, 0777); },
            "robot.host: may be changed by others"},
        Bad{"expired", [](const auto& keys) { mint(keys, days_around_now(5, -1)); },
            "robot.host/certificate.pem: expired on 2"},
        Bad{"not yet valid", [](const auto& keys) { mint(keys, days_around_now(-1, 5)); },
            "robot.host/certificate.pem: is valid only from 2"},
        Bad{"of another authority",
            [](const auto& keys) {
              const TemporaryKeys others;
              mint(others);
              copy(others, kFolder + "/certificate.pem", keys, kFolder + "/certificate.pem");
              copy(others, kFolder + "/private.key", keys, kFolder + "/private.key");
            },
            "robot.host/certificate.pem: is not vouched for by the authority CN=clew-test"},
        Bad{"another key",
            [](const auto& keys) {
              const TemporaryKeys others;
              mint(others);
              copy(others, kFolder + "/private.key", keys, kFolder + "/private.key");
            },
            "robot.host/private.key: is not the key of the certificate beside it"},
        Bad{"that of a component",
            [](const auto& keys) {
              copy(keys, "sense.cyclonedds/certificate.pem", keys, kFolder + "/certificate.pem");
              copy(keys, "sense.cyclonedds/private.key", keys, kFolder + "/private.key");
            },
            "robot.host/certificate.pem: is that of CN=sense-"},
        Bad{"no certificate",
            [](const auto& keys) { keys.write(kFolder + "/certificate.pem", "nothing\n"); },
            "robot.host/certificate.pem: is no certificate (PEM)"}));

TEST(HostIdentity, SaysNoOtherRole) {
  const TemporaryKeys keys;
  mint(keys);

  EXPECT_NE(refusal_of(keys, HostRole::kRunner)
                .find("is that of CN=host:robot; expected one of the kind 'run'"),
            std::string::npos)
      << refusal_of(keys, HostRole::kRunner);
}

TEST(HostIdentity, NeedsTheAuthoritysKey) {
  const TemporaryKeys keys;
  std::filesystem::remove(keys.path(kAuthorityKeyFile));

  const auto minted =
      mint_host_identity(keys.path(), "robot", HostRole::kHost, days_around_now(1, 10));

  ASSERT_FALSE(minted.ok());
  EXPECT_EQ(minted.error().text(),
            keys.path(kAuthorityKeyFile) + ": is not there; without it nothing can be signed");
}

}  // namespace
}  // namespace clew::bridge
