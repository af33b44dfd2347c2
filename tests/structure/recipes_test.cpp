// SPDX-License-Identifier: Apache-2.0
/// The recipes "How to add a ..." of the stages name every list of the build that a new behaviour
/// has to be in: whoever follows one gets a program that links and a test that runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/source_path.hpp"

namespace clew::structure {
namespace {

const std::vector<std::string> kStages = {"classify", "control", "drive",
                                          "plan",     "recover", "sense"};

std::string text_of(const std::string& path) {
  std::ifstream file(tests::source_path(path));
  EXPECT_TRUE(file.is_open()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The recipe in a stage's README, its lines joined; empty if there is none.
std::string recipe_of(const std::string& stage) {
  const std::string text = text_of("components/" + stage + "/README.md");
  const auto begin = text.find("\n## How to add ");
  if (begin == std::string::npos) return "";
  std::string recipe = text.substr(begin + 1, text.find("\n## ", begin + 1) - begin - 1);
  std::replace(recipe.begin(), recipe.end(), '\n', ' ');
  return recipe;
}

/// What a recipe says of its step that names `file`, up to the next step.
std::string step_with(const std::string& recipe, const std::string& file) {
  const auto begin = recipe.find(file);
  if (begin == std::string::npos) return "";
  std::size_t end = begin;
  const auto is_number = [&](std::size_t at) {
    return recipe[at] == ' ' && recipe[at + 1] >= '1' && recipe[at + 1] <= '9' &&
           recipe[at + 2] == '.';
  };
  while (end + 2 < recipe.size() && !is_number(end)) ++end;
  return recipe.substr(begin, end - begin);
}

TEST(Recipe, IsThereForEveryStage) {
  for (const std::string& stage : kStages) EXPECT_NE(recipe_of(stage), "") << stage;
}

TEST(Recipe, NamesTheListOfSourcesUnlessTheBuildFindsThem) {
  for (const std::string& stage : kStages) {
    const std::string recipe = recipe_of(stage);
    const bool finds = says(text_of("components/" + stage + "/CMakeLists.txt"), "GLOB");

    EXPECT_EQ(says(recipe, "A line in `CMakeLists.txt`"), !finds) << stage;
    EXPECT_EQ(says(step_with(recipe, "<name>.cpp`"), "which the build finds"), finds) << stage;
  }
}

TEST(Recipe, SaysThatTheBuildFindsTheTestOnlyWhereItDoes) {
  for (const std::string& stage : kStages) {
    const std::string step = step_with(recipe_of(stage), "`tests/" + stage + "/");
    const bool finds = says(text_of("tests/" + stage + "/CMakeLists.txt"), "EVERY_TEST");

    EXPECT_TRUE(says(step, "<name>_test.cpp`")) << stage;
    EXPECT_EQ(says(step, "which the build finds"), finds) << stage;
  }
}

TEST(Recipe, NamesTheRegistryAndTheTableOfParameters) {
  for (const std::string& stage : kStages) {
    EXPECT_TRUE(says(recipe_of(stage), "A line in `registry.cpp`")) << stage;
    EXPECT_TRUE(says(recipe_of(stage), "`tools/parameter-tables`")) << stage;
  }
}

/// Nine files at most, each of which is there, but for the new type.
TEST(Recipe, OfATopicNamesAtMostNineFiles) {
  const std::string text = text_of("bridge/wire/README.md");
  const auto begin = text.find("\n## Adding a topic\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string recipe = text.substr(begin);
  std::vector<std::string> files;
  const std::regex path("`((idl|components|tests)/[a-zA-Z_/]+\\.[a-z]+)`");
  for (std::sregex_iterator found(recipe.begin(), recipe.end(), path), end; found != end; ++found) {
    files.push_back((*found)[1]);
  }

  EXPECT_EQ(files.size(), 9U);
  EXPECT_TRUE(says(recipe, "Seven files.") && says(recipe, "Nine, if"));
  for (const std::string& file : files) {
    if (file != "idl/Quiet.idl") text_of(file);
  }
}

/// Who tries something is not held up by warnings; tools/test makes them errors.
TEST(Presets, ForPeopleLeaveWarningsWarnings) {
  const std::string presets = text_of("CMakePresets.json");
  for (const std::string name : {"release", "debug", "relwithdebinfo"}) {
    const auto begin = presets.find("{\"name\": \"" + name + "\"");
    ASSERT_NE(begin, std::string::npos) << name;
    const std::string preset = presets.substr(begin, presets.find("}}", begin) - begin);
    EXPECT_TRUE(says(preset, "\"CLEW_WERROR\": \"OFF\"")) << name;
  }
  EXPECT_TRUE(says(text_of("tools/test"), "--preset release -DBUILD_TESTING=ON -DCLEW_WERROR=ON"));
}

}  // namespace
}  // namespace clew::structure
