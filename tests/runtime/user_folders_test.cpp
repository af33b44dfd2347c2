// SPDX-License-Identifier: Apache-2.0
#include "runtime/user_folders.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace clew::runtime {
namespace {

/// Sets two variables, and puts back what they were.
class UserFolders : public ::testing::Test {
 protected:
  void TearDown() override {
    put("XDG_CONFIG_HOME", config_);
    put("HOME", home_);
  }

  static std::optional<std::string> get(const char* variable) {
    const char* const value = std::getenv(variable);
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  }
  static void put(const char* variable, const std::optional<std::string>& value) {
    if (value) {
      ::setenv(variable, value->c_str(), 1);
    } else {
      ::unsetenv(variable);
    }
  }

  const std::optional<std::string> config_ = get("XDG_CONFIG_HOME");
  const std::optional<std::string> home_ = get("HOME");
};

TEST_F(UserFolders, AreWhereTheVariableSays) {
  put("XDG_CONFIG_HOME", "/somewhere");
  put("HOME", "/home/anna");

  EXPECT_EQ(user_config_folder(), "/somewhere/clew");
}

TEST_F(UserFolders, AreBelowHomeOtherwise) {
  put("HOME", "/home/anna");
  // A relative path is to be ignored, and so is an empty one.
  for (const std::optional<std::string>& config :
       {std::optional<std::string>(), std::optional<std::string>(""),
        std::optional<std::string>("settings")}) {
    put("XDG_CONFIG_HOME", config);

    EXPECT_EQ(user_config_folder(), "/home/anna/.config/clew") << config.value_or("not set");
  }
}

TEST_F(UserFolders, AreNowhereWithoutAHome) {
  put("XDG_CONFIG_HOME", "relative");
  put("HOME", std::nullopt);

  EXPECT_EQ(user_config_folder(), std::nullopt);
}

}  // namespace
}  // namespace clew::runtime
