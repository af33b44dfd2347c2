// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <optional>
#include <string>
#include <vector>

#include "replay/live_replay.hpp"

namespace clew::tools {

/// Steers a replay from a terminal's keys or a script's lines, and shows how it does on stderr.
///
/// Keys: space (pause, go on), `n` or `.` (a tick), `+` and `-` (rate), `q` (end). Lines: `pause`,
/// `resume`, `step [N]`, `rate N` (`rate 0`: as fast as it goes), `end`; the end of input goes on
/// with what is left. With lines, each halt is told in a line of its own.
class PlaybackTerminal : public bridge::PlaybackConsole {
 public:
  enum class Input : std::uint8_t {
    kNone,  ///< somebody else reads the terminal: a debugger
    kKeys,  ///< if there is a terminal, and it is ours
    kCommands
  };

  explicit PlaybackTerminal(Input input);
  ~PlaybackTerminal() override;
  PlaybackTerminal(const PlaybackTerminal&) = delete;
  PlaybackTerminal& operator=(const PlaybackTerminal&) = delete;

  int descriptor() const override;
  std::vector<bridge::PlaybackRequest> take() override;
  void show(const bridge::LiveReplayStatus& status) override;
  void log(const std::string& line) override;
  /// Removes the status line.
  void clear();

 private:
  void take_line(const std::string& line, std::vector<bridge::PlaybackRequest>& requests);
  void tell_halt(const bridge::LiveReplayStatus& status);

  Input input_;
  const bool display_;
  std::optional<termios> before_;  ///< the terminal's settings, if they were changed
  std::string line_;
  std::optional<std::uint64_t> told_tick_;  ///< of the halt told last
};

/// A request in the words of a script; nothing if it is none.
std::optional<bridge::PlaybackRequest> read_playback_command(const std::string& line);
/// A request by its key.
std::optional<bridge::PlaybackRequest> read_playback_key(char key);

}  // namespace clew::tools
