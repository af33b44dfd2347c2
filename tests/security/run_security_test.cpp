// SPDX-License-Identifier: Apache-2.0
#include "security/run_security.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "security/certificate.hpp"
#include "security/openssl.hpp"
#include "security/policy.hpp"

namespace clew::bridge {
namespace {

std::string text_in(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

RunSecurity::Shared mint_two() {
  const auto minted = RunSecurity::mint(
      {{"sense", {Vendor::kCycloneDds}, {{"scan"}, {"state"}}},
       {"control", {Vendor::kCycloneDds, Vendor::kFastDds}, {{"command"}, {"scan"}}}});
  EXPECT_TRUE(minted.ok()) << minted.error().text();
  return *minted;
}

TEST(RunSecurity, MintsAnIdentityForEachVendorThatMayCarryAParticipant) {
  const auto security = mint_two();

  const SecurityFiles& cyclone = security->files("control", Vendor::kCycloneDds);
  const SecurityFiles& fast = security->files("control", Vendor::kFastDds);

  EXPECT_EQ(cyclone.authority, fast.authority);
  EXPECT_EQ(cyclone.governance, security->files("sense", Vendor::kCycloneDds).governance);
  EXPECT_NE(cyclone.private_key, fast.private_key);
  EXPECT_EQ(half_of(*parse_certificate(text_in(cyclone.certificate))), SubjectHalf::kLower);
  EXPECT_EQ(half_of(*parse_certificate(text_in(fast.certificate))), SubjectHalf::kUpper);
}

TEST(RunSecurity, AllowsEachItsOwnTopicsOnly) {
  const auto security = mint_two();
  const SecurityFiles& files = security->files("control", Vendor::kFastDds);
  const auto authority = parse_certificate(text_in(files.authority));

  const auto permissions = verify_text(text_in(files.permissions), *authority);

  ASSERT_TRUE(permissions.ok()) << permissions.error().text();
  const auto grants = read_permissions(*permissions);
  ASSERT_TRUE(grants.ok()) << grants.error().text();
  ASSERT_EQ(grants->size(), 1u);
  EXPECT_EQ(grants->front().rights.writes, std::set<std::string>{"command"});
  EXPECT_EQ(grants->front().rights.reads, std::set<std::string>{"scan"});
  EXPECT_EQ(grants->front().subject, subject_text(*parse_certificate(text_in(files.certificate))));
}

TEST(RunSecurity, KeepsKeysWhereNobodyElseReadsThemAndNobodyChangesThem) {
  const auto security = mint_two();
  const std::string& path = security->files("sense", Vendor::kCycloneDds).private_key;

  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  const int file = ::open(path.c_str(), O_RDWR);
  const bool changed = file >= 0 && ::write(file, "x", 1) == 1;
  if (file >= 0) ::close(file);

  EXPECT_EQ(status.st_mode & 0777, 0400u);
  EXPECT_FALSE(changed);
}

TEST(RunSecurity, LeavesNothingBehind) {
  auto security = mint_two();
  const std::string path = security->files("sense", Vendor::kCycloneDds).private_key;
  ASSERT_FALSE(text_in(path).empty());

  security.reset();

  EXPECT_TRUE(text_in(path).empty());
}

}  // namespace
}  // namespace clew::bridge
