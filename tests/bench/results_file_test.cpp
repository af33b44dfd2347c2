// SPDX-License-Identifier: Apache-2.0
#include "bench/results_file.hpp"

#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"

namespace clew::bench {
namespace {

using recording_test::read_bytes;
using recording_test::ScratchDirectory;
using recording_test::write_bytes;

const std::map<std::string, std::string> kConfiguration = {{"max_ticks", "6000"}, {"seeds", "1 2"}};

TEST(ResultsFile, KeepsItsLinesWhenOpenedAgain) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  {
    auto file = ResultsFile::open(path, kConfiguration, false);
    ASSERT_TRUE(file.ok()) << file.error().text();
    ASSERT_TRUE(file->append(R"({"run":1})").ok());
    ASSERT_TRUE(file->append(R"({"run":2})").ok());
  }

  const auto again = ResultsFile::open(path, kConfiguration, false);

  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->lines(), (std::vector<std::string>{R"({"run":1})", R"({"run":2})"}));
}

TEST(ResultsFile, DropsATornLastLine) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  {
    auto file = ResultsFile::open(path, kConfiguration, false);
    ASSERT_TRUE(file.ok() && file->append(R"({"run":1})").ok());
  }
  const std::string whole = read_bytes(path);
  // Torn anywhere, in the line of the configuration, too.
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path, whole.substr(0, size));

    auto file = ResultsFile::open(path, kConfiguration, false);

    ASSERT_TRUE(file.ok()) << size << ": " << file.error().text();
    EXPECT_TRUE(file->lines().empty()) << size;
    ASSERT_TRUE(file->append(R"({"run":1})").ok());
    EXPECT_EQ(read_bytes(path), whole) << size;
  }
}

TEST(ResultsFile, NamesWhatIsConfiguredOtherwise) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  ASSERT_TRUE(ResultsFile::open(path, kConfiguration, false).ok());
  const std::vector<std::pair<std::map<std::string, std::string>, std::string>> cases = {
      {{{"max_ticks", "100"}, {"seeds", "1 2"}}, "made with 'max_ticks' 6000, now it is 100"},
      {{{"max_ticks", "6000"}}, "it has 'seeds', which is not asked for now"},
      {{{"max_ticks", "6000"}, {"seeds", "1 2"}, {"world x", "a"}}, "'world x' is new"}};

  for (const auto& [configuration, message] : cases) {
    const auto file = ResultsFile::open(path, configuration, false);

    ASSERT_FALSE(file.ok());
    EXPECT_NE(file.error().text().find(message), std::string::npos) << file.error().text();
    EXPECT_NE(file.error().text().find("--force"), std::string::npos);
  }
}

TEST(ResultsFile, BeginsAgainWhenAsked) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  {
    auto file = ResultsFile::open(path, {{"other", "1"}}, false);
    ASSERT_TRUE(file.ok() && file->append(R"({"run":1})").ok());
  }

  const auto file = ResultsFile::open(path, kConfiguration, true);

  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file->lines().empty());
}

TEST(ResultsFile, IsHeldByOneBenchAtATime) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  const auto first = ResultsFile::open(path, kConfiguration, false);
  ASSERT_TRUE(first.ok());

  const auto second = ResultsFile::open(path, kConfiguration, true);

  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().text().find("by another bench"), std::string::npos);
}

TEST(ResultsFile, RefusesWhatIsNone) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  write_bytes(path, "precious\n");

  const auto file = ResultsFile::open(path, kConfiguration, false);

  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find(path + ":1: is no file of results"), std::string::npos)
      << file.error().text();
  EXPECT_EQ(read_bytes(path), "precious\n");
  EXPECT_FALSE(ResultsFile::open("/no/such/directory/results.jsonl", kConfiguration, false).ok());
}

TEST(ResultsFile, NamesADamagedLine) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  {
    auto file = ResultsFile::open(path, kConfiguration, false);
    ASSERT_TRUE(file.ok() && file->append(R"({"run":1})").ok());
  }
  write_bytes(path, read_bytes(path) + "{\"run\":\n");

  const auto file = ResultsFile::open(path, kConfiguration, false);

  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find("results.jsonl:3: is no line of JSON"), std::string::npos)
      << file.error().text();
}

}  // namespace
}  // namespace clew::bench
