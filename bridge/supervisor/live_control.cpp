// SPDX-License-Identifier: Apache-2.0
#include "supervisor/live_control.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace clew::bridge {
LiveControl::LiveControl(RunControl* control, std::vector<Member>& members, bool realtime)
    : control_(control), members_(members), realtime_(realtime) {
  // What was planned is recorded as it takes effect, as anything else.
  if (control_ != nullptr) to_record_ = control_->interventions();
  // Their files are among those that the run was made of.
  for (domain::Intervention& planned : to_record_) planned.files.clear();
}

void LiveControl::serve(const Situation& situation, Time now) {
  desk_.serve([&](RunCommand& command) { return decide(command, situation, now); }, now);
}

std::optional<CommandAnswer> LiveControl::decide(RunCommand& command, const Situation& situation,
                                                 Time now) {
  if (command.kind == RunCommand::Kind::kStatus) return status(situation, now);
  if (control_ == nullptr) return CommandAnswer::refused("this run takes no commands");
  if (command.kind == RunCommand::Kind::kView) return view(situation);
  if (command.kind == RunCommand::Kind::kStop) {
    stopped_ = "stopped by a command after tick " + std::to_string(situation.ticks);
    return CommandAnswer::from(situation.ticks);
  }
  if (situation.ending) return CommandAnswer::refused("the run is over");
  if (!situation.gone) return std::nullopt;
  switch (command.kind) {
    case RunCommand::Kind::kChange:
      return change(command, situation);
    case RunCommand::Kind::kPause:
      return pause(situation);
    case RunCommand::Kind::kStep:
      return step(command, situation);
    case RunCommand::Kind::kPace:
      return pace(command, situation);
    case RunCommand::Kind::kResume:
    case RunCommand::Kind::kStop:
    case RunCommand::Kind::kStatus:
    case RunCommand::Kind::kView:
      break;
  }
  return resume(situation);
}

CommandAnswer LiveControl::status(const Situation& situation, Time now) const {
  CommandAnswer answer = CommandAnswer::from(situation.ticks);
  answer.held = holds() || disarmed_;
  for (const Member& member : members_) {
    for (ComponentStatus& each : member.status(now)) answer.components.push_back(std::move(each));
  }
  return answer;
}

std::optional<CommandAnswer> LiveControl::view(const Situation& situation) const {
  const auto opened = control_->open_page();
  if (!opened) return std::nullopt;
  if (!opened->ok()) return CommandAnswer::refused(opened->error().text());
  CommandAnswer answer = CommandAnswer::from(situation.ticks);
  answer.page = **opened;
  return answer;
}

CommandAnswer LiveControl::change(const RunCommand& command, const Situation& situation) {
  const std::uint64_t earliest = std::max(situation.first_open_tick, control_->next_free_tick());
  if (command.at && *command.at < earliest) {
    return CommandAnswer::refused("the run may be at tick " + std::to_string(*command.at) +
                                  " already; the earliest is tick " + std::to_string(earliest));
  }
  auto changed = control_->change(command.changes, command.at.value_or(earliest));
  if (!changed.ok()) return CommandAnswer::refused(changed.error().text());
  for (Member& member : members_) {
    if (!member.link) continue;  // it is told when it joins
    member.link->post(FrameType::kIntervention, *changed);
    if (!realtime_) not_noted_[changed->tick].insert(member.stage);
  }
  (realtime_ ? unconfirmed_ : to_record_).push_back(*changed);
  return CommandAnswer::from(changed->tick);
}

template <typename Message>
void LiveControl::tell_starter(FrameType type, const Message& message) const {
  for (Member& member : members_) {
    if (member.starts_ticks && member.link) member.link->post(type, message);
  }
}

std::optional<CommandAnswer> LiveControl::pause(const Situation&) {
  if (!held_from_) {
    held_from_ = 0;
    hold_confirmed_ = false;
    tell_starter(FrameType::kHold, Tick{0});
  }
  if (!hold_confirmed_) return std::nullopt;
  to_record_.push_back({*held_from_, 0, {}, "pause", {}});
  return CommandAnswer::from(*held_from_);
}

// The command is kept until the tick has been: `ticks` becomes 0 once it was passed on.
std::optional<CommandAnswer> LiveControl::step(RunCommand& command, const Situation& situation) {
  if (!held_from_) return CommandAnswer::refused("the run is not paused: 'clew pause' comes first");
  if (!hold_confirmed_) return std::nullopt;
  if (command.ticks > 0) {
    to_record_.push_back({*held_from_, 0, {}, "step", {}});
    *held_from_ += command.ticks;
    command.ticks = 0;
    command.at = *held_from_;
    tell_starter(FrameType::kHold, Tick{*held_from_});
  }
  if (situation.ticks < *command.at) return std::nullopt;
  return CommandAnswer::from(*command.at);
}

void LiveControl::disarm() {
  disarmed_ = true;
  tell_starter(FrameType::kRest, Tick{0});
}

void LiveControl::slow(bool slowly) { tell_starter(FrameType::kSlow, Slow{slowly}); }

// Who says so while the robot rests has looked at what stopped it.
CommandAnswer LiveControl::resume(const Situation& situation) {
  if (!held_from_ && !disarmed_) return CommandAnswer::refused("the run is not paused");
  const std::uint64_t tick = held_from_.value_or(situation.ticks);
  held_from_.reset();
  disarmed_ = false;
  tell_starter(FrameType::kRelease, Tick{tick});
  to_record_.push_back({tick, 0, {}, "resume", {}});
  return CommandAnswer::from(tick);
}

CommandAnswer LiveControl::pace(const RunCommand& command, const Situation& situation) {
  if (realtime_ || keeps_own_pace(members_)) {
    return CommandAnswer::refused(realtime_ ? "a run in real time keeps its pace"
                                            : "a drive of somebody else's keeps its own pace");
  }
  pace_factor_ = command.pace_factor;
  tell_starter(FrameType::kPace, PaceChange{command.pace_factor});
  to_record_.push_back({situation.ticks, 0, {}, "pace", {}});
  return CommandAnswer::from(situation.ticks);
}

void LiveControl::fill(Assignment& assignment) const {
  if (control_ == nullptr) return;
  for (const domain::Intervention& known : control_->interventions()) {
    assignment.interventions.push_back(known);
  }
}

void LiveControl::join(Member& member) {
  forget(member.stage);
  if (held_from_ && member.starts_ticks) member.link->post(FrameType::kHold, Tick{*held_from_});
  if (pace_factor_ && member.starts_ticks) {
    member.link->post(FrameType::kPace, PaceChange{*pace_factor_});
  }
}

std::uint64_t LiveControl::credit() const {
  return not_noted_.empty() ? UINT64_MAX : not_noted_.begin()->first;
}

void LiveControl::forget(const std::string& stage, std::optional<std::uint64_t> tick) {
  for (auto change = not_noted_.begin(); change != not_noted_.end();) {
    if (!tick || *tick == change->first) change->second.erase(stage);
    change = change->second.empty() ? not_noted_.erase(change) : std::next(change);
  }
}

void LiveControl::note(const std::string& stage, const Frame& frame) {
  if (frame.type == FrameType::kNoted) {
    if (const auto noted = frame.as<Tick>()) forget(stage, noted->tick);
  }
  if (frame.type == FrameType::kHeld && held_from_) {
    if (const auto at = frame.as<Tick>()) held_from_ = std::max(*held_from_, at->tick);
    hold_confirmed_ = true;
  }
  if (frame.type != FrameType::kTookOver) return;
  const auto change = frame.as<TookOver>();
  if (!change) return;
  for (auto known = unconfirmed_.begin(); known != unconfirmed_.end(); ++known) {
    if (known->tick != change->planned) continue;
    known->tick = change->tick;
    to_record_.push_back(*known);
    unconfirmed_.erase(known);
    return;
  }
}

std::vector<domain::Intervention> LiveControl::take_interventions() {
  return std::exchange(to_record_, {});
}

}  // namespace clew::bridge
