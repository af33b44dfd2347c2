// SPDX-License-Identifier: Apache-2.0
#include "core/quoted.hpp"

#include <gtest/gtest.h>

#include "core/yaml_reader.hpp"

namespace clew::core {
namespace {

TEST(Quoted, YamlEscapesQuotesBackslashesAndControlCharacters) {
  EXPECT_EQ(yaml_quoted(""), R"("")");
  EXPECT_EQ(yaml_quoted("it's so"), R"("it's so")");
  EXPECT_EQ(yaml_quoted("a \"b\" \\c"), R"("a \"b\" \\c")");
  EXPECT_EQ(yaml_quoted("a\nb\x7f\x01"), R"("a\x0ab\x7f\x01")");
  EXPECT_EQ(yaml_quoted("Straße"), "\"Straße\"");
}

TEST(Quoted, ShellLeavesPlainWords) {
  EXPECT_EQ(shell_word("--with=recover:a/b_c.d,e@f%g+h"), "--with=recover:a/b_c.d,e@f%g+h");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("two words"), "'two words'");
  EXPECT_EQ(shell_word("it's"), R"('it'\''s')");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_word("ß"), "'ß'");
  EXPECT_EQ(shell_word(std::string(1, '\0')), std::string("'\0'", 3));
}

TEST(Quoted, CsvLeavesFieldsThatNeedNoQuotes) {
  EXPECT_EQ(csv_field("it's so"), "it's so");
  EXPECT_EQ(csv_field("a,b"), R"("a,b")");
  EXPECT_EQ(csv_field("a \"b\""), R"("a ""b""")");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

}  // namespace
}  // namespace clew::core
