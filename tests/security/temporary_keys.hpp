// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "security/key_directory.hpp"

namespace clew::bridge {

inline constexpr std::time_t kDay_s = 24 * 3600;

inline Validity days_around_now(int before, int after) {
  const std::time_t now = std::time(nullptr);
  return {now - before * kDay_s, now + after * kDay_s};
}

/// A directory of keys with one identity, `sense.cyclonedds`, which may write `scan` and read
/// `state`; gone with the object.
class TemporaryKeys {
 public:
  explicit TemporaryKeys(const Validity& of_authority = days_around_now(20, 30))
      : parent_(make_parent()), keys_(path()) {
    EXPECT_TRUE(keys_.create("clew-test", of_authority).ok());
    EXPECT_TRUE(mint("sense", Vendor::kCycloneDds, rights()).ok());
  }
  ~TemporaryKeys() { std::filesystem::remove_all(parent_); }
  TemporaryKeys(const TemporaryKeys&) = delete;
  TemporaryKeys& operator=(const TemporaryKeys&) = delete;

  static Rights rights() { return {{"scan"}, {"state"}}; }

  std::string path() const { return parent_ + "/keys"; }
  std::string path(const std::string& file) const { return path() + '/' + file; }
  const KeyDirectory& keys() const { return keys_; }

  core::Result<void> mint(const std::string& name, Vendor vendor, const Rights& of_name,
                          const Validity& validity = days_around_now(1, 10)) const {
    return keys_.mint(name, vendor, of_name, validity);
  }

  std::string read(const std::string& file) const {
    std::ifstream stream(path(file));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Leaves the mode of a file that is there.
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(path(file)) << text;
  }
  void set_mode(const std::string& file, mode_t mode) const {
    ASSERT_EQ(::chmod(path(file).c_str(), mode), 0) << file;
  }
  CertifiedKey authority() const { return {read(kAuthorityFile), read(kAuthorityKeyFile)}; }

 private:
  static std::string make_parent() {
    std::string name = testing::TempDir() + "clew-keys-XXXXXX";
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    return name;
  }

  std::string parent_;
  KeyDirectory keys_;
};

}  // namespace clew::bridge
