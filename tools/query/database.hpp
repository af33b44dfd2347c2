// SPDX-License-Identifier: Apache-2.0
/// What the module `libclew-query.so` exports. It alone links SQLite, so that a component's
/// process, which is the same program, does not map it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/result.hpp"

namespace clew::query {

/// A value of SQLite: null, a whole number, a number, a text. Bytes come as text in hexadecimal.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// Takes what a query gives, row by row.
class RowSink {
 public:
  RowSink() = default;
  virtual ~RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;

  /// Once, before the rows.
  virtual core::Result<void> begin(const std::vector<std::string>& columns) = 0;
  virtual core::Result<void> row(const std::vector<Cell>& cells) = 0;
};

/// A database file with the table `runs`.
class Database {
 public:
  Database() = default;
  virtual ~Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// What the runs were read from, as it was noted; empty for a new database.
  virtual std::string source() const = 0;
  /// Adds a run: a line of `clew bench --json`. Values of keys that are no columns are refused.
  virtual core::Result<void> add(const std::string& line) = 0;
  /// Makes what was added last.
  virtual core::Result<void> finish(const std::string& source) = 0;
  /// Runs one statement that reads only. Refused, with line and column where SQLite tells one: what
  /// is no SQL, more than one statement, and what would write or reach another file.
  virtual core::Result<void> query(const std::string& sql, RowSink& rows) = 0;
};

/// Opens a database file for reading, or makes a new one in its place.
using OpenDatabase = void(const std::string& path, bool make_new,
                          core::Result<std::unique_ptr<Database>>& database);

inline constexpr const char* kQueryModule = "libclew-query.so";
inline constexpr const char* kOpenDatabase = "clew_open_database";

}  // namespace clew::query

extern "C" __attribute__((visibility("default"))) clew::query::OpenDatabase clew_open_database;
