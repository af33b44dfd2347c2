// SPDX-License-Identifier: Apache-2.0
#include "log/log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace clew::logs {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Logs with settings of its own, and leaves the log as a process has it at first.
class Log : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "clew-log-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory_ = name;
  }
  void TearDown() override {
    listen(nullptr);
    ASSERT_TRUE(open({}).ok());
    fs::remove_all(directory_);
  }

  /// What standard error gets of what `act` tells.
  template <typename Act>
  std::string shown(const Settings& settings, Act act) {
    const auto opened = open(settings);
    EXPECT_TRUE(opened.ok());
    ::testing::internal::CaptureStderr();
    act();
    return ::testing::internal::GetCapturedStderr();
  }

  fs::path directory_;
};

void tell_all() {
  debug("a debug line");
  info("{} lines", 2);
  warning("a warning");
  error("an error");
}

TEST_F(Log, ShowsWhatIsAtLeastItsLevelAndWhoSaysIt) {
  Settings settings;
  settings.speaker = "clew component sense";

  EXPECT_EQ(shown(settings, tell_all),
            "clew component sense: 2 lines\nclew component sense: a warning\n"
            "clew component sense: an error\n");
  settings.shown = Level::kError;
  EXPECT_EQ(shown(settings, tell_all), "clew component sense: an error\n");
  EXPECT_FALSE(shows(Level::kWarning));
  settings.shown = Level::kOff;
  EXPECT_EQ(shown(settings, tell_all), "");
  EXPECT_FALSE(shows(Level::kError));
}

TEST_F(Log, TellsTimesAndLevelsIfAsked) {
  Settings settings;
  settings.shown = Level::kDebug;
  settings.times = true;

  const std::string lines = shown(settings, tell_all);

  const std::string time = R"(\d\d:\d\d:\d\d\.\d{3} )";
  EXPECT_TRUE(std::regex_match(
      lines, std::regex(time + "debug clew: a debug line\n" + time + "info clew: 2 lines\n" + time +
                        "warning clew: a warning\n" + time + "error clew: an error\n")))
      << lines;
}

TEST_F(Log, MakesControlCharactersOfOthersHarmless) {
  const std::string stranger = "\x1b[2J\r\n\xc2\x9b";

  EXPECT_EQ(shown({}, [&] { info("{}", stranger); }), "clew: \\x1b[2J\\x0d\\x0a\\xc2\\x9b\n");
  EXPECT_EQ(shown({}, [&] { complain("first\nsecond" + stranger.substr(0, 4)); }),
            "clew: first\nsecond\\x1b[2J\n");
}

TEST_F(Log, WritesTheFileWithDatesAndThoughNothingIsShown) {
  Settings settings;
  settings.shown = Level::kError;
  settings.file = (directory_ / "a.log").string();
  std::ofstream(settings.file) << "what was there\n";

  const std::string lines = shown(settings, [] {
    tell_all();
    complain("bad input");
  });

  EXPECT_EQ(lines, "clew: an error\nclew: bad input\n");
  const std::string time = R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z )";
  const std::string who = " clew\\[" + std::to_string(::getpid()) + "\\]: ";
  const std::string text = text_of(settings.file);
  EXPECT_TRUE(
      std::regex_match(text, std::regex("what was there\n" + time + "info" + who + "2 lines\n" +
                                        time + "warning" + who + "a warning\n" + time + "error" +
                                        who + "an error\n" + time + "error" + who + "bad input\n")))
      << text;
}

TEST_F(Log, MakesAFileAProcessInItsDirectory) {
  Settings settings;
  settings.directory = (directory_ / "deep" / "logs").string();
  settings.file_name = "clew component ../sense";

  shown(settings, tell_all);

  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(settings.directory)) {
    names.push_back(entry.path().filename().string());
  }
  ASSERT_EQ(names.size(), 1U);
  EXPECT_TRUE(std::regex_match(names[0], std::regex(R"(clew-component----sense-\d{8}T\d{6}Z-)" +
                                                    std::to_string(::getpid()) + R"(\.log)")))
      << names[0];
}

TEST_F(Log, RefusesWhatCannotBeWritten) {
  Settings file;
  file.file = directory_.string();
  Settings directory;
  directory.directory = (directory_ / "a.log" / "logs").string();
  std::ofstream(directory_ / "a.log") << "no directory\n";

  const auto no_file = open(file);
  const auto no_directory = open(directory);

  ASSERT_FALSE(no_file.ok());
  EXPECT_EQ(no_file.error().text(), file.file + ": cannot be written as a log: Is a directory");
  ASSERT_FALSE(no_directory.ok());
  EXPECT_EQ(no_directory.error().text(),
            directory.directory + ": cannot be made to log into: Not a directory");
}

TEST_F(Log, TellsAListenerAllButDebugging) {
  std::vector<std::string> heard;
  listen([&](Level level, const std::string& text) {
    heard.push_back(std::string(level_name(level)) + ' ' + text);
  });
  Settings settings;
  settings.shown = Level::kOff;

  shown(settings, tell_all);

  EXPECT_EQ(heard,
            (std::vector<std::string>{"info 2 lines", "warning a warning", "error an error"}));
}

TEST_F(Log, KnowsItsLevelsByName) {
  for (const Level level :
       {Level::kDebug, Level::kInfo, Level::kWarning, Level::kError, Level::kOff}) {
    const auto read = level_from_name(std::string(level_name(level)));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, level);
  }
  const auto unknown = level_from_name("warn");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("warning"), std::string::npos);
}

}  // namespace
}  // namespace clew::logs
