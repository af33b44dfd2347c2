// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/bench_results.hpp"

namespace clew::bench {

/// A table of a report, cells as text.
struct Table {
  std::string title;
  std::string note;  ///< how to read it; may be empty
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// In all tables, runs that equal each other to the byte count once (BenchResults::samples_of).
///
/// A share with its Wilson interval: `11/12 92 % [65, 99]`.
std::string share_text(std::size_t successes, std::size_t trials);

/// Median and 90 % quantile, `1.27, 2.13`, by the format of a number; empty without values.
std::string quantiles_text(const std::vector<double>& values, const char* format);

/// A row a variant, over all worlds: success, collisions, path lengths, time.
Table overall_table(const BenchResults& results);

/// A row a family, a column a variant: success.
Table family_table(const BenchResults& results);

/// A row a variant: success with the interval that holds although the bench looked at its results
/// and ended when they were known well enough.
Table sequential_table(const BenchResults& results);

/// A row a variant and detector, in command or in shadow: traps noticed, delays, false alarms.
Table detector_table(const BenchResults& results);

/// A table a graph, if exactly two things are varied: success in solvable worlds over both.
std::vector<Table> matrix_tables(const BenchResults& results);

}  // namespace clew::bench
