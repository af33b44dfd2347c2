// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::bridge {

/// A program that answers each line on its standard input with one line on its standard output. Its
/// standard error is ours.
class LineProgram {
 public:
  /// Starts it, with these variables on top of our environment; the error says why it cannot be.
  static core::Result<LineProgram> start(std::vector<std::string> arguments,
                                         const std::map<std::string, std::string>& environment);
  ~LineProgram();
  LineProgram(LineProgram&& other) noexcept;
  LineProgram& operator=(LineProgram&&) = delete;

  /// The answer to a line, both without their ends. Refused: no answer within `patience`, one that
  /// is too long, more than one, and the program's end, of which the error tells.
  core::Result<std::string> ask(const std::string& line,
                                std::chrono::steady_clock::duration patience);

 private:
  using Time = std::chrono::steady_clock::time_point;

  LineProgram(pid_t process_id, int input, int output)
      : process_id_(process_id), input_(input), output_(output) {}
  core::Result<void> check_silent();
  core::Result<void> send(const std::string& text, Time deadline);
  core::Result<std::string> take_line(Time deadline);
  core::Result<bool> receive();
  core::Error ended();

  pid_t process_id_;  ///< 0: taken note of its end
  int input_;         ///< where it reads
  int output_;        ///< where it writes
  std::string received_;
};

}  // namespace clew::bridge
