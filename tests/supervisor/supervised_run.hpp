// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/limits.hpp"
#include "sleeping_process.hpp"
#include "small_plan.hpp"
#include "supervisor/supervisor.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Texts = std::vector<std::string>;

inline const Texts kStages = {"drive", "sense", "control"};

inline Hello hello_of(const std::string& stage) {
  return {stage, 1, std::string(idl_fingerprint())};
}

/// The component's end of a line.
class Peer {
 public:
  explicit Peer(int socket) : link_(socket) {}

  template <typename Message>
  void say(FrameType type, Message message) {
    link_.post(type, std::move(message));
  }
  void report(std::uint64_t ticks, domain::Outcome outcome = domain::Outcome::kRunning) {
    Progress progress;
    progress.ticks = ticks;
    if (outcome != domain::Outcome::kRunning) {
      progress.statistics.truth.emplace();
      progress.statistics.truth->tick = ticks - 1;
      progress.statistics.truth->outcome = outcome;
    }
    say(FrameType::kProgress, progress);
  }
  /// The frames of a type that have come since the last call.
  std::vector<Frame> take(FrameType type) {
    while (link_.receive() && collect()) {
    }
    std::vector<Frame> taken = std::move(frames_[type]);
    frames_[type].clear();
    return taken;
  }
  bool closed() {
    while (link_.receive()) {
      if (!collect()) return false;
    }
    return true;
  }

 private:
  bool collect() {
    bool any = false;
    while (auto frame = link_.next()) {
      const FrameType type = frame->type;
      frames_[type].push_back(*std::move(frame));
      any = true;
    }
    return any;
  }

  Link link_;
  std::map<FrameType, std::vector<Frame>> frames_;
};

/// A run whose supervisor has a number for a clock, and whose components are the test at the other
/// ends of their lines.
class SupervisedRun : public testing::Test {
 protected:
  void SetUp() override { begin(); }
  void TearDown() override {
    for (Member& member : const_cast<std::vector<Member>&>(supervisor_->members())) {
      if (member.child) end_now(*member.child);
    }
  }

  void begin() {
    peers_.clear();
    supervisor_ = std::make_unique<Supervisor>(
        plan_, layout_, 1, std::nullopt, ProcessStart{},
        Supervisor::Outside{[this](logs::Level, const std::string& line) { log_.push_back(line); },
                            nullptr, start_sleeping, [this](auto) { return activity_; }, control_},
        now_);
    supervisor_->start();
  }
  const Member& member(const std::string& stage) const {
    return *find_member(const_cast<std::vector<Member>&>(supervisor_->members()), stage);
  }
  void kill(const std::string& stage, int number = SIGKILL) {
    end_now(const_cast<ChildProcess&>(*member(stage).child), number);
  }
  Peer& join(const std::string& stage, const Hello& hello) {
    int sockets[2] = {-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets), 0);
    supervisor_->welcome(std::make_unique<Link>(sockets[0]), hello, now_);
    return *(peers_[stage] = std::make_unique<Peer>(sockets[1]));
  }
  Peer& join(const std::string& stage) { return join(stage, hello_of(stage)); }
  Peer& peer(const std::string& stage) { return *peers_.at(stage); }
  /// Everybody is there and has found the others.
  void all_join() {
    for (const std::string& stage : kStages) {
      join(stage).say(FrameType::kWaiting, Waiting{});
    }
    supervisor_->turn(now_);
  }
  void all_report(std::uint64_t ticks) {
    for (const std::string& stage : kStages) peer(stage).report(ticks);
  }
  /// Lets time pass while everybody reports that it lives, every `beat`.
  void pass(std::chrono::steady_clock::duration time, const Texts& silent = {},
            std::chrono::steady_clock::duration beat = kHeartbeatPeriod) {
    const auto end = now_ + time;
    auto beats_at = now_;
    while (now_ < end && !supervisor_->over()) {
      now_ += kHeartbeatPeriod;
      if (now_ - beats_at >= beat) {
        beats_at = now_;
        all_live(silent);
      }
      supervisor_->turn(now_);
    }
  }
  void all_live(const Texts& silent = {}) {
    processor_ns_ += nanoseconds_per_beat_;
    for (const std::string& stage : kStages) {
      const bool speaks = std::find(silent.begin(), silent.end(), stage) == silent.end();
      if (!speaks || peers_.count(stage) == 0) continue;
      peer(stage).say(FrameType::kAlive, Alive{busy_, processor_ns_});
    }
  }
  std::string aborted() {
    EXPECT_TRUE(supervisor_->over());
    return supervisor_->finish(now_).aborted;
  }
  bool logged(const std::string& text) const {
    return std::any_of(log_.begin(), log_.end(), [&](const std::string& line) {
      return line.find(text) != std::string::npos;
    });
  }

  runtime::RunPlan plan_ = small_plan();
  ProcessLayout layout_;
  Supervisor::Time now_ = std::chrono::steady_clock::now();
  Texts log_;
  std::map<std::string, std::unique_ptr<Peer>> peers_;
  std::unique_ptr<Supervisor> supervisor_;
  std::optional<ProcessActivity> activity_;  ///< of every process; none: nobody knows
  RunControl* control_ = nullptr;            ///< from the next begin() on
  bool busy_ = false;
  std::uint64_t processor_ns_ = 0;
  std::uint64_t nanoseconds_per_beat_ = 0;
};

}  // namespace clew::bridge
