// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/grouping.hpp"
#include "bench/summary.hpp"

namespace clew::bench {

/// A file beside the report: a line a group and variant.
constexpr char kGroupsFile[] = "groups.jsonl";

/// The runs of a variant in worlds of a kind.
struct Group {
  std::string name;  ///< `0.5 to 1`, of what the grouping counts
  std::size_t variant = 0;
  std::size_t worlds = 0;
  std::size_t successes = 0;
  std::size_t known = 0;  ///< runs of which it is known whether they are a success
  /// Of runs that reached the target, where the shortest path is known: over that.
  std::vector<double> path_ratios;
  std::vector<double> bug1_ratios;
  std::vector<double> bug2_ratios;
  /// Of runs that reached the target and have bounds: longer than these.
  std::size_t arrived = 0;
  std::size_t above_bug1 = 0;
  std::size_t above_bug2 = 0;
};

/// The groups that have runs, from the easiest on, each with its variants.
std::vector<Group> groups_of(const BenchResults& results, Grouping grouping);

/// A row a group and variant: success, and path lengths beside the bounds of Bug1 and Bug2.
Table group_table(const BenchResults& results, Grouping grouping);

/// A row a variant: path lengths beside the bounds of Bug1 and Bug2, in all worlds. Without rows if
/// no world has bounds.
Table bug_table(const BenchResults& results);

/// The lines of kGroupsFile.
std::vector<std::string> group_lines(const BenchResults& results, Grouping grouping);

}  // namespace clew::bench
