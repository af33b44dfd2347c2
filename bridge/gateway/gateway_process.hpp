// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "gateway/held_recording.hpp"
#include "line/frames.hpp"
#include "recording/run_description.hpp"

namespace clew::bridge {

/// A command of a page, and the line to type that does the same.
struct PageCommandLine {
  RunCommand command;
  std::string line;
};

/// What a page asks of a tick, and the line to type for it once the run is recorded.
struct PageQuestion {
  std::uint64_t tick = 0;
  std::string line;
};

/// The page that a gateway serves, and what the page needs to command the run.
struct GatewayPage {
  std::string_view html;
  std::string choices;  ///< of behaviours and their parameters, as JSON
  /// Reads what a page asks of the run that is called so. Refused: what a page may not ask.
  std::function<core::Result<PageCommandLine>(const std::string& body, const std::string& run)>
      read_command;
  /// Reads which tick a page asks to be explained.
  std::function<core::Result<PageQuestion>(const std::string& body)> read_question;
  /// How many of the run's stages hand over states at a checkpoint; 0: that is not known.
  std::function<std::size_t(const RunDescription& description)> count_stages;
  /// The texts of a run, once these changes are in force.
  HeldRecording::Changed changed;
  /// The program that explains a tick of a recording, and its first arguments.
  std::vector<std::string> explain;
};

/// Serves `page` and the run that is told of on `socket`, at `port` (0: any free one). First it
/// says where on the socket. When the run has ended it serves on, until a signal. Returns the exit
/// status.
int run_gateway_process(int socket, int port, const GatewayPage& page);

}  // namespace clew::bridge
