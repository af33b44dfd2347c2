// SPDX-License-Identifier: Apache-2.0
#include "clew/playback_console.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <sstream>

#include "clew/terminal.hpp"
#include "log/log.hpp"

namespace clew::tools {

using bridge::Playback;
using bridge::PlaybackRequest;
using Kind = PlaybackRequest::Kind;

namespace {

constexpr std::uint64_t kMostSteps = 1000000000;

/// Reading a terminal from the background would stop the process.
bool terminal_is_ours() {
  return is_terminal(STDIN_FILENO) && shows_progress() && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
}

std::string rate_text(double rate) {
  return rate > 0.0 ? fmt::format("{:g}x", rate) : std::string("as fast as it goes");
}

std::string comparison_text(const bridge::LiveReplayStatus& status) {
  if (status.component == nullptr) return {};
  if (status.component->identical()) return "  " + status.component->component + " identical";
  return fmt::format("  {} differs in {} ticks, first in {}", status.component->component,
                     status.component->different_ticks, status.component->first->tick);
}

}  // namespace

std::optional<PlaybackRequest> read_playback_key(char key) {
  switch (key) {
    case ' ':
      return PlaybackRequest{Kind::kToggle};
    case 'n':
    case '.':
      return PlaybackRequest{Kind::kStep};
    case '+':
      return PlaybackRequest{Kind::kFaster};
    case '-':
      return PlaybackRequest{Kind::kSlower};
    case '[':
      return PlaybackRequest{Kind::kSkipBack};
    case ']':
      return PlaybackRequest{Kind::kSkipOn};
    case 'q':
      return PlaybackRequest{Kind::kEnd};
    default:
      return std::nullopt;
  }
}

std::optional<PlaybackRequest> read_playback_command(const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  words >> verb;
  PlaybackRequest request;
  if (verb == "pause") {
    request.kind = Kind::kPause;
  } else if (verb == "resume") {
    request.kind = Kind::kResume;
  } else if (verb == "end") {
    request.kind = Kind::kEnd;
  } else if (verb == "rate") {
    request.kind = Kind::kRate;
    const bool number = static_cast<bool>(words >> request.rate);
    const bool allowed = request.rate == 0.0 || (request.rate >= Playback::kLowestRate &&
                                                 request.rate <= Playback::kHighestRate);
    if (!number || !allowed) return std::nullopt;
  } else if (verb == "seek") {
    request.kind = Kind::kSeek;
    std::int64_t tick = -1;
    if (!(words >> tick) || tick < 0) return std::nullopt;
    request.ticks = static_cast<std::uint64_t>(tick);
  } else if (verb == "step") {
    request.kind = Kind::kStep;
    words >> std::ws;
    if (!words.eof()) {
      std::int64_t ticks = 0;
      if (!(words >> ticks) || ticks < 1 || ticks > static_cast<std::int64_t>(kMostSteps)) {
        return std::nullopt;
      }
      request.ticks = static_cast<std::uint64_t>(ticks);
    }
  } else {
    return std::nullopt;
  }
  words >> std::ws;
  if (!words.eof()) return std::nullopt;
  return request;
}

PlaybackTerminal::PlaybackTerminal(Input input) : input_(input), display_(shows_progress()) {
  if (input_ != Input::kKeys) return;
  termios settings{};
  if (!terminal_is_ours() || ::tcgetattr(STDIN_FILENO, &settings) != 0) {
    input_ = Input::kNone;
    return;
  }
  before_ = settings;
  // Keys at once and unseen; Ctrl-C stays a signal.
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

PlaybackTerminal::~PlaybackTerminal() {
  if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

int PlaybackTerminal::descriptor() const { return input_ == Input::kNone ? -1 : STDIN_FILENO; }

std::vector<PlaybackRequest> PlaybackTerminal::take() {
  std::vector<PlaybackRequest> requests;
  pollfd descriptor{STDIN_FILENO, POLLIN, 0};
  while (input_ != Input::kNone && ::poll(&descriptor, 1, 0) > 0) {
    char bytes[256];
    const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (count <= 0) {
      if (input_ == Input::kCommands) {
        if (!line_.empty()) take_line(line_, requests);
        requests.push_back({Kind::kResume});
      }
      input_ = Input::kNone;
      break;
    }
    for (ssize_t i = 0; i < count; ++i) {
      if (input_ == Input::kKeys) {
        if (const auto request = read_playback_key(bytes[i])) requests.push_back(*request);
      } else if (bytes[i] == '\n') {
        take_line(line_, requests);
        line_.clear();
      } else {
        line_ += bytes[i];
      }
    }
  }
  return requests;
}

void PlaybackTerminal::take_line(const std::string& line, std::vector<PlaybackRequest>& requests) {
  if (const auto request = read_playback_command(line)) {
    requests.push_back(*request);
  } else {
    log(
        fmt::format("unknown command '{}'; allowed: pause, resume, step [N], seek TICK, rate 0 or "
                    "{} to {}, end",
                    line, Playback::kLowestRate, Playback::kHighestRate));
  }
}

void PlaybackTerminal::show(const bridge::LiveReplayStatus& status) {
  if (input_ == Input::kCommands) tell_halt(status);
  if (!display_ || input_ == Input::kCommands) return;
  if (status.waiting) {
    fmt::print(stderr, "\r\033[Kwaiting for readers");
  } else {
    fmt::print(stderr, "\r\033[Ktick {}  {:.1f} s  {}{}{}", status.next_tick,
               static_cast<double>(status.next_tick) * status.tick_s,
               status.paused ? "paused" : rate_text(status.rate), comparison_text(status),
               input_ == Input::kKeys
                   ? "  [space] pause  [n] tick  [ ] back, on  [+ -] rate  [q] end"
                   : "");
  }
  std::fflush(stderr);
}

/// Once all that was asked for is published and answered, a script may ask for more.
void PlaybackTerminal::tell_halt(const bridge::LiveReplayStatus& status) {
  if (!status.halted || told_tick_ == status.next_tick) {
    if (!status.paused) told_tick_.reset();
    return;
  }
  told_tick_ = status.next_tick;
  log(fmt::format("paused before tick {}{}", status.next_tick, comparison_text(status)));
}

void PlaybackTerminal::log(const std::string& line) {
  clear();
  logs::info("{}", line);
}

void PlaybackTerminal::clear() {
  if (display_) std::fputs("\r\033[K", stderr);
}

}  // namespace clew::tools
