// SPDX-License-Identifier: Apache-2.0
#include "clew/log_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "log/log.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

constexpr char kLevelVariable[] = "CLEW_LOG_LEVEL";
constexpr char kDirectoryVariable[] = "CLEW_LOG_DIR";
constexpr char kGroup[] = "Log";

/// `component sense`: of the others the command's name is enough. Processes that a person meets
/// beside the one that was started say who they are.
std::string speaker_of(const CLI::App& app) {
  static const std::set<std::string> kSpeakers = {"component", "recorder", "bridge", "host",
                                                  "relay"};
  const auto commands = app.get_subcommands();
  if (commands.empty() || kSpeakers.count(commands.front()->get_name()) == 0) return "clew";
  std::string speaker = "clew " + commands.front()->get_name();
  const CLI::Option* const stage = commands.front()->get_option_no_throw("stage");
  if (stage != nullptr && !stage->empty()) speaker += ' ' + stage->results().front();
  return speaker;
}

/// What a process writes to is named after its command.
std::string file_speaker(const CLI::App& app, const std::string& speaker) {
  const auto commands = app.get_subcommands();
  if (speaker != "clew" || commands.empty()) return speaker;
  return "clew " + commands.front()->get_name();
}

Result<logs::Level> level_of(const LogOptions& options) {
  if (options.verbose && options.quiet > 0) {
    return Error{"-v and -q say opposite things; one of them is allowed"};
  }
  if (options.verbose) return logs::Level::kDebug;
  if (options.quiet > 0) return options.quiet > 1 ? logs::Level::kError : logs::Level::kWarning;
  const char* const level = std::getenv(kLevelVariable);
  if (level == nullptr || *level == '\0') return logs::Level::kInfo;
  auto read = logs::level_from_name(level);
  if (!read.ok()) return Error{read.error().message, kLevelVariable};
  return read;
}

/// The processes that a run starts write where this one does, and as much.
void hand_on(logs::Level level, const std::string& directory) {
  ::setenv(kLevelVariable, std::string(logs::level_name(level)).c_str(), 1);
  if (!directory.empty()) ::setenv(kDirectoryVariable, directory.c_str(), 1);
}

void add_to(CLI::App& app, const std::shared_ptr<LogOptions>& options) {
  const auto* const verbose = app.get_option_no_throw("--verbose");
  if (verbose == nullptr) {
    app.add_flag("-v,--verbose", options->verbose, "also tell what is only for debugging, and when")
        ->group(kGroup);
  }
  app.add_flag("-q,--quiet", options->quiet, "tell warnings and errors only; -qq: errors only")
      ->group(kGroup);
  app.add_option("--log", options->file, "FILE that gets what is told as well, with times")
      ->group(kGroup);
  app.add_option("--log-dir", options->directory,
                 "DIR where each clew process gets such a file of its own (CLEW_LOG_DIR)")
      ->group(kGroup);
}

}  // namespace

void add_log_options(CLI::App& app, const std::shared_ptr<LogOptions>& options) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  if (commands.empty()) return add_to(app, options);
  for (CLI::App* const command : commands) add_log_options(*command, options);
}

Result<void> open_log(const CLI::App& app, const LogOptions& options) {
  if (options.file && options.file->empty()) return Error{"found '', expected a file", "--log"};
  if (options.directory && options.directory->empty()) {
    return Error{"found '', expected a directory", "--log-dir"};
  }
  if (options.file && options.directory) {
    return Error{"--log and --log-dir name two places; one of them is allowed"};
  }
  const auto level = level_of(options);
  if (!level.ok()) return level.error();
  const char* const variable = std::getenv(kDirectoryVariable);
  logs::Settings settings;
  settings.shown = *level;
  settings.written = *level == logs::Level::kOff ? *level : std::min(*level, logs::Level::kInfo);
  settings.times = *level == logs::Level::kDebug;
  settings.speaker = speaker_of(app);
  settings.file_name = file_speaker(app, settings.speaker);
  settings.file = options.file.value_or("");
  settings.directory =
      options.directory.value_or(options.file || variable == nullptr ? "" : variable);
  CLEW_RETURN_IF_ERROR(logs::open(settings));
  hand_on(*level, options.directory.value_or(""));
  return {};
}

}  // namespace clew::tools
