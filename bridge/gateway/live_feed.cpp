// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_feed.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/archive.hpp"
#include "run/limits.hpp"
#include "run/spool.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// What may wait for the gateway: some seconds of a fast run.
constexpr std::size_t kMostWaitingBytes = 32 * 1024 * 1024;
constexpr char kNotStarted[] = "its gateway did not start";
/// A composed run hands its samples over in batches of this size.
constexpr std::size_t kBatchBytes = 64 * 1024;

}  // namespace

core::Result<std::unique_ptr<LiveFeed>> LiveFeed::start(const std::vector<std::string>& words,
                                                        int port, const RunDescription& description,
                                                        const std::string& name,
                                                        const std::string& run) {
  int sockets[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
    return core::Error{std::strerror(errno), "--view"};
  }
  auto link = std::make_unique<Link>(sockets[0]);
  ::fcntl(sockets[1], F_SETFD, 0);  // the child's end goes with it
  ChildCommand command;
  command.arguments = words;
  for (const std::string& word : {std::string("--socket"), std::to_string(sockets[1]),
                                  std::string("--port"), std::to_string(port)}) {
    command.arguments.push_back(word);
  }
  auto child = ChildProcess::start(command);
  ::close(sockets[1]);
  if (!child.ok()) return child.error();
  std::unique_ptr<LiveFeed> feed(new LiveFeed(std::move(link), std::move(child).value()));
  RunDescription told = description;
  core::StateWriter writer;
  std::string named = name;
  std::string called = run;
  writer(named, called, told);
  feed->link_->post_bytes(FrameType::kRecord, writer.bytes());
  return feed;
}

core::Result<void> LiveFeed::take_address(const Frame& frame) {
  const auto text = frame.as<Text>();
  if (!text) return core::Error{kNotStarted, "--view"};
  if (frame.type == FrameType::kFatal) return core::Error{text->text, "--view"};
  address_ = text->text;
  return {};
}

core::Result<void> LiveFeed::wait_for_address() {
  const auto frame = link_->wait_for_frame(started_at_ + kGatewayStartPatience);
  if (!frame.ok()) return core::Error{kNotStarted, "--view"};
  return take_address(*frame);
}

core::Result<void> LiveFeed::poll() {
  if (!address_.empty()) return {};
  link_->flush();
  const bool open = link_->receive();
  if (const auto frame = link_->next()) return take_address(*frame);
  if (open && Clock::now() < started_at_ + kGatewayStartPatience) return {};
  return core::Error{kNotStarted, "--view"};
}

bool LiveFeed::goes_on() {
  child_.reap();
  return child_.running();
}

void LiveFeed::add(std::string_view spool) {
  if (spool.empty()) return;
  if (waiting_bytes_ + spool.size() > kMostWaitingBytes) {
    ++dropped_batches_;
  } else {
    waiting_bytes_ += spool.size();
    waiting_.emplace_back(spool);
  }
  send();
}

void LiveFeed::send() {
  link_->flush();
  while (!waiting_.empty() && !link_->has_unsent()) {
    link_->post_bytes(FrameType::kSamples, waiting_.front());
    waiting_bytes_ -= waiting_.front().size();
    waiting_.pop_front();
  }
}

bool LiveFeed::turn_until(Clock::time_point deadline, EndSignals& signals) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  if (left.count() <= 0) return false;
  pollfd ends[] = {{link_->socket(), link_->poll_events(), 0}, {signals.descriptor(), POLLIN, 0}};
  ::poll(ends, 2, static_cast<int>(left.count()));
  asked_to_end_ = asked_to_end_ || signals.take() != 0;
  return !asked_to_end_ && link_->flush() && link_->receive();
}

bool LiveFeed::end(const std::string& how, EndSignals& signals) {
  const auto deadline = Clock::now() + kGatewayEndPatience;
  for (send(); !waiting_.empty() && turn_until(deadline, signals);) send();
  link_->post(FrameType::kRecordingEnd, RecordingEnd{how, {}});
  // Until viewers have what they are still to get: with this process the gateway ends.
  const auto last = Clock::now() + kGatewayMostEndPatience;
  auto silent_until = std::min(Clock::now() + kGatewayEndPatience, last);
  while (!asked_to_end_ && turn_until(silent_until, signals)) {
    while (const auto said = link_->next()) {
      if (said->as<Text>().value_or(Text{}).text == kPassedOn) return true;
      silent_until = std::min(Clock::now() + kGatewayEndPatience, last);
    }
  }
  return !asked_to_end_;
}

void LiveFeed::wait(EndSignals& signals) {
  // The gateway says nothing more: what comes from its side is its end.
  while (signals.take() == 0 && link_->receive()) {
    pollfd ends[] = {{link_->socket(), POLLIN, 0}, {signals.descriptor(), POLLIN, 0}};
    ::poll(ends, 2, -1);
  }
  child_.signal(SIGTERM);
}

void FedSink::add_state(const SpooledState& state) {
  if (page_.is_open() && shown_states_.shows(state.tick)) append_to_spool(state, spool_);
  if (next_ != nullptr && next_->wants_states()) next_->add_state(state);
}

core::Result<void> FedSink::add(const SampleView& sample) {
  next_tick_ = sample.tick + 1;
  if (page_.is_open()) {
    shown_states_.look_on(sample.tick);
    append_to_spool(sample, spool_);
    const auto now = Clock::now();
    if (spool_.size() >= kBatchBytes || now - handed_on_at_ >= kPassOnPeriod) {
      page_.add(spool_);
      spool_.clear();
      handed_on_at_ = now;
    }
  }
  return next_ == nullptr ? core::Result<void>() : next_->add(sample);
}

}  // namespace clew::bridge
