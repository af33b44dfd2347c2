// SPDX-License-Identifier: Apache-2.0
#include "core/terminal_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/result.hpp"

namespace clew::core {
namespace {

TEST(TerminalText, ShowsWhatCommandsATerminal) {
  EXPECT_EQ(terminal_text("a\x1b[2Jb\r\n"), "a\\x1b[2Jb\\x0d\\x0a");
  EXPECT_EQ(terminal_text(std::string("\0\x7f", 2)), "\\x00\\x7f");
}

TEST(TerminalText, ShowsControlsOfC1InUtf8AndAlone) {
  EXPECT_EQ(terminal_text("x\xc2\x80 \xc2\x9b[2J \xc2\x9fy"),
            "x\\xc2\\x80 \\xc2\\x9b[2J \\xc2\\x9fy");
  EXPECT_EQ(terminal_text("x\x9b[2J"), "x\\x9b[2J") << "a terminal of one byte a letter";
  EXPECT_EQ(terminal_text("x\xe2\x9b"), "x\xe2\\x9b") << "of a letter that was cut";
}

TEST(TerminalText, LeavesLettersOfAnyLanguage) {
  const std::string letters = "\xc2\xa0 \xc3\x9b \xe2\x80\x9b \xf0\x9f\x9b\x9b \\x1b ~";

  EXPECT_EQ(terminal_text(letters), letters) << "their second bytes are those of controls";
  EXPECT_EQ(terminal_text(terminal_text("\x1b")), "\\x1b");
}

TEST(TerminalText, OfSeveralLinesKeepsTheirEnds) {
  EXPECT_EQ(terminal_lines("one\n\ttwo\r\n\x1b]0;x\x07"), "one\n\ttwo\\x0d\n\\x1b]0;x\\x07");
}

TEST(Error, SteersNoTerminal) {
  EXPECT_EQ((Error{"unknown key '\x1b[31m'", "\xc2\x9bworld.yaml", 3, 4}.text()),
            "\\xc2\\x9bworld.yaml:3:4: unknown key '\\x1b[31m'");
}

}  // namespace
}  // namespace clew::core
