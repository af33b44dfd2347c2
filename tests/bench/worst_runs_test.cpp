// SPDX-License-Identifier: Apache-2.0
#include "bench/worst_runs.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "bench/run_result.hpp"
#include "bench/world_names.hpp"

namespace clew::bench {
namespace {

/// The index of the worst of runs with these outcomes, path lengths and shortest paths.
struct Driven {
  bool success;
  double path_m;
  std::optional<double> shortest_m;
  std::uint32_t collisions = 0;
};

std::size_t worst(const std::vector<Driven>& driven) {
  std::vector<RunResult> runs;
  for (const Driven& each : driven) {
    RunResult run;
    run.outcome = each.success ? "reached" : "timeout";
    run.success = each.success;
    run.path_length_m = each.path_m;
    run.shortest_path_m = each.shortest_m;
    run.collisions = each.collisions;
    runs.push_back(run);
  }
  std::vector<const RunResult*> pointers;
  for (const RunResult& run : runs) pointers.push_back(&run);
  return worst_of(pointers);
}

TEST(WorstRun, IsTheLongestOverTheShortestPath) {
  EXPECT_EQ(worst({{true, 12.0, 10.0}, {true, 9.0, 3.0}, {true, 20.0, 15.0}}), 1u);
}

TEST(WorstRun, IsTheLongestWhereShortestPathsAreUnknown) {
  EXPECT_EQ(worst({{true, 18.7, std::nullopt}, {true, 48.1, std::nullopt}, {true, 9.0, 3.0}}), 1u);
}

TEST(WorstRun, FailedAndAmongThoseCollided) {
  EXPECT_EQ(worst({{true, 90.0, 10.0}, {false, 20.0, std::nullopt}, {false, 30.0, 2.0}}), 2u);
  EXPECT_EQ(worst({{false, 90.0, 10.0}, {true, 5.0, 5.0, 1}, {true, 5.0, 5.0}}), 1u);
}

TEST(WorstRun, IsTheFirstOfEqualOnes) {
  EXPECT_EQ(worst({{true, 5.0, 5.0}, {true, 5.0, 5.0}}), 0u);
}

TEST(FileName, OfAWorldStaysInItsFolder) {
  EXPECT_EQ(file_name_of("u-trap"), "u-trap");
  EXPECT_EQ(file_name_of("/home/me/my world.yaml"), "-home-me-my-world.yaml");
  EXPECT_EQ(file_name_of("../../etc/passwd"), "-.-..-etc-passwd");
  EXPECT_EQ(file_name_of(".."), "-.");
  EXPECT_EQ(file_name_of(std::string(5000, 'a')).size(), 120u);
}

TEST(RunResult, RefusesALineThatIsNone) {
  const auto result = read_run_result(R"({"graph": "g"})");

  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().text().find("is no line of results"), std::string::npos);
}

}  // namespace
}  // namespace clew::bench
