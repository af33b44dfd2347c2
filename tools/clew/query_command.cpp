// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "query/query.hpp"
#include "query/row_output.hpp"

namespace clew::tools {
namespace {

struct QueryCommandOptions {
  std::string directory;
  std::string sql;
  bool json = false;
  bool csv = false;
};

int query_command(const QueryCommandOptions& options) {
  const query::Print print = [](const std::string& text) { fmt::print("{}", text); };
  query::TableOutput table(print);
  query::JsonOutput json(print);
  query::CsvOutput csv(print);
  query::RowSink* rows = &table;
  if (options.json) rows = &json;
  if (options.csv) rows = &csv;
  const auto done = query::query_results(options.directory, options.sql, *rows);
  if (!done.ok()) return complain(done.error());
  if (rows == &table) table.end();
  return kExitGood;
}

}  // namespace

void add_query(CLI::App& main, int& status) {
  const auto options = std::make_shared<QueryCommandOptions>();
  CLI::App* app = main.add_subcommand("query", "Ask the results of a bench by SQL");
  app->add_option("directory", options->directory, "of a bench or shard: its --out")->required();
  app->add_option("sql", options->sql,
                  "one SELECT over the table 'runs', whose columns are the keys of bench --json")
      ->required();
  CLI::Option* json = app->add_flag("--json", options->json, "print one JSON object a row");
  app->add_flag("--csv", options->csv, "print a table with commas")->excludes(json);
  app->callback([options, &status] { status = query_command(*options); });
}

}  // namespace clew::tools
