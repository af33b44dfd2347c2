// SPDX-License-Identifier: Apache-2.0
/// How often each rule, table cell, neuron and case decided in a bench, and which never did.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/summary.hpp"
#include "core/result.hpp"
#include "insides/decisions.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bench {

/// What decided in a recorded run, by stage: every component of ours is fed with it again, and
/// tells its inside at each tick. Rules are named as `clew rules` says them.
core::Result<std::vector<CoveredChoice>> coverage_of(const bridge::RunRecording& recording,
                                                     const runtime::RunPlan& plan);

/// As it stands in a run's line, and back.
nlohmann::ordered_json to_json(const std::vector<CoveredChoice>& coverage);
std::vector<CoveredChoice> read_coverage(const nlohmann::json& json);

/// A row a variant and choice: how many cases decided, which decided most, which never did. Runs
/// that equal each other to the byte count once.
Table coverage_table(const BenchResults& results);

/// A line a variant, choice and case.
std::string coverage_csv(const BenchResults& results);

}  // namespace clew::bench
