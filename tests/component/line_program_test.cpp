// SPDX-License-Identifier: Apache-2.0
#include "component/line_program.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

LineProgram shell(const std::string& script) {
  auto program = LineProgram::start({"/bin/sh", "-c", script}, {{"GREETING", "good day"}});
  EXPECT_TRUE(program.ok());
  return std::move(program).value();
}

/// How a script's first answer fails; empty if there is one.
std::string failure(const std::string& script, milliseconds patience = seconds(10)) {
  LineProgram program = shell(script);
  const auto answer = program.ask("question", patience);
  return answer.ok() ? "" : answer.error().text();
}

TEST(ALineProgram, AnswersLineByLineAndHasItsVariables) {
  LineProgram program = shell("while read line; do echo \"$GREETING $line\"; done");

  EXPECT_EQ(*program.ask("first", seconds(10)), "good day first");
  EXPECT_EQ(*program.ask("second", seconds(10)), "good day second");
}

TEST(ALineProgram, TakesALineThatIsLongerThanAPipe) {
  LineProgram program = shell("while read line; do echo \"$line\"; done");
  const std::string line(300'000, 'x');

  const auto answer = program.ask(line, seconds(60));

  ASSERT_TRUE(answer.ok()) << answer.error().text();
  EXPECT_EQ(*answer, line);
}

TEST(ALineProgram, ThatEndsSaysHow) {
  EXPECT_EQ(failure("read line; exit 3"), "it exited with status 3");
  EXPECT_EQ(failure("read line; kill -9 $$"), "it was killed by signal 9 (Killed)");
  EXPECT_EQ(failure("read line; printf half; exit 0"), "it exited with status 0");
  EXPECT_EQ(failure("exec >&-; read line; read line"),
            "it has closed its standard input or output");
}

TEST(ALineProgram, ThatDoesNotAnswerIsNotWaitedForForEver) {
  EXPECT_EQ(failure("read line; read line", milliseconds(20)),
            "it has not answered in time (a line must be written at once: is its output flushed?)");
}

TEST(ALineProgram, MayNotSpeakUnasked) {
  LineProgram program = shell("while read line; do printf 'one\\ntwo\\n'; done");

  EXPECT_EQ(*program.ask("first", seconds(10)), "one");

  EXPECT_EQ(program.ask("second", seconds(10)).error().text(),
            "it wrote 'two' without being asked: one line is allowed for each");
}

TEST(ALineProgram, MayNotWriteALineWithoutAnEnd) {
  EXPECT_EQ(failure("read line; tr '\\0' x < /dev/zero"), "its line is longer than 1048576 bytes");
}

TEST(ALineProgram, ThatIsNotThereIsNamed) {
  const auto program = LineProgram::start({"/no/such/program"}, {});

  ASSERT_FALSE(program.ok());
  EXPECT_EQ(program.error().text(),
            "/no/such/program: cannot be started: No such file or directory");
}

}  // namespace
}  // namespace clew::bridge
