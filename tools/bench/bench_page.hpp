// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bench/kept_runs.hpp"
#include "bench/report.hpp"

namespace clew::bench {

/// The pages that a build has; empty in one without npm.
struct Pages {
  std::string_view bench{};  ///< shows a bench
  std::string_view run{};    ///< shows a recording
};

/// More runs than these a browser takes long to open, and nobody looks at.
inline constexpr std::size_t kMostRunsOnPage = 20000;

/// Those that a page lists, in their order: all, or of many `most`, first those that were kept,
/// then those that failed, then others as they come.
std::vector<std::size_t> runs_on_page(const BenchResults& results, const std::vector<KeptRun>& kept,
                                      std::size_t most);

/// `page` with the tables and charts of a bench, its runs (kMostRunsOnPage at most; the page says
/// so), and its pictures, which lie in `directory`: one file that needs neither server nor network.
/// Runs that were kept are linked.
core::Result<std::string> bench_page(std::string_view page, const BenchResults& results,
                                     const Report& report, const std::vector<KeptRun>& kept,
                                     const std::string& directory);

}  // namespace clew::bench
