// SPDX-License-Identifier: Apache-2.0
#include "bench/groups.hpp"

#include <gtest/gtest.h>

#include "bench/report.hpp"

namespace clew::bench {
namespace {

/// One graph in six worlds, from easy to hopeless, and one in which something moves for ever.
class Groups : public testing::Test {
 protected:
  Groups() {
    plan_.suite = "test";
    plan_.configuration["max_ticks"] = "100";
    plan_.seeds = {1};
    plan_.variants = {{"g", {}, {}}};
    add("open", "reached", RunResult::Severity{0.0, 0, 0.0, 40.0, 10.0}, 11.0);
    add("shallow", "reached", RunResult::Severity{0.49, 1, 0.0, 40.0, 20.0}, 15.0);
    add("middle", "reached", RunResult::Severity{0.5, 1, 0.2, 40.0, 20.0}, 30.0);
    add("deep", "timeout", RunResult::Severity{2.0, 5, 1.0, 40.0, 20.0}, 300.0);
    add("closed", "unreachable", RunResult::Severity{std::nullopt, 1, std::nullopt, 40.0, 20.0},
        60.0);
    add("moving", "reached", std::nullopt, 12.0);
    results_.plan = &plan_;
  }

  void add(const std::string& world, const std::string& outcome,
           const std::optional<RunResult::Severity>& severity, double path_m) {
    plan_.worlds.push_back({world == "open" ? "free" : "trap", world, {}});
    RunResult run;
    run.key = {"g", "", world, 1};
    run.family = plan_.worlds.back().family;
    run.outcome = outcome;
    run.solvable = world != "closed";
    run.success = outcome != "timeout";
    run.path_length_m = path_m;
    if (*run.solvable) run.shortest_path_m = 10.0;
    run.severity = severity;
    results_.runs.push_back(run);
  }

  std::vector<std::string> names(Grouping grouping) const {
    std::vector<std::string> found;
    for (const Group& group : groups_of(results_, grouping)) found.push_back(group.name);
    return found;
  }

  BenchPlan plan_;
  BenchResults results_;
};

using Names = std::vector<std::string>;

TEST_F(Groups, AreInTheOrderOfSeverityAndTheUnknownIsLast) {
  EXPECT_EQ(names(Grouping::kSeverity),
            (Names{"0", "below 0.5", "0.5 to 1", "2 to 4", "no way out", "unknown"}));
  EXPECT_EQ(names(Grouping::kNesting), (Names{"0", "1", "4 and more", "unknown"}));
  EXPECT_EQ(names(Grouping::kBacktrack), (Names{"0", "below 0.5", "1 to 2", "no way", "unknown"}));
  EXPECT_EQ(names(Grouping::kFamily), (Names{"free", "trap"}));
}

TEST_F(Groups, TellPathLengthsBesideTheBounds) {
  const auto groups = groups_of(results_, Grouping::kBacktrack);

  // Open and shallow: both arrived, the open one by a longer way than Bug2 takes at most.
  EXPECT_EQ(groups[0].worlds, 2u);
  EXPECT_EQ(groups[0].path_ratios, (std::vector<double>{1.1, 1.5}));
  EXPECT_EQ(groups[0].bug1_ratios, (std::vector<double>{4.0, 4.0}));
  EXPECT_EQ(groups[0].bug2_ratios, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(groups[0].arrived, 2u);
  EXPECT_EQ(groups[0].above_bug1, 0u);
  EXPECT_EQ(groups[0].above_bug2, 1u);
  // The timeout went 300 m, and did not arrive.
  EXPECT_EQ(groups[2].arrived, 0u);
  EXPECT_EQ(groups[2].successes, 0u);
  EXPECT_EQ(groups[2].known, 1u);
}

TEST_F(Groups, CountEqualRunsOnceButAllWorlds) {
  plan_.seeds = {1, 2};
  std::vector<RunResult> twice;
  for (const RunResult& run : results_.runs) {
    for (const std::uint64_t seed : plan_.seeds) {
      twice.push_back(run);
      twice.back().key.seed = seed;
      twice.back().hash = run.key.world;
    }
  }
  results_.runs = twice;

  const auto groups = groups_of(results_, Grouping::kFamily);

  EXPECT_EQ(groups[1].worlds, 5u);
  EXPECT_EQ(groups[1].known, 5u);
}

TEST_F(Groups, AreATableAndLinesOfJson) {
  const Table table = group_table(results_, Grouping::kSeverity);
  const auto lines = group_lines(results_, Grouping::kSeverity);

  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(table.rows[2], (Names{"0.5 to 1", "g", "1", "1/1 100 % [21, 100]", "3.00, 3.00",
                                  "4.00, 4.00", "2.00, 2.00", "0 of 1", "1 of 1"}));
  EXPECT_EQ(table.rows[4],
            (Names{"no way out", "g", "1", "1/1 100 % [21, 100]", "", "", "", "", ""}));
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[3],
            R"({"by":"severity","group":"2 to 4","graph":"g","variant":"","worlds":1,"known":1,)"
            R"("successes":0,"success_interval":[0.0,0.7934506856227626],"path_ratio":null,)"
            R"("bug1_ratio":null,"bug2_ratio":null,"arrived":0,"above_bug1":0,"above_bug2":0})");
}

TEST_F(Groups, OfAReportAreThoseThatWereAskedFor) {
  const auto titles = [&] {
    Names found;
    for (const Table& table : make_report(results_, {}).tables) found.push_back(table.title);
    return found;
  };
  const Names by_default = titles();
  plan_.by = {Grouping::kNesting, Grouping::kBacktrack};
  const Names asked_for = titles();

  EXPECT_EQ(by_default, (Names{"All worlds", "Success by family",
                               "By the depth of the deepest trap, in sensing ranges", "Detectors",
                               "Path lengths beside the bounds of Bug algorithms"}));
  EXPECT_EQ(asked_for, (Names{"All worlds", "By the number of nested pockets",
                              "By the necessary backtrack, in sensing ranges", "Success by family",
                              "Detectors", "Path lengths beside the bounds of Bug algorithms"}));
  EXPECT_EQ(make_report(results_, {}).asked_for, 3u);
}

TEST_F(Groups, WithoutBoundsThereIsNoTableOfThem) {
  for (RunResult& run : results_.runs) run.severity = std::nullopt;

  EXPECT_TRUE(bug_table(results_).rows.empty());
}

TEST(Grouping, IsReadByItsName) {
  for (const GroupingName& known : kGroupings) {
    const auto read = read_grouping(known.name);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, known.grouping);
  }
  EXPECT_EQ(
      read_grouping("severty").error().message,
      "unknown grouping 'severty' (did you mean 'severity'?); allowed: family, severity, nesting, "
      "backtrack");
}

}  // namespace
}  // namespace clew::bench
