// SPDX-License-Identifier: Apache-2.0
#include "mission.hpp"

#include <gtest/gtest.h>

#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::stages {

runtime::ConfigPath shipped_configs() {
  return runtime::ConfigPath({tests::source_path("configs")});
}

std::vector<std::string> shipped_graphs() { return shipped_configs().names("graphs"); }

Mission::Mission(const std::string& graph, const std::string& world,
                 const std::vector<std::string>& with, const std::vector<std::string>& set)
    : contract::Mission(
          contract::Mission::create(shipped_configs(), graph, world, with, set).value()) {}

std::string Mission::refusal(const std::string& graph, const std::string& world,
                             const std::vector<std::string>& with) {
  runtime::GraphOverrides overrides;
  overrides.world = world;
  overrides.with = with;
  const auto plan = runtime::prepare_run(graph, overrides, shipped_configs(), all());
  return plan.ok() ? std::string() : plan.error().text();
}

void Mission::load(const Saved& saved) {
  const auto loaded = contract::Mission::load(saved);
  EXPECT_TRUE(loaded.ok()) << loaded.error().text();
}

}  // namespace clew::stages
