// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// `page` with the tables and charts of a bench, all of its runs, and its pictures, which lie in
/// `directory`: one file that needs neither server nor network. Runs that were kept are linked.
core::Result<std::string> bench_page(std::string_view page, const BenchResults& results,
                                     const Report& report, const std::vector<KeptRun>& kept,
                                     const std::string& directory);

}  // namespace clew::bench
