// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_results.hpp"
#include "runtime/config_source.hpp"
#include "runtime/stage.hpp"

namespace clew::bench {

/// A run of which a recording was kept.
struct KeptRun {
  std::size_t index = 0;  ///< in BenchResults::runs
  std::string recording;  ///< a file, relative to the bench's directory
  std::string report;     ///< the same with the page that shows it; empty without a page
};

/// All of them, in the bench's order.
struct KeptRuns {
  int interrupted_by = 0;  ///< a signal; then the rest is empty
  std::vector<KeptRun> runs;
};

/// What of a bench's runs is kept, and how.
struct KeepOptions {
  std::size_t most = 0;     ///< recordings
  std::size_t jobs = 1;     ///< worker processes
  std::string_view page{};  ///< of `clew view`, for reports; empty: recordings only
};

/// How bad the end of a run is: 2 if it collided, 1 without success, else 0.
int badness(const RunResult& run);

/// The runs to keep: of those that failed, the worst of each variant, then the second worst of
/// each, and so on. Runs that are equal to the byte count once.
std::vector<std::size_t> failed_runs(const BenchResults& results, std::size_t most);

/// Runs those that failed once more, with a recording each, in `<directory>/runs/`. A recording
/// holds the same run to the bit, so nothing needs to be recorded before it is known to have
/// failed.
core::Result<KeptRuns> keep_failed_runs(const BenchResults& results,
                                        const runtime::ConfigPath& configs,
                                        const std::vector<runtime::StageInfo>& stages,
                                        const std::string& directory, const KeepOptions& options);

}  // namespace clew::bench
