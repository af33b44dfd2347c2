// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/report.hpp"
#include "bench/summary.hpp"
#include "runtime/config_source.hpp"
#include "runtime/stage.hpp"

namespace clew::bench {

/// Of each variant the worst run (one that collided, else one without success, else the longest
/// over the shortest path; of equal ones the first), run once more and drawn to
/// `<directory>/pictures/`. At most a dozen, the first variants'.
core::Result<std::vector<Picture>> draw_worst_runs(const BenchResults& results,
                                                   const runtime::ConfigPath& configs,
                                                   const std::vector<runtime::StageInfo>& stages,
                                                   const std::string& directory);

}  // namespace clew::bench
