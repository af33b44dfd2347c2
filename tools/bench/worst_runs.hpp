// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/kept_runs.hpp"
#include "bench/report.hpp"
#include "bench/summary.hpp"
#include "runtime/config_source.hpp"
#include "runtime/stage.hpp"

namespace clew::bench {

/// Which of a variant's runs, at least one, is the worst: one that collided, else one without
/// success, else any. Among those the longest over the shortest path, or, where one of them does
/// not know its shortest path, the longest; of equal ones the first.
std::size_t worst_of(const std::vector<const RunResult*>& runs);

/// Of each variant the worst run, drawn to `<directory>/pictures/` from its recording: one that is
/// kept, else it runs once more. At most a dozen, the first variants'.
core::Result<std::vector<Picture>> draw_worst_runs(const BenchResults& results,
                                                   const runtime::ConfigPath& configs,
                                                   const std::vector<runtime::StageInfo>& stages,
                                                   const std::string& directory,
                                                   const std::vector<KeptRun>& kept);

}  // namespace clew::bench
