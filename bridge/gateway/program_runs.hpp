// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::bridge {

/// How a program ended, and what it said.
struct ProgramEnd {
  int status = 0;  ///< its exit status; 128 and more: killed by a signal, as shells have it
  std::string out;
  std::string err;
};

/// Programs that were started for a page: a few at once, each for a bounded time, none longer than
/// this lives.
class ProgramRuns {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Done = std::function<void(ProgramEnd)>;

  explicit ProgramRuns(std::chrono::steady_clock::duration patience) : patience_(patience) {}
  ~ProgramRuns();
  ProgramRuns(const ProgramRuns&) = delete;
  ProgramRuns& operator=(const ProgramRuns&) = delete;

  /// Starts a program, the first of `words`, with nothing to read. Refused: one too many at once.
  core::Result<void> start(const std::vector<std::string>& words, Time now, Done done);
  /// Tells of those that have ended, and kills those whose time is over. Whether any is left.
  bool poll(Time now);

 private:
  struct Running {
    int process_id = 0;
    int out = -1;  ///< a file in memory
    int err = -1;
    Time until{};
    Done done;
  };

  std::chrono::steady_clock::duration patience_;
  std::list<Running> running_;
};

}  // namespace clew::bridge
