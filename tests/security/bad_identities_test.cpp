// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openssl/pem.h>
#include <unistd.h>

#include <functional>
#include <ostream>
#include <utility>

#include "security/run_security.hpp"
#include "temporary_keys.hpp"

namespace clew::bridge {
namespace {

const std::string kCertificate = "sense.cyclonedds/certificate.pem";
const std::string kKey = "sense.cyclonedds/private.key";
const std::string kPermissions = "sense.cyclonedds/permissions.p7s";

struct BadIdentity {
  std::string name;
  std::function<void(const TemporaryKeys&)> spoil;
  std::string file;   ///< that the fault names, within the directory
  std::string fault;  ///< that it tells, in part
};

std::ostream& operator<<(std::ostream& out, const BadIdentity& bad) { return out << bad.name; }

std::function<void(const TemporaryKeys&)> without(const std::string& file) {
  return [file](const TemporaryKeys& keys) { std::filesystem::remove_all(keys.path(file)); };
}

std::function<void(const TemporaryKeys&)> with_text(const std::string& file,
                                                    const std::string& text) {
  return [=](const TemporaryKeys& keys) { keys.write(file, text); };
}

std::function<void(const TemporaryKeys&)> with_mode(const std::string& file, mode_t mode) {
  return [=](const TemporaryKeys& keys) { keys.set_mode(file, mode); };
}

/// The signature stays, and so does the length.
std::function<void(const TemporaryKeys&)> changed_inside(const std::string& file,
                                                         const std::string& from,
                                                         const std::string& to) {
  return [=](const TemporaryKeys& keys) {
    std::string text = keys.read(file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << text;
    keys.write(file, text.replace(at, from.size(), to));
  };
}

/// Signed as it should be, but with another content.
std::function<void(const TemporaryKeys&)> governance_with(const std::string& from,
                                                          const std::string& to) {
  return [=](const TemporaryKeys& keys) {
    std::string text = governance_text();
    keys.write(kGovernanceFile,
               *sign_text(text.replace(text.find(from), from.size(), to), keys.authority()));
  };
}

std::function<void(const TemporaryKeys&)> permissions_of(const Rights& rights,
                                                         const Validity& validity,
                                                         const std::string& subject = {}) {
  return [=](const TemporaryKeys& keys) {
    const auto certificate = parse_certificate(keys.read(kCertificate));
    const std::string own = subject_text(*certificate);
    keys.write(kPermissions,
               *sign_text(permissions_text({subject.empty() ? own : subject, validity, rights}),
                          keys.authority()));
  };
}

std::function<void(const TemporaryKeys&)> certificate_of(const Validity& validity) {
  return [=](const TemporaryKeys& keys) {
    ASSERT_TRUE(keys.mint("sense", Vendor::kCycloneDds, TemporaryKeys::rights(), validity).ok());
  };
}

/// Made by an authority that calls itself by the same name.
void certificate_of_a_namesake(const TemporaryKeys& keys) {
  const CertifiedKey other = make_authority("clew-test", days_around_now(1, 30));
  keys.write(
      kCertificate,
      issue_certificate(other, "sense", SubjectHalf::kLower, days_around_now(1, 10))->certificate);
}

void governance_of_somebody_else(const TemporaryKeys& keys) {
  keys.write(kGovernanceFile,
             *sign_text(governance_text(), make_authority("other", days_around_now(1, 30))));
}

void permissions_of_somebody_else(const TemporaryKeys& keys) {
  const auto certificate = parse_certificate(keys.read(kCertificate));
  keys.write(kPermissions,
             *sign_text(permissions_text({subject_text(*certificate), days_around_now(1, 10),
                                          TemporaryKeys::rights()}),
                        make_authority("other", days_around_now(1, 30))));
}

void permissions_that_allow_the_rest(const TemporaryKeys& keys) {
  const auto certificate = parse_certificate(keys.read(kCertificate));
  std::string text = permissions_text(
      {subject_text(*certificate), days_around_now(1, 10), TemporaryKeys::rights()});
  text.replace(text.find("DENY"), 4, "ALLOW");
  keys.write(kPermissions, *sign_text(text, keys.authority()));
}

void key_with_a_passphrase(const TemporaryKeys& keys) {
  const KeyPtr key = parse_private_key(keys.read(kKey));
  const BioPtr out = writing_bio();
  const auto* word = reinterpret_cast<const unsigned char*>("secret");
  ASSERT_EQ(
      PEM_write_bio_PrivateKey(out.get(), key.get(), EVP_aes_128_cbc(), word, 6, nullptr, nullptr),
      1);
  keys.write(kKey, written_text(*out));
}

void key_of_another(const TemporaryKeys& keys) {
  ASSERT_TRUE(keys.mint("drive", Vendor::kCycloneDds, {}).ok());
  keys.write(kKey, keys.read("drive.cyclonedds/private.key"));
}

void identity_of_the_other_vendor(const TemporaryKeys& keys) {
  ASSERT_TRUE(keys.mint("sense", Vendor::kFastDds, TemporaryKeys::rights()).ok());
  std::filesystem::remove_all(keys.path("sense.cyclonedds"));
  std::filesystem::rename(keys.path("sense.fastdds"), keys.path("sense.cyclonedds"));
}

void authority_that_is_none(const TemporaryKeys& keys) {
  keys.write(kAuthorityFile, keys.read(kCertificate));
}

void authority_replaced(const TemporaryKeys& keys) {
  keys.write(kAuthorityFile, make_authority("clew-test", days_around_now(1, 30)).certificate);
}

void key_that_is_a_pipe(const TemporaryKeys& keys) {
  std::filesystem::remove(keys.path(kKey));
  ASSERT_EQ(::mkfifo(keys.path(kKey).c_str(), 0600), 0);
}

/// RSA with 1024 bits, vouched for as it should be.
void certificate_of_a_weak_key(const TemporaryKeys& keys) {
  const KeyPtr weak(EVP_RSA_gen(1024));
  const CertificatePtr certificate = parse_certificate(keys.read(kCertificate));
  const KeyPtr authority = parse_private_key(keys.read(kAuthorityKeyFile));
  X509_set_pubkey(certificate.get(), weak.get());
  X509_sign(certificate.get(), authority.get(), EVP_sha256());
  const BioPtr out = writing_bio();
  PEM_write_bio_X509(out.get(), certificate.get());
  keys.write(kCertificate, written_text(*out));
}

const Rights kOwn = TemporaryKeys::rights();
const Validity kGood = days_around_now(1, 10);
const Validity kPast = days_around_now(10, -1);
const Validity kFuture = days_around_now(-1, 10);

const std::vector<BadIdentity> kBadIdentities = {
    {"NoDirectory", without(""), "", "is no directory of keys"},
    {"DirectoryThatAnybodyMayWrite", with_mode("", 0777), "", "may be changed by others"},
    {"NoAuthority", without(kAuthorityFile), kAuthorityFile, "cannot be read: No such file"},
    {"EmptyAuthority", with_text(kAuthorityFile, ""), kAuthorityFile, "has 0 bytes"},
    {"AuthorityOfGarbage", with_text(kAuthorityFile, "garbage"), kAuthorityFile,
     "is no certificate"},
    {"AuthorityThatIsNone", authority_that_is_none, kAuthorityFile, "CA:TRUE"},
    {"AuthorityReplacedByANamesake", authority_replaced, kAuthorityKeyFile,
     "is not the key of ca.pem"},
    {"AuthorityKeyThatOthersRead", with_mode(kAuthorityKeyFile, 0644), kAuthorityKeyFile,
     "may be read by others: its mode is 0644; allowed: 0600"},
    {"NoGovernance", without(kGovernanceFile), kGovernanceFile, "cannot be read"},
    {"UnsignedGovernance", with_text(kGovernanceFile, governance_text()), kGovernanceFile,
     "is not a signed text"},
    {"TamperedGovernance", changed_inside(kGovernanceFile, "ENCRYPT</data", "NONE</data"),
     kGovernanceFile, "was changed after it was signed"},
    {"GovernanceOfAnotherAuthority", governance_of_somebody_else, kGovernanceFile,
     "was signed by somebody else"},
    {"GovernanceWithoutEncryption", governance_with("ENCRYPT</data", "NONE</data"), kGovernanceFile,
     "data_protection_kind is 'NONE'; allowed: ENCRYPT"},
    {"GovernanceThatLetsStrangersIn", governance_with(">false</allow", ">true</allow"),
     kGovernanceFile, "allow_unauthenticated_participants is 'true'"},
    {"GovernanceOfSomeTopics", governance_with(">*<", ">scan<"), kGovernanceFile,
     "has no topic_rule for '*'"},
    {"NoIdentity", without("sense.cyclonedds"), "sense.cyclonedds", "is no directory of keys"},
    {"NoCertificate", without(kCertificate), kCertificate, "cannot be read"},
    {"CertificateOfGarbage", with_text(kCertificate, "garbage"), kCertificate, "is no certificate"},
    {"ExpiredCertificate", certificate_of(kPast), kCertificate, "expired on"},
    {"CertificateOfTomorrow", certificate_of(kFuture), kCertificate, "is not valid before"},
    {"CertificateOfANamesakeAuthority", certificate_of_a_namesake, kCertificate,
     "was issued by another authority"},
    {"CertificateOfAWeakKey", certificate_of_a_weak_key, kCertificate, "a strength of 80 bits"},
    {"CertificateThatOthersMayChange", with_mode(kCertificate, 0666), kCertificate,
     "may be changed by others: its mode is 0666; allowed: 0644"},
    {"IdentityOfTheOtherVendor", identity_of_the_other_vendor, kCertificate,
     "Cyclone DDS must begin a handshake"},
    {"NoKey", without(kKey), kKey, "cannot be read"},
    {"KeyThatAnybodyReads", with_mode(kKey, 0604), kKey, "may be read by others"},
    {"KeyThatItsGroupReads", with_mode(kKey, 0640), kKey, "may be read by others"},
    {"KeyThatNobodyReads", with_mode(kKey, 0000), kKey, "cannot be read"},
    {"KeyOfGarbage", with_text(kKey, "garbage"), kKey, "is no private key"},
    {"KeyOfAnother", key_of_another, kKey, "is not the key of certificate.pem"},
    {"KeyWithAPassphrase", key_with_a_passphrase, kKey, "without a passphrase"},
    {"KeyThatIsAPipe", key_that_is_a_pipe, kKey, "is no regular file"},
    {"NoPermissions", without(kPermissions), kPermissions, "cannot be read"},
    {"TamperedPermissions", changed_inside(kPermissions, ">scan<", ">goal<"), kPermissions,
     "was changed after it was signed"},
    {"PermissionsOfAnotherAuthority", permissions_of_somebody_else, kPermissions,
     "was signed by somebody else"},
    {"PermissionsOfAnotherSubject", permissions_of(kOwn, kGood, "CN=drive-1"), kPermissions,
     "is of 'CN=drive-1', and the certificate of 'CN=sense-"},
    {"ExpiredPermissions", permissions_of(kOwn, kPast), kPermissions, "expired on"},
    {"PermissionsOfTomorrow", permissions_of(kOwn, kFuture), kPermissions, "is not valid before"},
    {"PermissionsWithoutItsTopic", permissions_of({{}, {"state"}}, kGood), kPermissions,
     "it may not write scan; found: nothing"},
    {"PermissionsForEveryTopic", permissions_of({{"scan", "*"}, {"state"}}, kGood), kPermissions,
     "it may write every topic like '*'"},
    {"PermissionsThatAllowTheRest", permissions_that_allow_the_rest, kPermissions,
     "default is 'ALLOW'; allowed: DENY"}};

class Bad : public testing::TestWithParam<BadIdentity> {};

TEST_P(Bad, IdentityIsToldWithItsFileAndNoRunStartsWithIt) {
  const TemporaryKeys directory;
  const std::time_t now = std::time(nullptr);
  std::vector<CredentialFault> faults;
  const KeyDirectory& keys = directory.keys();

  GetParam().spoil(directory);

  const auto shared = keys.read_shared(now, faults);
  keys.read_identity(shared, "sense", Vendor::kCycloneDds, TemporaryKeys::rights(), now, faults);
  const std::string file =
      GetParam().file.empty() ? directory.path() : directory.path(GetParam().file);
  std::string all;
  bool found = false;
  for (const CredentialFault& fault : faults) {
    all += fault.file + ": " + fault.text + '\n';
    found = found || (fault.file == file && fault.text.find(GetParam().fault) != std::string::npos);
  }
  EXPECT_TRUE(found) << all;
  const auto run = RunSecurity::read(directory.path(),
                                     {{"sense", {Vendor::kCycloneDds}, TemporaryKeys::rights()}});
  ASSERT_FALSE(run.ok());
  EXPECT_NE(run.error().text().find("see 'clew keys check "), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Every, Bad, testing::ValuesIn(kBadIdentities),
                         [](const auto& bad) { return bad.param.name; });

TEST(ExpiredAuthority, IsToldAndMakesNoIdentity) {
  const TemporaryKeys directory(days_around_now(1, 30));
  std::vector<CredentialFault> faults;

  directory.keys().read_shared(std::time(nullptr) + 31 * kDay_s, faults);

  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults.front().file, directory.path(kAuthorityFile));
  EXPECT_NE(faults.front().text.find("expired on"), std::string::npos);
}

TEST(GoodIdentity, HasNoFault) {
  const TemporaryKeys directory;
  const std::time_t now = std::time(nullptr);
  std::vector<CredentialFault> faults;

  const auto shared = directory.keys().read_shared(now, faults);
  directory.keys().read_identity(shared, "sense", Vendor::kCycloneDds, TemporaryKeys::rights(), now,
                                 faults);

  EXPECT_TRUE(faults.empty()) << faults.front().file << ": " << faults.front().text;
}

TEST(GoodIdentity, NeedsNoKeyOfItsAuthority) {
  const TemporaryKeys directory;
  std::filesystem::remove(directory.path(kAuthorityKeyFile));

  const auto run = RunSecurity::read(directory.path(),
                                     {{"sense", {Vendor::kCycloneDds}, TemporaryKeys::rights()}});

  EXPECT_TRUE(run.ok()) << run.error().text();
  const auto minted = directory.mint("drive", Vendor::kCycloneDds, {});
  ASSERT_FALSE(minted.ok());
  EXPECT_EQ(minted.error().text(),
            directory.path(kAuthorityKeyFile) + ": is not there; without it nothing can be signed");
}

TEST(KeyDirectory, NeverReplacesAnAuthority) {
  const TemporaryKeys directory;

  const auto again = directory.keys().create("other", days_around_now(1, 30));

  ASSERT_FALSE(again.ok());
  EXPECT_NE(again.error().text().find("is there already"), std::string::npos);
}

}  // namespace
}  // namespace clew::bridge
