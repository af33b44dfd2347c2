// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "process/child_process.hpp"
#include "process/link.hpp"
#include "process/supervisor.hpp"

namespace clew::bridge {

/// One stage's place in a run, as the supervisor sees it.
struct Member {
  std::string stage;
  bool foreign = false;   ///< a component of someone else's: no line, seen only on the wire
  bool external = false;  ///< a person starts it
  bool starts_ticks = false;
  std::optional<ChildProcess> child;
  std::unique_ptr<Link> link;
  std::vector<std::string> missing;  ///< what it still waits for
  bool ready = false;
  Progress progress;
  std::optional<Finished> finished;
  std::chrono::steady_clock::time_point joined_at{};  ///< when it began to wait for the others
  std::chrono::steady_clock::time_point heard_at{};
  bool was_lonely = false;             ///< killed since it did not find the others
  std::deque<Checkpoint> checkpoints;  ///< the newest last, at most kCheckpointsKept
  // While it is down, or has not yet caught up with itself:
  bool down = false;
  bool catching_up = false;
  std::uint64_t lost_at = 0;  ///< ticks that it had done when it was lost
  std::chrono::steady_clock::time_point restart_at{};
  std::uint32_t restarts = 0;
  std::uint32_t deaths_in_place = 0;  ///< in a row without a tick more than the one before

  /// Takes its place in a run that begins there.
  void begin(const ProcessStart& start);
  /// Notes what a frame says of the member alone: for whom it waits, its checkpoints, its end.
  void note(const Frame& frame, std::chrono::steady_clock::time_point now);
  /// The checkpoint at `tick`, if it is kept.
  const Checkpoint* checkpoint_at(std::uint64_t tick) const;
};

/// Two are enough for members that go in step; one that nobody waits for may lag behind by the lead
/// of the stage that starts ticks, which is two periods more.
inline constexpr std::size_t kCheckpointsKept = 4;

/// The newest tick, `limit` at most, at which all of `members` have a checkpoint; 0, the start, if
/// there is none.
std::uint64_t common_checkpoint(const std::vector<const Member*>& members, std::uint64_t limit);

/// The members of a plan, in the order of its stages.
std::vector<Member> list_members(const runtime::RunPlan& plan, const ProcessLayout& layout);

/// Adds to an assignment what follows from the plan and its layout: the bundle, the pace, and the
/// endpoints of others that `stage` must be matched with before tick 0.
void fill_assignment(const runtime::RunPlan& plan, const ProcessLayout& layout,
                     const std::string& stage, Assignment& assignment);

/// The middleware of a stage: from the command line, else from the graph, else the default.
std::string middleware_of(const runtime::GraphStage& stage, const ProcessLayout& layout);

/// How to start a member's process.
ChildCommand command_of(const Member& member, const runtime::GraphStage& stage,
                        const ProcessLayout& layout, int domain, const std::string& run_id);

/// What a process of a run is told: all that a component of someone else's needs.
std::map<std::string, std::string> environment_of(int domain, const std::string& run_id);

/// How long a process may take to end once it should.
inline constexpr auto kEndGrace = std::chrono::milliseconds(500);

/// Closes every line, which tells our components that the run is over, and waits for all processes
/// to end: asked by a signal if they are not ours or the run was cut off, killed if they stay.
void end_processes(std::vector<Member>& members, bool orderly);

/// What all members together have gathered.
RunTally total_tally(const std::vector<Member>& members);

/// The chained hashes of what those that have finished wrote, by topic.
std::map<std::string, core::Hash128> all_chains(const std::vector<Member>& members);

/// Samples that they have refused.
std::uint64_t total_refused_samples(const std::vector<Member>& members);

/// Who has not reported, and every endpoint that somebody waits for: `observed` by the observer. A
/// line each, after a line break.
std::string missing_text(const std::vector<Member>& members,
                         const std::vector<std::string>& observed);

/// How many ticks each member has done: ` drive 57 sense 57 ...`.
std::string ticks_text(const std::vector<Member>& members);

}  // namespace clew::bridge
