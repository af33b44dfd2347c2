// SPDX-License-Identifier: Apache-2.0
#include "query/query.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../recording/scratch_directory.hpp"
#include "query/runs_table.hpp"

namespace clew::query {
namespace {

using recording_test::ScratchDirectory;
using recording_test::write_bytes;

/// What a query gives.
struct Answer {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Keeps it.
class Kept : public RowSink {
 public:
  core::Result<void> begin(const std::vector<std::string>& names) override {
    answer.columns = names;
    return {};
  }
  core::Result<void> row(const std::vector<Cell>& cells) override {
    answer.rows.push_back(cells);
    return {};
  }

  Answer answer;
};

/// Three runs of a bench.
class QueryOfThreeRuns : public testing::Test {
 protected:
  QueryOfThreeRuns() {
    write({line("a", 1, "true", "12.5"), line("b", 1, "null", "null"), line("b", 2, "false", "8")});
  }

  static std::string line(const char* world, int seed, const char* success, const char* path_m) {
    return fmt::format(
        R"({{"graph":"g","variant":"","world":"{}","seed":{},"success":{},"path_length_m":{},)"
        R"("detectors":[{{"rule":"revisit","alarms":{}}}]}})",
        world, seed, success, path_m, seed);
  }

  void write(const std::vector<std::string>& lines) const {
    std::string text = "{}\n";
    for (const std::string& each : lines) text += each + '\n';
    write_bytes(scratch_.file("results.jsonl"), text);
    write_bytes(scratch_.file("timing.jsonl"),
                R"({"graph":"g","variant":"","world":"a","seed":1,"wall_s":0.25})"
                "\n");
  }

  Answer ask(const std::string& sql) const {
    Kept kept;
    const auto done = query_results(scratch_.path().string(), sql, kept);
    EXPECT_TRUE(done.ok()) << done.error().text();
    return kept.answer;
  }

  void expect_refused(const std::string& sql, const std::string& text) const {
    Kept kept;
    const auto done = query_results(scratch_.path().string(), sql, kept);
    ASSERT_FALSE(done.ok()) << sql;
    EXPECT_NE(done.error().text().find(text), std::string::npos) << done.error().text();
  }

  ScratchDirectory scratch_;
};

TEST_F(QueryOfThreeRuns, GivesNumbersTextsAndNothing) {
  const Answer kept =
      ask("SELECT world, seed, success, path_length_m, wall_s FROM runs ORDER BY seed, world");

  EXPECT_EQ(kept.columns,
            (std::vector<std::string>{"world", "seed", "success", "path_length_m", "wall_s"}));
  ASSERT_EQ(kept.rows.size(), 3u);
  EXPECT_EQ(kept.rows[0],
            (std::vector<Cell>{std::string("a"), std::int64_t{1}, std::int64_t{1}, 12.5, 0.25}));
  EXPECT_EQ(kept.rows[1],
            (std::vector<Cell>{std::string("b"), std::int64_t{1}, Cell(), Cell(), Cell()}));
  EXPECT_EQ(kept.rows[2],
            (std::vector<Cell>{std::string("b"), std::int64_t{2}, std::int64_t{0}, 8.0, Cell()}));
}

TEST_F(QueryOfThreeRuns, KnowsSqlitesFunctions) {
  const Answer kept =
      ask("WITH alarms AS (SELECT json_extract(value, '$.alarms') AS n FROM runs, "
          "json_each(detectors)) SELECT sum(n), x'0aff' FROM alarms;  ");

  ASSERT_EQ(kept.rows.size(), 1u);
  EXPECT_EQ(kept.rows[0], (std::vector<Cell>{std::int64_t{4}, std::string("0aff")}));
}

TEST_F(QueryOfThreeRuns, FollowsResultsThatHaveChanged) {
  EXPECT_EQ(ask("SELECT count(*) FROM runs").rows[0][0], Cell(std::int64_t{3}));
  const auto made = std::filesystem::last_write_time(scratch_.file(kDatabaseFile));
  ask("SELECT 1");
  EXPECT_EQ(std::filesystem::last_write_time(scratch_.file(kDatabaseFile)), made);

  write({line("a", 1, "true", "1")});

  EXPECT_EQ(ask("SELECT count(*) FROM runs").rows[0][0], Cell(std::int64_t{1}));
}

TEST_F(QueryOfThreeRuns, MakesADamagedDatabaseAgain) {
  write_bytes(scratch_.file(kDatabaseFile), "no database, by far");

  EXPECT_EQ(ask("SELECT count(*) FROM runs").rows[0][0], Cell(std::int64_t{3}));
}

TEST_F(QueryOfThreeRuns, RefusesWithThePlace) {
  expect_refused("SELECT world\nFROM runs WHERE suces = 1",
                 "SQL:2:17: no such column: suces; 'runs' has graph, variant, family, world");
  expect_refused("SELECT * FROM run", "SQL: no such table: run; the one table is 'runs'");
  expect_refused("SELEC 1", "SQL:1:1: near \"SELEC\": syntax error");
  expect_refused("SELECT (1", "SQL: incomplete input");
  expect_refused(" ; ", "SQL: is empty; expected a SELECT");
  expect_refused("SELECT 1;\nSELECT 2", "SQL:2:1: found a second statement; one is allowed");
}

TEST_F(QueryOfThreeRuns, RefusesToWriteAndToReachOtherFiles) {
  for (const char* sql :
       {"DELETE FROM runs", "UPDATE runs SET seed = 1", "INSERT INTO runs (seed) VALUES (1)",
        "DROP TABLE runs", "CREATE TABLE t (x)", "ATTACH '/tmp/other.sqlite' AS other",
        "PRAGMA journal_mode = OFF", "VACUUM INTO '/tmp/copy.sqlite'", "BEGIN"}) {
    expect_refused(sql, "SQL: a query reads 'runs' only");
  }
  EXPECT_EQ(ask("SELECT count(*) FROM runs").rows[0][0], Cell(std::int64_t{3}));
}

TEST_F(QueryOfThreeRuns, RefusesADirectoryWithoutResults) {
  Kept kept;
  const auto done = query_results("/no/such/directory", "SELECT 1", kept);

  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().text(),
            "/no/such/directory/results.jsonl: cannot be read: No such file or directory");
}

TEST_F(QueryOfThreeRuns, RefusesARunThatTheTableCannotHold) {
  write({R"({"graph":"g","variant":"","world":"a","seed":1,"colour":"red"})"});

  expect_refused("SELECT 1", "a run has a key that 'runs' has no column for");
}

TEST_F(QueryOfThreeRuns, TakesRunsWhoseCoverageWasCounted) {
  write({R"({"graph":"g","world":"a","coverage":[{"of":"rules","decided":{"1":7}}]})"});

  EXPECT_EQ(ask("SELECT c.value ->> '$.decided.1' FROM runs, json_each(coverage) AS c").rows[0][0],
            Cell(std::int64_t{7}));
}

TEST(RunsTable, HasNoColumnTwice) {
  std::vector<std::string> names;
  for (const Column& column : runs_columns()) {
    EXPECT_EQ(std::find(names.begin(), names.end(), column.name), names.end()) << column.name;
    names.emplace_back(column.name);
  }
}

}  // namespace
}  // namespace clew::query
