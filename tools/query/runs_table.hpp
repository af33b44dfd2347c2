// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace clew::query {

/// A column of the table `runs`: a key of `clew bench --json`.
struct Column {
  const char* name;
  /// Of SQLite: INTEGER (0 and 1 for what is true or false), REAL, TEXT, or JSON: text that
  /// SQLite's functions for JSON take.
  const char* type;
};

/// All columns, in order.
const std::vector<Column>& runs_columns();

/// The statement that makes the table.
std::string create_runs();

}  // namespace clew::query
