// SPDX-License-Identifier: Apache-2.0
/// The build of the unit tests, with sanitizers in tools/test, gives the bytes of the Release
/// build: those of the table of hashes, and those of recordings of earlier versions.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "recorded_run.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "run/composed_run.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::replay_test {
namespace {

using bridge::RunRecording;

constexpr std::size_t kRowsForAGraph = 3;  ///< the shortest

struct Row {
  std::string graph;
  std::string world;
  std::string outcome;
  std::uint64_t ticks = 0;
  std::string hash;
};

std::vector<Row> table() {
  std::ifstream file(tests::source_path("tests/golden/hashes.txt"));
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    Row row;
    words >> row.graph >> row.world >> row.outcome >> row.ticks >> row.hash;
    EXPECT_FALSE(words.fail()) << line;
    rows.push_back(row);
  }
  return rows;
}

/// The shortest rows of each graph that run for a while.
std::vector<Row> shortest_rows() {
  constexpr std::uint64_t kFewestTicks = 20;
  std::vector<Row> rows = table();
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.ticks < b.ticks; });
  std::map<std::string, std::size_t> taken;
  std::vector<Row> shortest;
  for (const Row& row : rows) {
    if (row.ticks < kFewestTicks || taken[row.graph] == kRowsForAGraph) continue;
    ++taken[row.graph];
    shortest.push_back(row);
  }
  return shortest;
}

class RowOfTheTable : public testing::TestWithParam<Row> {};

TEST_P(RowOfTheTable, HasItsHashInThisBuild) {
  constexpr std::uint64_t kMostTicks = 2000;  // as tools/hashes
  const Row& row = GetParam();

  const auto report =
      bridge::run_composed(plan_of(row.graph, in_world(row.world, kMostTicks)), {}, nullptr, {});

  ASSERT_TRUE(report.ok()) << report.error().text();
  ASSERT_TRUE(report->hash.has_value());
  EXPECT_EQ(report->hash->hex(), row.hash);
}

INSTANTIATE_TEST_SUITE_P(Shortest, RowOfTheTable, testing::ValuesIn(shortest_rows()),
                         [](const auto& instance) {
                           std::string name = instance.param.graph + '_' + instance.param.world;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

std::vector<std::string> golden_recordings() {
  std::vector<std::string> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(tests::source_path("tests/golden"))) {
    if (entry.path().extension() == ".mcap") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

class GoldenRecording : public testing::TestWithParam<std::string> {};

TEST_P(GoldenRecording, ReplaysToTheByteInThisBuild) {
  const RunRecording recording = open_recording(GetParam());
  const auto plan = bridge::recorded_plan(recording, stages::all());
  ASSERT_TRUE(plan.ok()) << plan.error().text();

  for (const auto& stage : plan->graph.stages) {
    const auto report = bridge::replay_component(recording, *plan, stage.info->name, {});

    ASSERT_TRUE(report.ok()) << stage.info->name << ": " << report.error().text();
    EXPECT_TRUE(report->identical()) << stage.info->name;
    EXPECT_EQ(report->ticks, recording.end()->ticks) << stage.info->name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, GoldenRecording, testing::ValuesIn(golden_recordings()),
                         [](const auto& instance) {
                           return std::filesystem::path(instance.param).stem().string();
                         });

}  // namespace
}  // namespace clew::replay_test
