// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "query/database.hpp"

namespace clew::query {

constexpr char kDatabaseFile[] = "results.sqlite";

/// Asks the results of a bench or shard in `directory`: one statement of SQL over the table `runs`.
/// The database is made when it is first asked for, and again when the results have changed.
/// Refused: a directory without results, and what Database::query refuses.
core::Result<void> query_results(const std::string& directory, const std::string& sql,
                                 RowSink& rows);

}  // namespace clew::query
