// SPDX-License-Identifier: Apache-2.0
#include "gateway/gateway_process.hpp"

#include <chrono>
#include <cstdio>
#include <utility>

#include "core/archive.hpp"
#include "gateway/live_stream.hpp"
#include "gateway/view_content.hpp"
#include "line/link.hpp"

namespace clew::bridge {
namespace {

/// Some hundred thousand ticks of the shipped graphs.
constexpr std::size_t kMostHeldBytes = 256 * 1024 * 1024;
/// What a person can see.
constexpr auto kPassOnPeriod = std::chrono::milliseconds(16);
/// So long a viewer may take to ask for what it has missed, when the run has ended.
constexpr int kQuietTurns = 30;

void take(const Frame& frame, LiveStream& stream) {
  if (frame.type == FrameType::kSamples) {
    stream.add(frame.payload);
  } else if (frame.type == FrameType::kRecord) {
    std::string name;
    RunDescription description;
    core::StateReader reader(frame.payload);
    reader(name, description);
    if (reader.complete()) stream.describe(description, name);
  } else if (frame.type == FrameType::kRecordingEnd) {
    stream.end(frame.as<Text>().value_or(Text{}).text);
  }
}

}  // namespace

int run_gateway_process(int socket, int port, std::string_view page) {
  Link link(socket);
  LiveStream stream(kMostHeldBytes);
  ViewContent content(page, {});
  content.show_live(stream);
  const auto server = WebServer::listen(port, content);
  if (!server.ok()) {
    link.post(FrameType::kFatal, Text{server.error().text()});
    return 1;
  }
  link.post(FrameType::kNotice, Text{(*server)->access().address()});
  bool told = false;
  (*server)->watch(socket, [&] {
    const bool open = link.receive();
    while (const auto frame = link.next()) take(*frame, stream);
    if (!open) (*server)->stop();
    return open;
  });
  int quiet_turns = 0;
  (*server)->repeat(kPassOnPeriod, [&] {
    stream.pass_on();
    if (stream.ended().empty()) return true;
    quiet_turns = stream.idle() ? quiet_turns + 1 : 0;
    const bool done = quiet_turns == kQuietTurns || !stream.has_followers();
    if (done && !std::exchange(told, true)) link.post(FrameType::kNotice, Text{"passed on"});
    return true;
  });
  (*server)->run();
  return 0;
}

}  // namespace clew::bridge
