// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_results.hpp"
#include "bench/statistics.hpp"

namespace clew::bench {

/// Which runs a cell of a table, or a point of a chart, is about.
struct CellRuns {
  /// What of the runs that the rest names.
  enum class Only : std::uint8_t { kAll, kCollided, kHit, kStopped };

  std::optional<std::size_t> variant;  ///< none: all
  std::string family;                  ///< empty: all
  /// Of worlds that can be solved, cannot, or do not say; none: all.
  std::optional<std::optional<bool>> solvable;
  Only only = Only::kAll;

  /// False of a cell that has none, as the head of a row.
  bool any() const { return variant || !family.empty() || solvable || only != Only::kAll; }
};

/// A table of a report, cells as text.
struct Table {
  std::string title;
  std::string note;  ///< how to read it; may be empty
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  /// Of each cell its runs; the rows may be shorter, and missing.
  std::vector<std::vector<CellRuns>> runs{};
};

/// A number of each variant, with its 95 % interval if there is one.
struct Chart {
  struct Point {
    std::string label;
    double value = 0.0;
    std::optional<Interval> interval;
    CellRuns runs;
  };

  std::string title;
  std::string note;
  std::string unit;                ///< of the axis
  std::optional<Interval> axis{};  ///< from end to end; none: as the numbers have it
  std::vector<Point> points;
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

/// The same runs as in the tables: success, and paths over shortest paths; none of nothing.
std::vector<Chart> charts_of(const BenchResults& results);

}  // namespace clew::bench
