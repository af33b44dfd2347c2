// SPDX-License-Identifier: Apache-2.0
#include "supervisor/composed_control.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace clew::bridge {
ComposedControl::ComposedControl(RunControl& control, const RunName* name) : control_(control) {
  if (name != nullptr) acceptor_.emplace(std::vector<int>{name->socket()});
  to_record_ = control_.interventions();
  // Their files are among those that the run was made of.
  for (domain::Intervention& planned : to_record_) planned.files.clear();
}

void ComposedControl::serve(std::uint64_t next_tick, std::vector<runtime::NodeSuccession>& nodes,
                            SampleSink* recording, std::chrono::milliseconds patience) {
  if (acceptor_) {
    std::vector<pollfd> descriptors = desk_.descriptors();
    for (const int socket : acceptor_->sockets()) descriptors.push_back({socket, POLLIN, 0});
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(patience.count()));
    const auto now = CommandDesk::Time::clock::now();
    for (auto& [link, hello] : acceptor_->arrivals(now)) {
      if (hello.stage == kCommander) desk_.welcome(std::move(link), now);
    }
    desk_.serve([&](RunCommand& command) { return decide(command, next_tick, nodes); }, now);
  }
  for (const domain::Intervention& intervention : std::exchange(to_record_, {})) {
    if (recording != nullptr) recording->add_intervention(intervention);
  }
}

void ComposedControl::note(std::uint64_t tick, const std::vector<runtime::NodeSuccession>& nodes,
                           const domain::Messages& messages) {
  if (!acceptor_) return;
  for (const runtime::NodeSuccession& node : nodes) {
    auto history = histories_.find(node.name());
    if (history == histories_.end()) {
      auto created = InputHistory::create();
      if (!created.ok()) continue;
      history = histories_.emplace(node.name(), std::move(created).value()).first;
    }
    // One that cannot be written has gaps, which feed() finds.
    (void)history->second.put(tick, node.ports().inputs, messages).ok();
  }
}

std::optional<CommandAnswer> ComposedControl::decide(RunCommand& command, std::uint64_t next_tick,
                                                     std::vector<runtime::NodeSuccession>& nodes) {
  switch (command.kind) {
    case RunCommand::Kind::kChange:
      return change(command, next_tick, nodes);
    case RunCommand::Kind::kPause:
      if (!held_from_) held_from_ = next_tick;
      record({*held_from_, 0, {}, "pause", {}});
      return CommandAnswer::from(*held_from_);
    case RunCommand::Kind::kStep: {
      CommandAnswer answer = step(command, next_tick);
      if (answer.done && next_tick < answer.tick) return std::nullopt;
      return answer;
    }
    case RunCommand::Kind::kResume:
      if (!held_from_) return CommandAnswer::refused("the run is not paused");
      record({*held_from_, 0, {}, "resume", {}});
      held_from_.reset();
      return CommandAnswer::from(next_tick);
    case RunCommand::Kind::kPace:
      pace_factor_ = command.pace_factor;
      record({next_tick, 0, {}, "pace", {}});
      return CommandAnswer::from(next_tick);
    case RunCommand::Kind::kStatus:
      return status(next_tick, nodes);
    case RunCommand::Kind::kView:
      return view(next_tick);
    case RunCommand::Kind::kStop:
      break;
  }
  stopped_ = "stopped by a command after tick " + std::to_string(next_tick);
  return CommandAnswer::from(next_tick);
}

CommandAnswer ComposedControl::status(std::uint64_t next_tick,
                                      const std::vector<runtime::NodeSuccession>& nodes) {
  CommandAnswer answer = CommandAnswer::from(next_tick);
  answer.held = held_from_.has_value();
  std::vector<RunProfile::Writer> writers;
  for (const runtime::NodeSuccession& node : nodes) {
    ComponentStatus status;
    status.stage = node.name();
    status.process = node.name();
    status.process_id = ::getpid();
    status.ticks = next_tick;
    if (profile_) status.steps = profile_->step_times(node.name());
    answer.components.push_back(std::move(status));
    writers.push_back({node.name(), node.ports().output_order});
  }
  profile_.emplace(writers, 0);
  return answer;
}

std::optional<CommandAnswer> ComposedControl::view(std::uint64_t next_tick) {
  const auto opened = control_.open_page();
  if (!opened) return std::nullopt;
  if (!opened->ok()) return CommandAnswer::refused(opened->error().text());
  CommandAnswer answer = CommandAnswer::from(next_tick);
  answer.page = **opened;
  return answer;
}

// The command is kept until the tick has been: `ticks` becomes 0 once it was passed on.
CommandAnswer ComposedControl::step(RunCommand& command, std::uint64_t next_tick) {
  if (!held_from_) return CommandAnswer::refused("the run is not paused: 'clew pause' comes first");
  if (command.ticks > 0) {
    record({*held_from_, 0, {}, "step", {}});
    held_from_ = next_tick + command.ticks;
    command.at = *held_from_;
    command.ticks = 0;
  }
  return CommandAnswer::from(*command.at);
}

CommandAnswer ComposedControl::change(const RunCommand& command, std::uint64_t next_tick,
                                      std::vector<runtime::NodeSuccession>& nodes) {
  const std::uint64_t earliest = std::max({next_tick, control_.next_free_tick(), std::uint64_t{1}});
  if (command.at && *command.at < earliest) {
    return CommandAnswer::refused("the run is at tick " + std::to_string(next_tick) +
                                  " already; the earliest is tick " + std::to_string(earliest));
  }
  const auto changed = control_.change(command.changes, command.at.value_or(earliest));
  if (!changed.ok()) return CommandAnswer::refused(changed.error().text());
  for (runtime::NodeSuccession& node : nodes) {
    auto next = runtime::successor(control_.plan_before_last(), control_.plans().back(), *changed,
                                   node.name());
    if (!next) continue;
    const auto fed = feed(node, std::move(*next), next_tick);
    if (fed.ok()) continue;
    // The change is in the account of the run, so it cannot be left out.
    stopped_ = node.name() + " cannot be changed: " + fed.error().text();
    return CommandAnswer::refused(stopped_);
  }
  record(*changed);
  return CommandAnswer::from(changed->tick);
}

core::Result<void> ComposedControl::feed(runtime::NodeSuccession& node,
                                         runtime::Successor successor, std::uint64_t next_tick) {
  domain::Messages messages;
  for (std::uint64_t tick = successor.fed_from; tick < next_tick && !successor.keeps_state;
       ++tick) {
    const auto history = histories_.find(node.name());
    if (history == histories_.end()) return core::Error{"no inputs are kept"};
    const auto present = history->second.get(tick, messages);
    if (!present.ok()) return present.error();
    runtime::NodeSuccession::feed(successor, tick, *present, messages);
  }
  node.add(std::move(successor));
  return {};
}

}  // namespace clew::bridge
