// SPDX-License-Identifier: Apache-2.0
#include "supervisor/member.hpp"

#include <algorithm>
#include <utility>

#include "component/process_host.hpp"
#include "run/limits.hpp"
#include "supervisor/launcher.hpp"

namespace clew::bridge {

using runtime::GraphStage;

bool is_third_party(const GraphStage& stage) { return stage.deployment.is_on_the_wire(); }

std::string process_of(const GraphStage& stage) {
  return stage.deployment.group.empty() ? stage.info->name : stage.deployment.group;
}

void Member::begin(const ProcessStart& start) {
  progress.ticks = start.next_tick;
  std::map<std::string, Checkpoint> own;
  for (const std::string& each : stages) {
    const auto checkpoint = start.checkpoints.find(each);
    if (checkpoint != start.checkpoints.end()) own.insert(*checkpoint);
  }
  if (own.empty()) return;
  checkpoints.push_back(stages.size() == 1 ? own.begin()->second
                                           : pack_checkpoints(start.next_tick, own));
}

void Member::keep_inputs() {
  if (third_party) return;
  for (const std::string& each : stages) {
    auto history = InputHistory::create();
    if (!history.ok()) continue;
    inputs[each] = std::make_shared<InputHistory>(std::move(history).value());
  }
}

std::map<std::string, std::string> Member::input_files() const {
  std::map<std::string, std::string> files;
  for (const auto& [each, history] : inputs) files[each] = history->path();
  return files;
}

void Member::note(const Frame& frame, std::chrono::steady_clock::time_point now) {
  if (frame.type == FrameType::kPreparing) {
    if (const auto doing = frame.as<Text>()) missing = {doing->text};
    joined_at = now;
    ++beats;
  } else if (frame.type == FrameType::kWaiting) {
    if (const auto waiting = frame.as<Waiting>()) {
      missing = waiting->missing;
      ready = missing.empty();
    }
  } else if (frame.type == FrameType::kCheckpoint) {
    auto checkpoint = frame.as<Checkpoint>();
    if (!checkpoint) return;
    if (!checkpoints.empty() && checkpoint->tick <= checkpoints.back().tick) return;
    checkpoints.push_back(*std::move(checkpoint));
    if (checkpoints.size() > kCheckpointsKept) checkpoints.pop_front();
  } else if (frame.type == FrameType::kAlive) {
    auto alive = frame.as<Alive>().value_or(Alive{});
    ++beats;
    if (alive.busy && alive.processor_ns != processor_ns) worked_at = now;
    busy = alive.busy;
    processor_ns = alive.processor_ns;
    steps = std::move(alive.steps);
  } else if (frame.type == FrameType::kFinished) {
    finished = frame.as<Finished>();
  }
}

std::vector<ComponentStatus> Member::status(std::chrono::steady_clock::time_point now) const {
  ComponentStatus status;
  status.process = stage;
  if (link) {
    status.process_id = process_id;
    status.silent_s = std::chrono::duration<double>(now - heard_at).count();
  } else if (child && child->running()) {
    status.process_id = child->process_id();
  }
  status.ticks = progress.ticks;
  status.restarts = restarts;
  status.refused_samples = progress.refused_samples;
  std::vector<ComponentStatus> all;
  for (const std::string& each : stages) {
    status.stage = each;
    const auto known = steps.find(each);
    status.steps = known == steps.end() ? StepTimes{} : known->second;
    all.push_back(status);
  }
  return all;
}

Member* find_member(std::vector<Member>& members, const std::string& stage) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const Member& member) { return member.stage == stage; });
  return found == members.end() ? nullptr : &*found;
}

const Checkpoint* Member::checkpoint_at(std::uint64_t tick) const {
  for (const Checkpoint& checkpoint : checkpoints) {
    if (checkpoint.tick == tick) return &checkpoint;
  }
  return nullptr;
}

std::uint64_t common_checkpoint(const std::vector<const Member*>& members, std::uint64_t limit) {
  const auto& first = members.front()->checkpoints;
  for (auto candidate = first.rbegin(); candidate != first.rend(); ++candidate) {
    const bool everywhere = std::all_of(members.begin(), members.end(), [&](const Member* member) {
      return member->checkpoint_at(candidate->tick) != nullptr;
    });
    if (everywhere && candidate->tick <= limit) return candidate->tick;
  }
  return 0;
}

std::vector<Member> list_members(const runtime::RunPlan& plan, const ProcessLayout& layout) {
  std::vector<Member> members;
  for (const GraphStage& stage : plan.graph.stages) {
    Member* member = find_member(members, process_of(stage));
    if (member == nullptr) {
      member = &members.emplace_back();
      member->stage = process_of(stage);
      member->third_party = is_third_party(stage);
    }
    member->stages.push_back(stage.info->name);
    if (layout.external.count(stage.info->name) != 0) member->external = true;
    if (stage.ports.delayed_inputs.any()) member->starts_ticks = true;
    if (auto host = host_of(stage, layout); !host.empty()) member->host = std::move(host);
  }
  return members;
}

bool all_ready(const std::vector<Member>& members) {
  return std::all_of(members.begin(), members.end(),
                     [](const Member& member) { return member.third_party || member.ready; });
}

bool all_finished(const std::vector<Member>& members) {
  return std::all_of(members.begin(), members.end(),
                     [](const Member& member) { return member.third_party || member.finished; });
}

bool keeps_own_pace(const std::vector<Member>& members) {
  return std::any_of(members.begin(), members.end(), [](const Member& member) {
    return member.third_party && member.starts_ticks;
  });
}

std::uint64_t least_ticks(const std::vector<Member>& members) {
  std::uint64_t least = UINT64_MAX;
  for (const Member& member : members) {
    if (!member.third_party) least = std::min(least, member.progress.ticks);
  }
  return least;
}

std::uint64_t started_ticks(const std::vector<Member>& members) {
  std::uint64_t started = 0;
  for (const Member& member : members) {
    if (member.starts_ticks) started = member.progress.ticks;
  }
  return started;
}

RunStatistics total_statistics(const std::vector<Member>& members) {
  RunStatistics total;
  for (const Member& member : members) {
    total.merge(member.finished ? member.finished->statistics : member.progress.statistics);
  }
  return total;
}

std::map<std::string, core::Hash128> all_chains(const std::vector<Member>& members) {
  std::map<std::string, core::Hash128> chains;
  for (const Member& member : members) {
    if (!member.finished) continue;
    chains.insert(member.finished->chains.begin(), member.finished->chains.end());
  }
  return chains;
}

std::uint64_t total_refused_samples(const std::vector<Member>& members) {
  std::uint64_t total = 0;
  for (const Member& member : members) {
    total += member.finished ? member.finished->refused_samples : member.progress.refused_samples;
  }
  return total;
}

std::string missing_text(const std::vector<Member>& members,
                         const std::vector<std::string>& observed) {
  std::string text;
  for (const Member& member : members) {
    if (!member.third_party && !member.link) text += "\n  " + member.stage + " has not reported";
    for (const std::string& missing : member.missing) text += "\n  " + missing;
  }
  for (const std::string& missing : observed) text += "\n  " + missing;
  return text;
}

std::string ticks_text(const std::vector<Member>& members) {
  std::string text;
  for (const Member& member : members) {
    if (member.third_party) continue;
    text += ' ' + member.stage + ' ' + std::to_string(member.progress.ticks);
  }
  return text;
}

}  // namespace clew::bridge
