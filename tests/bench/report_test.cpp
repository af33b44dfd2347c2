// SPDX-License-Identifier: Apache-2.0
#include "bench/report.hpp"

#include <gtest/gtest.h>

#include "bench/bench_page.hpp"
#include "bench/kept_runs.hpp"
#include "bench/pairs.hpp"
#include "bench/run_result.hpp"

namespace clew::bench {
namespace {

/// Two variants in two worlds, a solvable and an unsolvable one.
class ReportOfFourRuns : public testing::Test {
 protected:
  ReportOfFourRuns() {
    plan_.suite = "test";
    plan_.configuration["max_ticks"] = "100";
    plan_.seeds = {1};
    plan_.worlds = {{"open", "field", {}}, {"closed", "box", {}}};
    plan_.variants = {{"good", {}, {}}, {"bad", {}, {}}};
    results_.plan = &plan_;
    results_.runs = {run("good", "field", "reached", true, true, 12.0),
                     run("good", "box", "unreachable", false, true, 30.0),
                     run("bad", "field", "reached", true, true, 15.0),
                     run("bad", "box", "timeout", false, false, 50.0)};
    results_.runs[0].detectors = {{"revisit", false, 3, 1, 1, {4.0}, {2.0}}};
    results_.runs[0].captures = 2;
    results_.runs[3].collisions = 2;
  }

  static RunResult run(const std::string& graph, const std::string& world,
                       const std::string& outcome, bool solvable, bool success, double path_m) {
    RunResult run;
    run.key = {graph, "", world, 1};
    run.family = world == "field" ? "open" : "closed";
    run.outcome = outcome;
    run.solvable = solvable;
    run.success = success;
    run.path_length_m = path_m;
    if (solvable) run.shortest_path_m = 10.0;
    run.sim_time_s = 9.0;
    return run;
  }

  BenchPlan plan_;
  BenchResults results_;
};

TEST_F(ReportOfFourRuns, CountsSuccessApartForSolvableAndUnsolvable) {
  const Table table = overall_table(results_);

  ASSERT_EQ(table.rows.size(), 2u);
  // Wilson intervals of 2 of 2, 1 of 1, 1 of 2 and 0 of 1.
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"good", "2/2 100 % [34, 100]",
                                                     "1/1 100 % [21, 100]", "1/1 100 % [21, 100]",
                                                     "", "0", "0", "0", "1.20, 1.20", "9, 9"}));
  EXPECT_EQ(table.rows[1][1], "1/2 50 % [9, 91]");
  EXPECT_EQ(table.rows[1][3], "0/1 0 % [0, 79]");
  EXPECT_EQ(table.rows[1][5], "2");
}

TEST_F(ReportOfFourRuns, OfManyRunsAPageListsTheKeptAndTheFailedFirst) {
  const std::vector<KeptRun> kept = {{2, "runs/b.mcap", "runs/b.html"}};

  EXPECT_EQ(runs_on_page(results_, kept, 10), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(runs_on_page(results_, kept, 1), (std::vector<std::size_t>{2}));
  EXPECT_EQ(runs_on_page(results_, kept, 2), (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(runs_on_page(results_, kept, 3), (std::vector<std::size_t>{0, 2, 3}));
}

TEST_F(ReportOfFourRuns, APageOfVeryManyRunsStaysSmall) {
  const std::vector<RunResult> few = results_.runs;
  plan_.seeds.resize(kMostRunsOnPage);
  results_.runs.assign(kMostRunsOnPage, few[0]);
  for (std::size_t i = 1; i < few.size(); ++i) {
    results_.runs.insert(results_.runs.end(), kMostRunsOnPage, few[i]);
  }
  for (std::size_t i = 0; i < results_.runs.size(); ++i) {
    results_.runs[i].key.seed = i;
    results_.runs[i].hash = std::to_string(i * 0x9e3779b97f4a7c15u);
  }

  const auto page = bench_page("<html><!-- recordings --></html>", results_, Report{}, {}, "");

  ASSERT_TRUE(page.ok()) << page.error().text();
  EXPECT_LT(page->size(), 4u << 20);
}

TEST_F(ReportOfFourRuns, TellsFamiliesApart) {
  const Table table = family_table(results_);

  EXPECT_EQ(table.columns, (std::vector<std::string>{"family", "good", "bad"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"closed", "1/1 100 % [21, 100]", "0/1 0 % [0, 79]"}));
}

TEST_F(ReportOfFourRuns, TellsWhatDetectorsNoticed) {
  const Table table = detector_table(results_);

  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"good", "revisit", "2", "1", "0", "1",
                                                     "4.0, 4.0", "2.0, 2.0"}));
}

TEST_F(ReportOfFourRuns, ComparesPairs) {
  const Table table = paired_table(results_);

  // One pair differs, in favour of the first; 15 m over 12 m and 9 s each where both arrived.
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"bad", "good", "0", "1", "1", "1.250 of 1", "1.250", "1.250",
                                      "1.000 of 1", "1.000", "1.000"}));
}

TEST_F(ReportOfFourRuns, ComparesEachGraphWithTheFirstWhereTheSameIsVaried) {
  plan_.variants = {{"rival", {{"sense", "cones"}}, {}},
                    {"rival", {{"sense", "laser"}}, {}},
                    {"own", {{"sense", "cones"}}, {}},
                    {"own", {{"sense", "laser"}}, {}}};
  const std::vector<RunResult> once = results_.runs;
  results_.runs.insert(results_.runs.end(), once.begin(), once.end());
  results_.runs[4].path_length_m = 6.0;  // own with cones, over 12 m of the rival
  results_.runs[6].sim_time_s = 4.5;     // own with the laser, over 9 s

  const Table table = paired_graphs_table(results_);

  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][0], "own [sense=cones]");
  EXPECT_EQ(table.rows[0][1], "rival [sense=cones]");
  EXPECT_EQ(table.rows[0][5], "0.500 of 1");
  EXPECT_EQ(table.rows[1][0], "own [sense=laser]");
  EXPECT_EQ(table.rows[1][1], "rival [sense=laser]");
  EXPECT_EQ(table.rows[1][8], "0.500 of 1");
}

TEST_F(ReportOfFourRuns, ComparesNoGraphsWhereNothingIsVariedOrThereIsOneOnly) {
  EXPECT_TRUE(paired_graphs_table(results_).rows.empty());

  plan_.variants = {{"own", {{"sense", "cones"}}, {}}, {"own", {{"sense", "laser"}}, {}}};
  EXPECT_TRUE(paired_graphs_table(results_).rows.empty());
}

TEST_F(ReportOfFourRuns, ComparesValuesOfWhatIsVariedLastWithAllElseEqual) {
  plan_.variants = {{"g", {{"sense", "cones"}, {"escape", "a"}}, {}},
                    {"g", {{"sense", "cones"}, {"escape", "b"}}, {}},
                    {"g", {{"sense", "laser"}, {"escape", "a"}}, {}},
                    {"g", {{"sense", "laser"}, {"escape", "b"}}, {}}};
  const std::vector<RunResult> once = results_.runs;
  results_.runs.insert(results_.runs.end(), once.begin(), once.end());

  const Table table = paired_table(results_);

  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][0], "g [sense=cones escape=b]");
  EXPECT_EQ(table.rows[0][1], "g [sense=cones escape=a]");
  EXPECT_EQ(table.rows[1][0], "g [sense=laser escape=b]");
  EXPECT_EQ(table.rows[1][1], "g [sense=laser escape=a]");
}

TEST_F(ReportOfFourRuns, GivesWorldsThatDoNotSayWhetherTheyCanBeSolvedARowOfTheirOwn) {
  for (RunResult& run : results_.runs) {
    if (run.key.world == "box") run.solvable = std::nullopt;
  }
  results_.runs[1].success = std::nullopt;  // who knows whether `unreachable` is true
  plan_.worlds[1].family = "open";
  for (RunResult& run : results_.runs) run.family = "open";

  const Table table = overall_table(results_);
  const Table families = family_table(results_);

  EXPECT_EQ(table.rows[0][1], "1/1 100 % [21, 100]");
  EXPECT_EQ(table.rows[0][2], "1/1 100 % [21, 100]");
  EXPECT_EQ(table.rows[0][3], "");
  EXPECT_EQ(table.rows[0][4], "0/1 0 % [0, 79]");
  EXPECT_EQ(table.rows[1][1], "1/2 50 % [9, 91]");
  EXPECT_EQ(families.rows, (std::vector<std::vector<std::string>>{
                               {"open", "1/1 100 % [21, 100]", "1/1 100 % [21, 100]"},
                               {"open (solvable: unknown)", "", "0/1 0 % [0, 79]"}}));
  EXPECT_EQ(remarks_on(results_),
            (std::vector<std::string>{
                "1 of 2 worlds do not say whether they can be solved (box): they stand apart, and "
                "'unreachable' there is neither a success nor a failure."}));
}

/// As ReportOfFourRuns, with three seeds; without noise, `good` does the same with each of them.
class ReportOfThreeSeeds : public ReportOfFourRuns {
 protected:
  ReportOfThreeSeeds() {
    plan_.seeds = {1, 2, 3};
    const std::vector<RunResult> once = results_.runs;
    results_.runs.clear();
    for (const RunResult& run : once) {
      for (const std::uint64_t seed : plan_.seeds) {
        results_.runs.push_back(run);
        results_.runs.back().key.seed = seed;
        results_.runs.back().hash =
            run.key.graph + (run.key.graph == "good" ? "" : std::to_string(seed));
      }
    }
  }
};

TEST_F(ReportOfThreeSeeds, CountsEqualRunsOnce) {
  const Table table = overall_table(results_);

  EXPECT_EQ(table.rows[0][1], "2/2 100 % [34, 100]");
  EXPECT_EQ(table.rows[0][2], "1/1 100 % [21, 100]");
  EXPECT_EQ(table.rows[1][1], "3/6 50 % [19, 81]");
  EXPECT_EQ(detector_table(results_).rows[0][2], "2");
  EXPECT_EQ(family_table(results_).rows[1][1], "1/1 100 % [21, 100]");
}

TEST_F(ReportOfThreeSeeds, SaysWhatWasMergedAndWhereSeedsDoNotMatter) {
  const Report report = make_report(results_, {});

  ASSERT_EQ(report.remarks.size(), 2u);
  EXPECT_EQ(report.remarks[0],
            "4 of 12 runs equal another one of the same graph in the same world to the byte (they "
            "have one hash): they are one sample, and counted once.");
  EXPECT_EQ(report.remarks[1].substr(0, 40), "Seeds make no difference to good: no noi");
  EXPECT_NE(to_markdown(report).find(report.remarks[0]), std::string::npos);
  EXPECT_NE(to_html(report).find("they are one sample"), std::string::npos);
}

TEST_F(ReportOfThreeSeeds, ComparesAPairOfEqualRunsOnce) {
  for (RunResult& run : results_.runs) run.hash = run.key.graph;

  const Table table = paired_table(results_);

  EXPECT_EQ(table.rows[0][3], "1");
  EXPECT_EQ(table.rows[0][5], "1.250 of 1");
}

TEST_F(ReportOfThreeSeeds, SeedsMatterIfOneOfTheRunsDiffers) {
  results_.runs[4].hash = "another";

  EXPECT_FALSE(results_.ignores_seeds(0));
  EXPECT_EQ(results_.samples_of(0).size(), 3u);
}

TEST_F(ReportOfFourRuns, HasARowOfCsvForARun) {
  results_.runs[3].severity = RunResult::Severity{1.5, 2, 0.25, 40.0, 30.0};

  const std::string header = csv_header();
  const std::string row = csv_row(results_.runs[3]);

  EXPECT_EQ(row,
            "bad,,closed,box,1,timeout,false,false,0,9.0000,50.0000,,,1.5000,2,0.2500,40.0000,30."
            "0000,2,0,"
            "0,,false,0,0,\n");
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
}

TEST_F(ReportOfFourRuns, EscapesWhatMarkupWouldTake) {
  plan_.about = "a < b | c & \"d\"";
  const Report report = make_report(results_, {{"pictures/<1>.svg", "worst | of all"}});

  EXPECT_NE(to_html(report).find("a &lt; b | c &amp; &quot;d&quot;"), std::string::npos);
  EXPECT_NE(to_html(report).find("src=\"pictures/&lt;1&gt;.svg\""), std::string::npos);
  Table table{"t", "", {"x"}, {{"a|b"}}};
  EXPECT_EQ(to_markdown(table), "## t\n\n| x |\n|---|\n| a\\|b |\n");
}

TEST(Matrix, HasARowAndAColumnAVariation) {
  BenchPlan plan;
  plan.seeds = {1};
  plan.worlds = {{"open", "field", {}}};
  BenchResults results{&plan, {}};
  for (const char* detector : {"a", "b"}) {
    for (const char* escape : {"x", "y"}) {
      plan.variants.push_back(
          {"g", {{"recover.detector", detector}, {"recover.escape", escape}}, {}});
      RunResult run;
      run.success = std::string(detector) == "a" && std::string(escape) == "y";
      run.solvable = true;
      results.runs.push_back(run);
    }
  }

  const auto tables = matrix_tables(results);

  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].columns, (std::vector<std::string>{"", "x", "y"}));
  EXPECT_EQ(tables[0].rows[0],
            (std::vector<std::string>{"a", "0/1 0 % [0, 79]", "1/1 100 % [21, 100]"}));
  EXPECT_EQ(tables[0].rows[1][2], "0/1 0 % [0, 79]");
}

TEST_F(ReportOfFourRuns, LeadsFromACellToItsRuns) {
  const Table table = overall_table(results_);

  ASSERT_EQ(table.runs.size(), table.rows.size());
  ASSERT_EQ(table.runs[1].size(), table.columns.size());
  EXPECT_EQ(table.runs[1][2].variant, 1u);
  EXPECT_EQ(table.runs[1][2].solvable, std::optional<std::optional<bool>>(true));
  EXPECT_EQ(table.runs[1][5].only, CellRuns::Only::kCollided);
  EXPECT_EQ(family_table(results_).runs[0][0].family, "open");
  EXPECT_EQ(family_table(results_).runs[0][2].variant, 1u);
}

TEST_F(ReportOfFourRuns, DrawsSharesAndPathsWithTheirIntervals) {
  const std::vector<Chart> charts = charts_of(results_);

  ASSERT_EQ(charts.size(), 2u);
  ASSERT_EQ(charts[0].points.size(), 2u);
  EXPECT_DOUBLE_EQ(charts[0].points[1].value, 0.5);
  EXPECT_DOUBLE_EQ(charts[0].points[1].interval->low, wilson_interval(1, 2).low);
  EXPECT_DOUBLE_EQ(charts[1].points[0].value, 1.2);  // 12 m, where 10 m are the shortest
  EXPECT_FALSE(charts[1].points[0].interval);        // one run has no interval
}

TEST_F(ReportOfFourRuns, HasNoChartOfNothing) {
  for (RunResult& run : results_.runs) run.outcome = "timeout";

  EXPECT_EQ(charts_of(results_).size(), 1u);
}

TEST_F(ReportOfFourRuns, KeepsTheWorstOfEachVariantFirst) {
  EXPECT_EQ(failed_runs(results_, 5), (std::vector<std::size_t>{3}));

  results_.runs[2].success = false;  // 15 m long, without a collision
  results_.runs[1].success = false;
  EXPECT_EQ(failed_runs(results_, 5), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(failed_runs(results_, 2), (std::vector<std::size_t>{1, 3}));
  EXPECT_TRUE(failed_runs(results_, 0).empty());
}

TEST_F(ReportOfFourRuns, KeepsEqualRunsOnce) {
  plan_.seeds = {1, 2};
  const RunResult failed = run("good", "field", "timeout", true, false, 12.0);
  results_.runs.assign(8, failed);
  for (std::size_t i = 0; i < 8; ++i) {
    RunResult& each = results_.runs[i];
    each.key = {i < 4 ? "good" : "bad", "", i / 2 % 2 == 0 ? "field" : "box", 1 + i % 2};
    each.hash = "hash of " + each.key.world;
  }

  EXPECT_EQ(failed_runs(results_, 8), (std::vector<std::size_t>{0, 2, 4, 6}));
}

}  // namespace
}  // namespace clew::bench
