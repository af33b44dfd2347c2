// SPDX-License-Identifier: Apache-2.0
#include "gateway/gateway_process.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include "core/archive.hpp"
#include "gateway/insides_answer.hpp"
#include "gateway/json_text.hpp"
#include "gateway/kept_texts.hpp"
#include "gateway/live_feed.hpp"
#include "gateway/live_stream.hpp"
#include "gateway/program_runs.hpp"
#include "gateway/run_orders.hpp"
#include "gateway/view_content.hpp"
#include "line/link.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

/// Some hundred thousand ticks of the shipped graphs.
constexpr std::size_t kMostHeldBytes = 256 * 1024 * 1024;
/// So long a viewer may take to ask for what it has missed, when the run has ended.
constexpr int kQuietTurns = 30;
/// How often the run hears that viewers still get something.
constexpr int kProgressTurns = 30;

/// Whoever looks on gives way to the run.
constexpr int kNiceness = 5;

WebResponse json_response(unsigned status, const nlohmann::ordered_json& json) {
  return {status, "application/json", json_text(json), {}};
}

/// Passes on what pages ask of the run. Who may ask was checked by then.
class OrderDesk {
 public:
  OrderDesk(const GatewayPage& page, const std::string& run) : page_(page), run_(run) {}

  void serve_with(WebServer& server) { server_ = &server; }

  void take(const std::string& body, const WebContent::Answer& answer) {
    if (run_.empty()) return answer(json_response(409, {{"error", "the run is over"}}));
    const auto asked = page_.read_command(body, run_);
    if (!asked.ok()) return answer(json_response(400, {{"error", asked.error().message}}));
    const auto done = [answer, line = asked->line](const core::Result<CommandAnswer>& answered) {
      if (!answered.ok()) return answer(json_response(409, {{"error", answered.error().message}}));
      answer(json_response(200, {{"tick", answered->tick}, {"command", line}}));
    };
    const auto sent = orders_.send(run_, asked->command, std::chrono::steady_clock::now(), done);
    if (!sent.ok()) return answer(json_response(409, {{"error", sent.error().message}}));
    if (std::exchange(polls_, true)) return;
    server_->repeat(kOrderPeriod,
                    [this] { return polls_ = orders_.poll(std::chrono::steady_clock::now()); });
  }

 private:
  const GatewayPage& page_;
  const std::string& run_;
  WebServer* server_ = nullptr;
  RunOrders orders_;
  bool polls_ = false;
};

/// Tells what components saw, weighed and decided at a tick, as far as the stream holds the run:
/// another process is fed with it. It gives way to the run, as this one does.
class InsidesDesk {
 public:
  InsidesDesk(const GatewayPage& page, const LiveStream& stream)
      : page_(page), stream_(stream), changed_(page.changed) {}

  void serve_with(WebServer& server) { server_ = &server; }

  void take(const std::string& body, const WebContent::Answer& answer) {
    const auto asked = page_.read_question(body);
    if (!asked.ok()) return answer(json_response(400, {{"error", asked.error().message}}));
    auto held = HeldRecording::write(stream_, asked->tick, std::ref(changed_));
    if (!held.ok()) return answer(json_response(409, {{"error", held.error().text()}}));
    const auto recording = std::make_shared<HeldRecording>(std::move(held).value());
    std::vector<std::string> words = page_.explain;
    words.insert(words.end(), {recording->path(), "--tick", std::to_string(asked->tick), "--json"});
    const auto started =
        programs_.start(words, std::chrono::steady_clock::now(),
                        [answer, recording, line = asked->line](const ProgramEnd& end) {
                          answer(insides_answer(end, line));
                        });
    if (!started.ok()) return answer(json_response(409, {{"error", started.error().text()}}));
    if (std::exchange(polls_, true)) return;
    server_->repeat(kOrderPeriod,
                    [this] { return polls_ = programs_.poll(std::chrono::steady_clock::now()); });
  }

 private:
  const GatewayPage& page_;
  const LiveStream& stream_;
  KeptTexts changed_;
  WebServer* server_ = nullptr;
  ProgramRuns programs_{kExplainPatience};
  bool polls_ = false;
};

void take(const Frame& frame, const GatewayPage& page, LiveStream& stream, std::string& run) {
  if (frame.type == FrameType::kSamples) {
    stream.add(frame.payload);
  } else if (frame.type == FrameType::kRecord) {
    std::string name;
    RunDescription description;
    core::StateReader reader(frame.payload);
    reader(name, run, description);
    if (!reader.complete()) return;
    stream.describe(description, name, page.count_stages(description));
  } else if (frame.type == FrameType::kRecordingEnd) {
    run.clear();  // Another run may be called so by now.
    stream.end(frame.as<RecordingEnd>().value_or(RecordingEnd{}).aborted);
  }
}

}  // namespace

int run_gateway_process(int socket, int port, const GatewayPage& page) {
  ::setpriority(PRIO_PROCESS, 0, kNiceness);
  Link link(socket);
  LiveStream stream(kMostHeldBytes);
  ViewContent content(page.html, {});
  content.show_live(stream);
  content.offer("/choices", page.choices);
  std::string run;
  const auto server = WebServer::listen(port, content);
  if (!server.ok()) {
    link.post(FrameType::kFatal, Text{server.error().text()});
    return 1;
  }
  // After the server, so that what waits for an answer goes before it.
  OrderDesk desk(page, run);
  content.on_post("/control", [&desk](const std::string& body, const WebContent::Answer& answer) {
    desk.take(body, answer);
  });
  desk.serve_with(**server);
  InsidesDesk insides(page, stream);
  content.on_post("/explain",
                  [&insides](const std::string& body, const WebContent::Answer& answer) {
                    insides.take(body, answer);
                  });
  insides.serve_with(**server);
  link.post(FrameType::kNotice, Text{(*server)->access().address()});
  bool told = false;
  (*server)->watch(socket, [&] {
    const bool open = link.receive();
    while (const auto frame = link.next()) take(*frame, page, stream, run);
    if (!open) (*server)->stop();
    return open;
  });
  int quiet_turns = 0;
  int turns = 0;
  std::uint64_t progress = 0;
  (*server)->repeat(kPassOnPeriod, [&] {
    stream.pass_on();
    if (stream.ended().empty()) return true;
    quiet_turns = stream.idle() ? quiet_turns + 1 : 0;
    const bool done = quiet_turns == kQuietTurns || !stream.has_followers();
    if (done && !std::exchange(told, true)) link.post(FrameType::kNotice, Text{kPassedOn});
    if (!told && ++turns % kProgressTurns == 0 &&
        std::exchange(progress, stream.progress()) != stream.progress()) {
      link.post(FrameType::kNotice, Text{"passing on"});
    }
    return true;
  });
  (*server)->run();
  return 0;
}

}  // namespace clew::bridge
