// SPDX-License-Identifier: Apache-2.0
#include "bench/results_file.hpp"

#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"

namespace clew::bench {
namespace {

using recording_test::read_bytes;
using recording_test::ScratchDirectory;
using recording_test::write_bytes;

const ResultsHeader kHeader = {{"smoke", {"reactive"}, {}, {"sense.range_m=1"}, {}, {}},
                               {{"max_ticks", "6000"}, {"seeds", "1 2"}}};

core::Result<void> ignore(const std::string&, int) { return {}; }

/// Makes a file with one line.
void make_file(const std::string& path, const ResultsHeader& header = kHeader) {
  auto file = ResultsFile::open(path, header, false, ignore);
  ASSERT_TRUE(file.ok()) << file.error().text();
  ASSERT_TRUE(file->append(R"({"run":1})").ok());
}

TEST(ResultsFile, KeepsItsLinesWhenOpenedAgain) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  make_file(path);
  std::vector<std::string> lines;

  const auto again =
      ResultsFile::open(path, kHeader, false, [&](const std::string& line, int number) {
        lines.push_back(std::to_string(number) + ' ' + line);
        return core::Result<void>();
      });

  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(lines, (std::vector<std::string>{R"(2 {"run":1})"}));
}

TEST(ResultsFile, TellsWhatWasAskedFor) {
  const auto read = read_header(kHeader.text(), "file");

  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read->configuration, kHeader.configuration);
  EXPECT_EQ(read->order.words(),
            (std::vector<std::string>{"smoke", "--graph", "reactive", "--set", "sense.range_m=1"}));
}

TEST(ResultsFile, RefusesAHeaderOfAnotherFormat) {
  const std::pair<std::string, std::string> cases[] = {
      {R"({"format":"clew-bench/1"})", "has the format clew-bench/1; expected format clew-bench/2"},
      {R"({"format":1})", "is no file of results"},
      {"[]", "is no file of results"},
      {"", "is no file of results"},
      {R"({"format":"clew-bench/2","configuration":{}})", "is no header of results"},
      {R"({"format":"clew-bench/2","order":{"suite":1},"configuration":{}})",
       "is no header of results"}};
  for (const auto& [line, message] : cases) {
    const auto refused = read_header(line, "file");
    ASSERT_FALSE(refused.ok()) << line;
    EXPECT_NE(refused.error().text().find("file:1: " + message), std::string::npos)
        << refused.error().text();
  }
}

TEST(ResultsFile, DropsATornLastLine) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  make_file(path);
  const std::string whole = read_bytes(path);
  // Torn anywhere, in the line of the configuration, too.
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path, whole.substr(0, size));

    bool is_empty = true;
    auto file = ResultsFile::open(path, kHeader, false, [&](const std::string&, int) {
      is_empty = false;
      return core::Result<void>();
    });

    ASSERT_TRUE(file.ok()) << size << ": " << file.error().text();
    EXPECT_TRUE(is_empty) << size;
    ASSERT_TRUE(file->append(R"({"run":1})").ok());
    EXPECT_EQ(read_bytes(path), whole) << size;
  }
}

TEST(ResultsFile, NamesWhatIsConfiguredOtherwise) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  ASSERT_TRUE(ResultsFile::open(path, kHeader, false, ignore).ok());
  const std::vector<std::pair<std::map<std::string, std::string>, std::string>> cases = {
      {{{"max_ticks", "100"}, {"seeds", "1 2"}}, "made with 'max_ticks' 6000, now it is 100"},
      {{{"max_ticks", "6000"}}, "it has 'seeds', which is not asked for now"},
      {{{"max_ticks", "6000"}, {"seeds", "1 2"}, {"world x", "a"}}, "'world x' is new"}};

  for (const auto& [configuration, message] : cases) {
    const auto file = ResultsFile::open(path, {kHeader.order, configuration}, false, ignore);

    ASSERT_FALSE(file.ok());
    EXPECT_NE(file.error().text().find(message), std::string::npos) << file.error().text();
    EXPECT_NE(file.error().text().find("--force"), std::string::npos);
  }
}

TEST(ResultsFile, BeginsAgainWhenAsked) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  make_file(path, {kHeader.order, {{"other", "1"}}});

  const auto file = ResultsFile::open(path, kHeader, true, ignore);

  ASSERT_TRUE(file.ok());
  EXPECT_EQ(read_bytes(path), kHeader.text() + '\n');
}

TEST(ResultsFile, IsHeldByOneBenchAtATime) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  const auto first = ResultsFile::open(path, kHeader, false, ignore);
  ASSERT_TRUE(first.ok());

  const auto second = ResultsFile::open(path, kHeader, true, ignore);

  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().text().find("by another bench"), std::string::npos);
}

TEST(ResultsFile, RefusesWhatIsNone) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  write_bytes(path, "precious\n");

  const auto file = ResultsFile::open(path, kHeader, false, ignore);

  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find(path + ":1: is no file of results"), std::string::npos)
      << file.error().text();
  EXPECT_EQ(read_bytes(path), "precious\n");
  EXPECT_FALSE(ResultsFile::open("/no/such/directory/results.jsonl", kHeader, false, ignore).ok());
}

TEST(ResultsFile, RefusesWhatItsReaderRefuses) {
  const ScratchDirectory directory;
  const std::string path = directory.file("results.jsonl");
  make_file(path);

  const auto file = ResultsFile::open(path, kHeader, false, [&](const auto&, int number) {
    return core::Result<void>(core::Error{"is no line of results", path, number, 0});
  });

  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find("results.jsonl:2: is no line of results"), std::string::npos)
      << file.error().text();
}

}  // namespace
}  // namespace clew::bench
