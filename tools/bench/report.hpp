// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/summary.hpp"

namespace clew::bench {

/// A picture of a run, beside the report.
struct Picture {
  std::string file;  ///< relative to the report
  std::string caption;
};

/// What a report says, in order.
struct Report {
  std::string title;
  std::string about;
  std::vector<std::string> remarks;  ///< what a reader must know of the numbers
  std::vector<Table> tables;
  std::size_t asked_for = 1;  ///< the first of them, for the terminal
  bool covers = false;        ///< the last table tells what decided
  std::vector<Picture> pictures;
};

/// The report of a finished bench.
Report make_report(const BenchResults& results, std::vector<Picture> pictures);

std::string to_markdown(const Table& table);
std::string to_markdown(const Report& report);
/// A page that needs nothing but the pictures beside it.
std::string to_html(const Report& report);
/// The header of a table with a line a run, and such a line.
std::string csv_header();
std::string csv_row(const RunResult& run);

}  // namespace clew::bench
