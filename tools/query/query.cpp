// SPDX-License-Identifier: Apache-2.0
#include "query/query.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "bench/bench.hpp"
#include "bench/results_file.hpp"
#include "core/shared_library.hpp"

namespace clew::query {
namespace {

using core::Error;
using core::Result;

namespace fs = std::filesystem;

/// Tells results that have changed from those that a database was made from.
Result<std::string> state_of(const fs::path& directory) {
  std::string text;
  for (const char* name : {bench::kResultsFile, bench::kTimingFile}) {
    struct stat found {};
    const std::string path = (directory / name).string();
    const std::string compressed = path + bench::kCompressedEnding;
    if (::stat(path.c_str(), &found) != 0 && ::stat(compressed.c_str(), &found) != 0) {
      return Error{std::string("cannot be read: ") + std::strerror(errno), path};
    }
    text += fmt::format("{} {} {}.{} ", name, found.st_size, found.st_mtim.tv_sec,
                        found.st_mtim.tv_nsec);
  }
  return text;
}

Result<std::unique_ptr<Database>> open(const std::string& path, bool make_new) {
  const auto module = core::SharedLibrary::load(kQueryModule);
  if (!module.ok()) return module.error();
  const auto open_database = module->function<OpenDatabase>(kOpenDatabase);
  if (!open_database.ok()) return open_database.error();
  Result<std::unique_ptr<Database>> database = std::unique_ptr<Database>();
  (*open_database)(path, make_new, database);
  return database;
}

/// Makes a database beside the one that it is to be.
Result<void> make(const std::string& directory, const std::string& path, const std::string& state) {
  const auto database = open(path + ".new", true);
  if (!database.ok()) return database.error();
  Result<void> added;
  CLEW_RETURN_IF_ERROR(bench::visit_runs(directory, [&](const std::string& line) {
    if (added.ok()) added = (*database)->add(line);
  }));
  CLEW_RETURN_IF_ERROR(added);
  CLEW_RETURN_IF_ERROR((*database)->finish(state));
  if (std::rename((path + ".new").c_str(), path.c_str()) == 0) return {};
  return Error{std::string("cannot be written: ") + std::strerror(errno), path};
}

}  // namespace

Result<void> query_results(const std::string& directory, const std::string& sql, RowSink& rows) {
  const std::string path = (fs::path(directory) / kDatabaseFile).string();
  const auto state = state_of(directory);
  if (!state.ok()) return state.error();
  bool is_made = false;
  if (fs::exists(path)) {
    const auto database = open(path, false);
    is_made = database.ok() && (*database)->source() == *state;
  }
  if (!is_made) CLEW_RETURN_IF_ERROR(make(directory, path, *state));
  const auto database = open(path, false);
  if (!database.ok()) return database.error();
  return (*database)->query(sql, rows);
}

}  // namespace clew::query
