// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/result.hpp"

namespace clew::tools {

/// What was said of the log on the command line.
struct LogOptions {
  int quiet = 0;
  bool verbose = false;
  std::optional<std::string> file;
  std::optional<std::string> directory;
};

/// Gives every command that has no commands of its own the options of the log, where it has not
/// taken their letters itself.
void add_log_options(CLI::App& app, const std::shared_ptr<LogOptions>& options);

/// Begins to log as the options say, or else CLEW_LOG_LEVEL and CLEW_LOG_DIR, and tells the
/// processes that this one starts. `app` has been parsed: the command names the process.
core::Result<void> open_log(const CLI::App& app, const LogOptions& options);

}  // namespace clew::tools
