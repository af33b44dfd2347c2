// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "runtime/config_source.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::bridge {

/// A graph of drive, sense and control in a shipped world. `exec`: of control, which then is a
/// third-party component; `beside` stands beside it. `process`: of sense.
inline runtime::RunPlan small_plan(const std::string& exec = {}, const std::string& beside = {},
                                   const std::string& drive = "{behaviour: turn_then_step}",
                                   const std::string& process = "{}") {
  const std::string control =
      exec.empty() ? "{behaviour: krishna_kalra_fuzzy}" : "{exec: [" + exec + ']' + beside + '}';
  const runtime::Bundle bundle = [&] {
    const runtime::ConfigPath shipped({tests::source_path("configs")});
    auto plan = runtime::prepare_run("krishna_kalra", {}, shipped, stages::all());
    EXPECT_TRUE(plan.ok()) << plan.error().text();
    runtime::Bundle files = plan->bundle;
    files["graph.yaml"] =
        "world: world\nrobot: robot\nsense: {behaviour: cones, process: " + process +
        "}\ncontrol: " + control + "\ndrive: " + drive + '\n';
    return files;
  }();
  auto plan = runtime::prepare_run(bundle, stages::all());
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

}  // namespace clew::bridge
