// SPDX-License-Identifier: Apache-2.0
#include "query/row_output.hpp"

#include <gtest/gtest.h>

namespace clew::query {
namespace {

/// What an output prints of some rows.
template <typename Output>
std::string printed(const std::vector<std::string>& columns,
                    const std::vector<std::vector<Cell>>& rows) {
  std::string text;
  Output output([&](const std::string& piece) { text += piece; });
  EXPECT_TRUE(output.begin(columns).ok());
  for (const auto& row : rows) EXPECT_TRUE(output.row(row).ok());
  if constexpr (std::is_same_v<Output, TableOutput>) output.end();
  return text;
}

const std::vector<std::string> kColumns = {"world", "n", "share"};
const std::vector<std::vector<Cell>> kRows = {{std::string("ü-trap"), std::int64_t{7}, 0.5},
                                              {std::string("a"), std::int64_t{-120}, Cell()}};

TEST(TableOutput, PutsNumbersToTheRight) {
  EXPECT_EQ(printed<TableOutput>(kColumns, kRows),
            "world      n  share\n"
            "ü-trap     7    0.5\n"
            "a       -120\n");
}

TEST(TableOutput, KeepsARowOnOneLine) {
  EXPECT_EQ(printed<TableOutput>({"x"}, {{std::string("a\nb\tc")}}), "x\na b c\n");
  EXPECT_EQ(printed<TableOutput>({"x"}, {}), "x\n");
}

TEST(JsonOutput, HasAnObjectARow) {
  EXPECT_EQ(printed<JsonOutput>(kColumns, kRows),
            "{\"world\":\"ü-trap\",\"n\":7,\"share\":0.5}\n"
            "{\"world\":\"a\",\"n\":-120,\"share\":null}\n");
}

TEST(JsonOutput, RefusesTwoColumnsOfOneName) {
  JsonOutput output([](const std::string&) {});

  const auto begun = output.begin({"count(*)", "x", "count(*)"});

  ASSERT_FALSE(begun.ok());
  EXPECT_EQ(begun.error().text(),
            "--json: two columns are called 'count(*)'; name one otherwise, with AS");
}

TEST(CsvOutput, QuotesWhatNeedsIt) {
  EXPECT_EQ(printed<CsvOutput>({"a", "b,c"}, {{std::string("say \"x\""), Cell()},
                                              {0.1, std::string("two\nlines")}}),
            "a,\"b,c\"\n\"say \"\"x\"\"\",\n0.1,\"two\nlines\"\n");
}

}  // namespace
}  // namespace clew::query
