// SPDX-License-Identifier: Apache-2.0
#include <sqlite3.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "query/database.hpp"
#include "query/runs_table.hpp"

namespace clew::query {
namespace {

using core::Error;
using core::Result;

constexpr char kSql[] = "SQL";  // the place of errors in a statement

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Handle = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

Error failed(sqlite3* database, const std::string& path) {
  return {sqlite3_errmsg(database), path, 0, 0};
}

constexpr char kReadsOnly[] = "a query reads 'runs' only: SELECT, and WITH before it";

/// What does not change the database and yet is no question: other files, settings, transactions.
int refuse_control(void*, int action, const char*, const char*, const char*, const char*) {
  const bool controls = action == SQLITE_ATTACH || action == SQLITE_DETACH ||
                        action == SQLITE_PRAGMA || action == SQLITE_TRANSACTION ||
                        action == SQLITE_SAVEPOINT;
  return controls ? SQLITE_DENY : SQLITE_OK;
}

/// What a message about an unknown name leaves open.
std::string allowed_names(const std::string& message) {
  if (message.compare(0, 14, "no such table:") == 0) return "; the one table is 'runs'";
  if (message.compare(0, 15, "no such column:") != 0) return "";
  std::string names;
  for (const Column& column : runs_columns()) {
    names += (names.empty() ? "; 'runs' has " : ", ") + std::string(column.name);
  }
  return names;
}

/// Line and column, from 1, of a byte of a text.
std::pair<int, int> place_of(const std::string& text, std::size_t offset) {
  int line = 1;
  int column = 1;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
    line += text[i] == '\n' ? 1 : 0;
    column = text[i] == '\n' ? 1 : column + 1;
  }
  return {line, column};
}

Error refused(sqlite3* database, const std::string& sql) {
  const std::string message = sqlite3_errmsg(database);
  if (message == "not authorized") return {kReadsOnly, kSql, 0, 0};
  const int offset = sqlite3_error_offset(database);
  if (offset < 0) return {message + allowed_names(message), kSql, 0, 0};
  const auto [line, column] = place_of(sql, static_cast<std::size_t>(offset));
  return {message + allowed_names(message), kSql, line, column};
}

void bind_value(sqlite3_stmt* statement, int place, const nlohmann::json& value) {
  if (value.is_null()) {
    sqlite3_bind_null(statement, place);
  } else if (value.is_boolean()) {
    sqlite3_bind_int(statement, place, value.get<bool>() ? 1 : 0);
  } else if (value.is_number_integer()) {
    sqlite3_bind_int64(statement, place, value.get<std::int64_t>());
  } else if (value.is_number()) {
    sqlite3_bind_double(statement, place, value.get<double>());
  } else {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    sqlite3_bind_text(statement, place, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
  }
}

Cell cell_of(sqlite3_stmt* statement, int column) {
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_NULL:
      return {};
    case SQLITE_INTEGER:
      return static_cast<std::int64_t>(sqlite3_column_int64(statement, column));
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement, column);
    case SQLITE_TEXT:
      return std::string(static_cast<const char*>(sqlite3_column_blob(statement, column)), size);
    default:
      break;
  }
  std::string hex;
  const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(statement, column));
  for (std::size_t i = 0; i < size; ++i) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += {kDigits[bytes[i] / 16], kDigits[bytes[i] % 16]};
  }
  return hex;
}

class RunsDatabase : public Database {
 public:
  RunsDatabase(std::string path, Handle handle)
      : path_(std::move(path)), handle_(std::move(handle)) {}

  /// The tables of a new one.
  Result<void> begin() {
    // A database that is not finished is made again, so nothing needs to survive a crash.
    CLEW_RETURN_IF_ERROR(run("PRAGMA journal_mode = OFF"));
    CLEW_RETURN_IF_ERROR(run("PRAGMA synchronous = OFF"));
    CLEW_RETURN_IF_ERROR(run("CREATE TABLE made_from (source TEXT)"));
    CLEW_RETURN_IF_ERROR(run(create_runs()));
    CLEW_RETURN_IF_ERROR(run("BEGIN"));
    std::string places;
    for (std::size_t i = 0; i < runs_columns().size(); ++i) places += i == 0 ? "?" : ", ?";
    return prepare("INSERT INTO runs VALUES (" + places + ")", insert_);
  }

  std::string source() const override {
    Statement select;
    if (!prepare("SELECT source FROM made_from", select).ok()) return {};
    if (sqlite3_step(select.get()) != SQLITE_ROW) return {};
    const Cell cell = cell_of(select.get(), 0);
    const auto* text = std::get_if<std::string>(&cell);
    return text == nullptr ? std::string() : *text;
  }

  Result<void> add(const std::string& line) override {
    const auto run = nlohmann::json::parse(line, nullptr, false);
    if (!run.is_object()) return Error{"is no line of JSON", path_};
    std::size_t found = 0;
    int place = 0;
    for (const Column& column : runs_columns()) {
      const auto value = run.find(column.name);
      ++place;
      if (value != run.end()) ++found;
      bind_value(insert_.get(), place, value == run.end() ? nlohmann::json() : *value);
    }
    if (found != run.size()) {
      return Error{"a run has a key that 'runs' has no column for: " + line, path_};
    }
    if (sqlite3_step(insert_.get()) != SQLITE_DONE) return failed(handle_.get(), path_);
    sqlite3_reset(insert_.get());
    return {};
  }

  Result<void> finish(const std::string& source) override {
    Statement note;
    CLEW_RETURN_IF_ERROR(prepare("INSERT INTO made_from VALUES (?)", note));
    bind_value(note.get(), 1, source);
    if (sqlite3_step(note.get()) != SQLITE_DONE) return failed(handle_.get(), path_);
    return run("COMMIT");
  }

  Result<void> query(const std::string& sql, RowSink& rows) override {
    sqlite3_set_authorizer(handle_.get(), refuse_control, nullptr);
    sqlite3_stmt* statement = nullptr;
    const char* rest = nullptr;
    const int prepared = sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &statement, &rest);
    const Statement select(statement);
    if (prepared != SQLITE_OK) return refused(handle_.get(), sql);
    if (statement == nullptr) return Error{"is empty; expected a SELECT", kSql};
    if (sqlite3_stmt_readonly(statement) == 0) return Error{kReadsOnly, kSql};
    const std::string more = rest;
    const std::size_t next = more.find_first_not_of(" \t\n\r;");
    if (next != std::string::npos) {
      const auto [line, column] = place_of(sql, sql.size() - more.size() + next);
      return Error{"found a second statement; one is allowed", kSql, line, column};
    }
    return step(statement, sql, rows);
  }

 private:
  Result<void> run(const std::string& sql) {
    if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
    return failed(handle_.get(), path_);
  }

  Result<void> prepare(const std::string& sql, Statement& into) const {
    sqlite3_stmt* statement = nullptr;
    const int prepared = sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &statement, nullptr);
    into.reset(statement);
    if (prepared == SQLITE_OK) return {};
    return failed(handle_.get(), path_);
  }

  Result<void> step(sqlite3_stmt* statement, const std::string& sql, RowSink& rows) {
    const int columns = sqlite3_column_count(statement);
    std::vector<std::string> names;
    for (int i = 0; i < columns; ++i) names.emplace_back(sqlite3_column_name(statement, i));
    CLEW_RETURN_IF_ERROR(rows.begin(names));
    int stepped = 0;
    while ((stepped = sqlite3_step(statement)) == SQLITE_ROW) {
      std::vector<Cell> cells;
      for (int i = 0; i < columns; ++i) cells.push_back(cell_of(statement, i));
      CLEW_RETURN_IF_ERROR(rows.row(cells));
    }
    if (stepped != SQLITE_DONE) return refused(handle_.get(), sql);
    return {};
  }

  std::string path_;
  Handle handle_;
  Statement insert_;  ///< of a new database
};

Result<std::unique_ptr<Database>> open(const std::string& path, bool make_new) {
  if (make_new) std::remove(path.c_str());
  sqlite3* database = nullptr;
  const int flags = make_new ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  const int opened = sqlite3_open_v2(path.c_str(), &database, flags, nullptr);
  Handle handle(database);
  if (opened != SQLITE_OK) return failed(database, path);
  auto runs = std::make_unique<RunsDatabase>(path, std::move(handle));
  if (make_new) CLEW_RETURN_IF_ERROR(runs->begin());
  return std::unique_ptr<Database>(std::move(runs));
}

}  // namespace
}  // namespace clew::query

void clew_open_database(const std::string& path, bool make_new,
                        clew::core::Result<std::unique_ptr<clew::query::Database>>& database) {
  database = clew::query::open(path, make_new);
}
