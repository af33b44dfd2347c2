// SPDX-License-Identifier: Apache-2.0
#include "clew/bridged_run.hpp"

#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

#include "clew/own_program.hpp"

namespace clew::tools {
namespace {

/// The bridge notices the end of the run's line at once; closing its endpoints takes a moment.
constexpr auto kEndPatience = std::chrono::seconds(2);
constexpr auto kReapPeriod = std::chrono::milliseconds(10);

bool has_ended(bridge::ChildProcess& process, std::chrono::steady_clock::duration patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (process.running() && std::chrono::steady_clock::now() < deadline) {
    process.reap();
    std::this_thread::sleep_for(kReapPeriod);
  }
  return !process.running();
}

}  // namespace

core::Result<BridgedRun> BridgedRun::start(const RunOptions& options, const std::string& run) {
  BridgedRun self;
  if (options.ros2.empty()) return self;
  bridge::ChildCommand command;
  command.arguments = {own_program(), "bridge",      "ros2",      "--domain",
                       run,           "--namespace", options.ros2};
  auto process = bridge::ChildProcess::start(command);
  if (!process.ok()) return process.error();
  self.process_ = std::make_unique<bridge::ChildProcess>(std::move(process).value());
  return self;
}

void BridgedRun::stop() {
  if (process_ && process_->running()) process_->signal(SIGTERM);
}

BridgedRun::~BridgedRun() {
  if (!process_ || has_ended(*process_, kEndPatience)) return;
  process_->signal(SIGTERM);
  if (!has_ended(*process_, kEndPatience)) process_->signal(SIGKILL);
}

}  // namespace clew::tools
