// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "core/result.hpp"

/// What a process tells people beside its results: to standard error, to a file, and to whoever
/// listens. Every thread may use it. Before `open` it tells standard error what is at least `info`.
namespace clew::logs {

enum class Level : std::uint8_t { kDebug, kInfo, kWarning, kError, kOff };

/// `debug`, `info`, `warning`, `error`, `off`. Refused: other names.
core::Result<Level> level_from_name(const std::string& name);
std::string_view level_name(Level level);

struct Settings {
  Level shown = Level::kInfo;      ///< least that standard error shows
  Level written = Level::kInfo;    ///< least that the file holds
  bool times = false;              ///< before each line of standard error; the file has them always
  std::string speaker = "clew";    ///< begins each line, as `clew component sense`
  std::string file_name = "clew";  ///< begins the names of files in `directory`
  std::string file;                ///< added to; or empty
  std::string directory;           ///< made if it is not there; a file a process in it; or empty
};

/// Begins to log as said. In a directory the file is `FILE_NAME-TIME-PID.log`, its words joined by
/// hyphens. Refused: a file or directory that cannot be written.
core::Result<void> open(const Settings& settings);

/// Whether standard error shows lines of this level: else a display of progress is not wanted.
bool shows(Level level);

/// Gets each line of `info` and above as well, from any thread; replaces the one before. A null
/// function: nobody.
void listen(std::function<void(Level, const std::string&)> listener);

/// Tells a line. Control characters become `\x1b`, since part of a text may be a stranger's.
void tell(Level level, std::string_view text);

/// What ends a command: standard error gets the line in full, as `clew: TEXT`, with line ends and
/// whatever the level is; the file gets it as an error.
void complain(std::string_view text);

template <typename... Values>
void debug(fmt::format_string<Values...> text, Values&&... values) {
  tell(Level::kDebug, fmt::format(text, std::forward<Values>(values)...));
}
template <typename... Values>
void info(fmt::format_string<Values...> text, Values&&... values) {
  tell(Level::kInfo, fmt::format(text, std::forward<Values>(values)...));
}
template <typename... Values>
void warning(fmt::format_string<Values...> text, Values&&... values) {
  tell(Level::kWarning, fmt::format(text, std::forward<Values>(values)...));
}
template <typename... Values>
void error(fmt::format_string<Values...> text, Values&&... values) {
  tell(Level::kError, fmt::format(text, std::forward<Values>(values)...));
}

}  // namespace clew::logs
