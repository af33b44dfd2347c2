// SPDX-License-Identifier: Apache-2.0
#include "security/signature.hpp"

#include <gtest/gtest.h>

#include "temporary_keys.hpp"

namespace clew::bridge {
namespace {

const Validity kYears = days_around_now(1, 3650);

/// A file in a directory that is gone with the fixture.
class Signed : public testing::Test {
 protected:
  Signed() { directory_.write("r.mcap", "recording"); }

  std::string file() const { return directory_.path("r.mcap"); }
  Signature signature() const {
    const auto found = read_signature(file());
    EXPECT_TRUE(found.ok()) << found.error().text();
    EXPECT_TRUE(found->has_value());
    return found->value_or(Signature{});
  }

  const TemporaryKeys directory_;
  const CertifiedKey anna_ = make_signing_key("anna@lab", kYears);
};

TEST_F(Signed, FileTellsWhoSignedIt) {
  ASSERT_TRUE(sign_file(file(), anna_).ok());

  const Signature found = signature();

  EXPECT_EQ(found.fault, "");
  EXPECT_EQ(found.signer, "CN=anna@lab");
  EXPECT_EQ(found.key.substr(0, 7), "SHA256:");
  EXPECT_EQ(found.key.size(), 7u + 64u);
  EXPECT_EQ(directory_.read("r.mcap"), "recording") << "its bytes stay";
}

TEST_F(Signed, FileMayBeSignedByAnAuthority) {
  ASSERT_TRUE(sign_file(file(), directory_.authority()).ok());

  EXPECT_EQ(signature().fault, "");
  EXPECT_EQ(signature().signer, "CN=clew-test");
}

TEST_F(Signed, FileOfNobodyHasNoSignature) {
  const auto found = read_signature(file());

  ASSERT_TRUE(found.ok());
  EXPECT_FALSE(found->has_value());
}

TEST_F(Signed, FileThatWasChangedSaysSo) {
  ASSERT_TRUE(sign_file(file(), anna_).ok());

  directory_.write("r.mcap", "Recording");

  EXPECT_EQ(signature().fault, "the file was changed after it was signed");
}

TEST_F(Signed, EveryByteOfASignatureCounts) {
  ASSERT_TRUE(sign_file(file(), anna_).ok());
  const std::string good = directory_.read("r.mcap.sig");
  const std::string expected = signature().key;

  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = bad[i] == 'A' ? 'B' : 'A';
    directory_.write("r.mcap.sig", bad);

    const auto found = read_signature(file());

    const bool noticed = !found.ok() || !(*found)->fault.empty();
    EXPECT_TRUE(noticed) << "byte " << i << ", '" << good[i] << "'";
  }
}

TEST_F(Signed, FileWithHalfASignatureIsToldFromOneWithout) {
  ASSERT_TRUE(sign_file(file(), anna_).ok());
  const std::string good = directory_.read("r.mcap.sig");

  directory_.write("r.mcap.sig", good.substr(0, good.size() / 2));

  const auto found = read_signature(file());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().text(), file() + ".sig: is no signature of clew sign");
}

TEST_F(Signed, FileMovesWithItsSignature) {
  ASSERT_TRUE(sign_file(file(), anna_).ok());
  std::filesystem::rename(file(), directory_.path("other.mcap"));
  std::filesystem::rename(file() + ".sig", directory_.path("other.mcap.sig"));

  const auto found = read_signature(directory_.path("other.mcap"));

  ASSERT_TRUE(found.ok());
  EXPECT_EQ((*found)->fault, "");
}

TEST_F(Signed, FileIsOfWhomTheUserTrustsOrOfNobody) {
  const CertifiedKey namesake = make_signing_key("anna@lab", kYears);
  const auto issued =
      issue_certificate(directory_.authority(), "robot", SubjectHalf::kLower, kYears);
  ASSERT_TRUE(issued.ok());
  ASSERT_TRUE(sign_file(file(), anna_).ok());
  const Signature of_anna = signature();
  ASSERT_TRUE(sign_file(file(), *issued).ok());
  const Signature of_robot = signature();

  EXPECT_EQ(*objection_to_signer(of_anna, anna_.certificate), "");
  EXPECT_NE(*objection_to_signer(of_anna, namesake.certificate), "");
  EXPECT_EQ(*objection_to_signer(of_robot, directory_.authority().certificate), "");
  EXPECT_NE(*objection_to_signer(of_anna, directory_.authority().certificate), "");
  EXPECT_NE(*objection_to_signer(of_robot, anna_.certificate), "");
  EXPECT_EQ(objection_to_signer(of_anna, "garbage").error().message.substr(0, 24),
            "is no certificate (PEM):");
}

TEST(CertifiedKeys, AreReadFromOneTextAndBelongTogether) {
  const CertifiedKey one = make_signing_key("one", kYears);
  const CertifiedKey other = make_signing_key("other", kYears);

  EXPECT_EQ(read_certified_key(one.private_key + one.certificate)->certificate, one.certificate);
  EXPECT_EQ(read_certified_key(one.private_key + other.certificate).error().message,
            "its key is not that of its certificate");
  EXPECT_FALSE(read_certified_key(one.certificate).ok());
  EXPECT_FALSE(read_certified_key(one.private_key).ok());
}

}  // namespace
}  // namespace clew::bridge
