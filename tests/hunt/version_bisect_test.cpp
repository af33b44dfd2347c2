// SPDX-License-Identifier: Apache-2.0
#include "hunt/version_bisect.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

TEST(VersionBisect, RefusesStagesThatShareAProcess) {
  const std::string graph =
      testing::TempDir() + "clew-version-bisect-" + std::to_string(::getpid()) + ".yaml";
  std::ofstream(graph) << "world: u-trap\nrobot: disc-015\n"
                          "sense: {behaviour: cones, process: {group: mind}}\n"
                          "control: {behaviour: krishna_kalra_fuzzy, process: {group: mind}}\n"
                          "drive: {behaviour: turn_then_step}\n";
  const auto plan = runtime::prepare_run(
      graph, {}, runtime::ConfigPath({tests::source_path("configs")}), stages::all());
  std::filesystem::remove(graph);
  ASSERT_TRUE(plan.ok()) << plan.error().text();

  const auto end = bisect_versions(*plan, {"/bin/true", "/bin/true"}, {});

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().text(),
            graph +
                ":3:44: stage 'sense' shares the process 'mind', which has one version as a "
                "whole; --other-version takes graphs in which each stage has its own process");
}

}  // namespace
}  // namespace clew::hunt
