// SPDX-License-Identifier: Apache-2.0
#include "process/run_members.hpp"

#include <poll.h>

#include <algorithm>
#include <csignal>

#include "cyclonedds/configuration.hpp"

namespace clew::bridge {
namespace {

using runtime::Graph;
using runtime::GraphStage;
using runtime::Topic;

bool is_foreign(const GraphStage& stage) { return !stage.deployment.exec.empty(); }

std::vector<ExpectedEndpoint> expected_endpoints(const Graph& graph, const GraphStage& stage) {
  std::vector<ExpectedEndpoint> expected;
  for (Topic topic : domain::kAllTopics) {
    const auto index = static_cast<std::size_t>(topic);
    const std::string name(domain::topic_name(topic));
    if (stage.ports.outputs[index]) {
      for (const GraphStage* reader : graph.readers_of(topic)) {
        expected.push_back({name, false, reader->info->name, is_foreign(*reader)});
      }
    }
    if (stage.ports.all_inputs()[index]) {
      const GraphStage* writer = graph.writer_of(topic);
      expected.push_back({name, true, writer->info->name, is_foreign(*writer)});
    }
  }
  return expected;
}

// Whether every process has ended in time.
bool ended_by(std::vector<Member>& members, std::chrono::steady_clock::time_point deadline) {
  while (true) {
    bool running = false;
    for (Member& member : members) {
      if (!member.child) continue;
      member.child->reap();
      running = running || member.child->running();
    }
    if (!running) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
    ::poll(nullptr, 0, 1);
  }
}

}  // namespace

void Member::begin(const ProcessStart& start) {
  progress.ticks = start.next_tick;
  const auto checkpoint = start.checkpoints.find(stage);
  if (checkpoint != start.checkpoints.end()) checkpoints.push_back(checkpoint->second);
}

void Member::note(const Frame& frame, std::chrono::steady_clock::time_point now) {
  if (frame.type == FrameType::kPreparing) {
    if (const auto doing = frame.as<Text>()) missing = {doing->text};
    joined_at = now;
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
  } else if (frame.type == FrameType::kFinished) {
    finished = frame.as<Finished>();
  }
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
    Member member;
    member.stage = stage.info->name;
    member.foreign = is_foreign(stage);
    member.external = layout.external.count(member.stage) != 0;
    member.starts_ticks = stage.ports.delayed_inputs.any();
    members.push_back(std::move(member));
  }
  return members;
}

void fill_assignment(const runtime::RunPlan& plan, const ProcessLayout& layout,
                     const std::string& stage, Assignment& assignment) {
  assignment.bundle = plan.bundle;
  assignment.pace = layout.pace;
  assignment.pace_factor = layout.pace_factor;
  assignment.realtime_priority = layout.realtime_priority;
  assignment.hash = layout.hash;
  if (const GraphStage* graph_stage = plan.graph.find(stage)) {
    assignment.expected = expected_endpoints(plan.graph, *graph_stage);
  }
}

std::string middleware_of(const GraphStage& stage, const ProcessLayout& layout) {
  const auto chosen = layout.stage_middleware.find(stage.info->name);
  if (chosen != layout.stage_middleware.end()) return chosen->second;
  return stage.deployment.middleware.empty() ? layout.middleware : stage.deployment.middleware;
}

ChildCommand command_of(const Member& member, const GraphStage& stage, const ProcessLayout& layout,
                        int domain, const std::string& run_id) {
  ChildCommand command;
  if (member.foreign) {
    command.arguments = stage.deployment.exec;
    command.may_start_others = true;
  } else {
    command.arguments = {layout.program, "component", "-", member.stage};
  }
  const auto prefix = layout.prefix.find(member.stage);
  if (prefix != layout.prefix.end()) {
    // The shell knows how to take a command line apart; it is replaced by the program at once.
    const std::vector<std::string> shell = {"/bin/sh", "-c", "exec " + prefix->second + " \"$@\"",
                                            "sh"};
    command.arguments.insert(command.arguments.begin(), shell.begin(), shell.end());
    command.keeps_terminal = true;
  }
  command.environment = environment_of(domain, run_id);
  return command;
}

std::map<std::string, std::string> environment_of(int domain, const std::string& run_id) {
  return {{"CLEW_DOMAIN_ID", std::to_string(domain)},
          {"CLEW_RUN_ID", run_id},
          {"CYCLONEDDS_URI", cyclonedds_configuration({domain, {}})}};
}

RunTally total_tally(const std::vector<Member>& members) {
  RunTally total;
  for (const Member& member : members) {
    total.merge(member.finished ? member.finished->tally : member.progress.tally);
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

void end_processes(std::vector<Member>& members, bool orderly) {
  for (Member& member : members) {
    member.link.reset();
    if (member.child && (member.foreign || !orderly)) member.child->signal(SIGTERM);
  }
  if (ended_by(members, std::chrono::steady_clock::now() + kEndGrace)) return;
  for (Member& member : members) {
    if (member.child) member.child->signal(SIGKILL);
  }
  ended_by(members, std::chrono::steady_clock::now() + kEndGrace);
}

std::string missing_text(const std::vector<Member>& members,
                         const std::vector<std::string>& observed) {
  std::string text;
  for (const Member& member : members) {
    if (!member.foreign && !member.link) text += "\n  " + member.stage + " has not reported";
    for (const std::string& missing : member.missing) text += "\n  " + missing;
  }
  for (const std::string& missing : observed) text += "\n  " + missing;
  return text;
}

std::string ticks_text(const std::vector<Member>& members) {
  std::string text;
  for (const Member& member : members) {
    if (member.foreign) continue;
    text += ' ' + member.stage + ' ' + std::to_string(member.progress.ticks);
  }
  return text;
}

}  // namespace clew::bridge
