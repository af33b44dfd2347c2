// SPDX-License-Identifier: Apache-2.0
#include "supervisor/recorder_client.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {
RecorderClient::RecorderClient(RecordingOrder order, ChildCommand command, bool drops)
    : order_(std::move(order)), command_(std::move(command)), drops_(drops) {}

core::Result<void> RecorderClient::start(Time now) {
  auto child = ChildProcess::start(command_);
  if (!child.ok()) return child.error();
  child_ = std::move(child).value();
  heard_at_ = now;
  return {};
}

void RecorderClient::welcome(std::unique_ptr<Link> link, Time now) {
  if (link_ || account_) return;
  link->post(FrameType::kRecord,
             RecorderAssignment{order_, restarts_ > 0, progress_.durable_ticks});
  link_ = std::move(link);
  heard_at_ = now;
  reads_samples_ = false;
  end_sent_ = false;
  next_ = 0;
  sent_of_next_ = 0;
  blocked_ = false;
  unsent_bytes_ = kept_bytes_;
}

void RecorderClient::add(std::string spool, std::uint64_t end_tick) {
  if (account_ || spool.empty()) return;
  if (drops_ && kept_bytes_ + spool.size() > kMaxKeptBytes) return;
  kept_bytes_ += spool.size();
  unsent_bytes_ += spool.size();
  kept_.push_back({std::move(spool), end_tick});
}

void RecorderClient::end(const RecordingEnd& end) {
  core::StateWriter writer;
  RecordingEnd copy = end;
  writer(copy);
  ending_ = writer.take();
  ended_ = true;
}

std::uint64_t RecorderClient::credit() const {
  return account_ || drops_ ? UINT64_MAX : progress_.ticks + kRecorderLead;
}

std::optional<pollfd> RecorderClient::descriptor() const {
  if (!link_) return std::nullopt;
  const auto events = blocked_ ? POLLIN | POLLOUT : POLLIN;
  return pollfd{link_->socket(), static_cast<short>(events | link_->poll_events()), 0};
}

void RecorderClient::serve(Time now) {
  if (account_) return;
  if (link_) receive(now);
  if (link_ && !account_) send(now);
  if (account_) return;
  // What it said last is read before its end is believed.
  if (!link_ && child_ && child_->reap()) lose();
  if (child_ && child_->running() &&
      now - heard_at_ > (link_ ? kRecorderFrozenAfter : kRecorderStartTimeout)) {
    lines_.push_back("recorder (process " + std::to_string(child_->process_id()) +
                     ") does not report; killing it");
    child_->signal(SIGKILL);
    heard_at_ = now;
  }
  if (!account_ && child_ && !child_->running()) restart(now);
}

void RecorderClient::receive(Time now) {
  const bool open = link_->receive();
  while (auto frame = link_->next()) {
    heard_at_ = now;
    if (frame->type == FrameType::kKept) {
      const Kept kept = frame->as<Kept>().value_or(Kept{});
      progress_.ticks = std::max(progress_.ticks, kept.ticks);
      progress_.durable_ticks = std::max(progress_.durable_ticks, kept.durable_ticks);
      reads_samples_ = true;
      forget_durable();
    }
    if (frame->type == FrameType::kRecorded) account_ = frame->as<RecordingAccount>();
  }
  if (!open) link_.reset();
}

void RecorderClient::forget_durable() {
  while (next_ > 0 && kept_.front().end_tick <= progress_.durable_ticks) {
    kept_bytes_ -= kept_.front().spool.size();
    kept_.pop_front();
    --next_;
  }
}

void RecorderClient::send(Time now) {
  // What waits in the line goes first.
  link_->flush();
  if (!reads_samples_ || link_->has_unsent()) return;
  const bool worth_it = blocked_ || unsent_bytes_ >= kRecorderBatchBytes ||
                        now - sent_at_ >= kRecorderBatchDelay || ended_;
  if (!worth_it) return;
  sent_at_ = now;
  blocked_ = false;
  while (next_ < kept_.size()) {
    const std::string& spool = kept_[next_].spool;
    const auto sent = link_->send_some(FrameType::kSamples, spool, sent_of_next_);
    if (!sent) return;
    sent_of_next_ = *sent;
    blocked_ = sent_of_next_ < Link::frame_bytes(spool);
    if (blocked_) return;
    sent_of_next_ = 0;
    unsent_bytes_ -= spool.size();
    ++next_;
  }
  if (ended_ && !end_sent_) end_sent_ = link_->post_bytes(FrameType::kRecordingEnd, ending_);
}

// Its process has ended.
void RecorderClient::lose() {
  const bool in_place = restarts_ > 0 && progress_.durable_ticks <= durable_at_death_;
  deaths_in_place_ = in_place && !child_->was_killed() ? deaths_in_place_ + 1 : 0;
  durable_at_death_ = progress_.durable_ticks;
  const std::string what =
      "recorder (process " + std::to_string(child_->process_id()) + ") " + child_->end();
  if (restarts_ >= kRecorderRestarts || deaths_in_place_ >= kDeathsInPlace) {
    fail(what + "; it was restarted " + std::to_string(restarts_) + " times");
  } else {
    lines_.push_back(what + "; restarting it");
  }
}

void RecorderClient::restart(Time now) {
  ++restarts_;
  const auto started = start(now);
  if (!started.ok()) fail(started.error().text());
}

void RecorderClient::fail(const std::string& why) {
  account_.emplace();
  account_->failure = why;
}

}  // namespace clew::bridge
