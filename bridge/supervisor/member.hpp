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

#include "component/input_history.hpp"
#include "line/link.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/child_process.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// Whether a stage is a third-party component, started by `exec`, that is on the wire itself:
/// a relay of ours is not.
bool is_third_party(const runtime::GraphStage& stage);

/// The process that a stage belongs to: its group, or itself.
std::string process_of(const runtime::GraphStage& stage);

/// One process's place in a run, as the supervisor sees it: a stage's, or that of a group of them.
struct Member {
  std::string stage;                ///< its name: that of the stage, or of the group
  std::vector<std::string> stages;  ///< that it is, in the graph's order
  bool third_party = false;         ///< a third-party component: no line, seen only on the wire
  bool external = false;            ///< a person starts it
  bool starts_ticks = false;
  std::string host;  ///< if on another: the process here only passes on what it says
  std::optional<ChildProcess> child;
  std::unique_ptr<Link> link;
  std::int64_t process_id = 0;       ///< of the process at the other end of its line
  std::vector<std::string> missing;  ///< what it still waits for
  bool ready = false;
  bool busy = false;                                  ///< with a step
  std::uint64_t processor_ns = 0;                     ///< that its busy threads have had
  std::chrono::steady_clock::time_point worked_at{};  ///< when it had last had more of it
  std::int64_t beats = 0;  ///< how often it has said that it lives, since the run last got on
  std::map<std::string, StepTimes> steps;  ///< by stage
  Progress progress;
  std::optional<Finished> finished;
  std::chrono::steady_clock::time_point joined_at{};  ///< when it began to wait for the others
  std::chrono::steady_clock::time_point heard_at{};
  bool silence_told = false;  ///< that it has not been heard for long
  /// When its line broke; its process is about to end.
  std::optional<std::chrono::steady_clock::time_point> left_at;
  bool was_lonely = false;  ///< killed since it did not find the others
  /// By stage, its inputs of late, which outlive its process; none: not kept.
  std::map<std::string, std::shared_ptr<InputHistory>> inputs;
  std::deque<Checkpoint> checkpoints;  ///< the newest last, at most kCheckpointsKept
  // While it is down, or has not yet caught up with itself:
  bool down = false;
  bool catching_up = false;
  std::uint64_t lost_at = 0;  ///< ticks that it had done when it was lost
  std::chrono::steady_clock::time_point restart_at{};
  std::uint32_t restarts = 0;
  std::uint32_t deaths_in_place = 0;  ///< in a row without a tick more than the one before
  std::uint32_t frozen_in_place = 0;  ///< likewise, how often it was killed since it did not report
  std::uint64_t frozen_at = 0;        ///< ticks that it had done then

  /// Takes its place in a run that begins there.
  void begin(const ProcessStart& start);
  /// Has its process keep its inputs, as far as that can be done.
  void keep_inputs();
  /// Where its process finds them: Assignment::input_histories.
  std::map<std::string, std::string> input_files() const;
  /// Notes what a frame says of the member alone: for whom it waits, its checkpoints, its end.
  void note(const Frame& frame, std::chrono::steady_clock::time_point now);
  /// How each of its stages is.
  std::vector<ComponentStatus> status(std::chrono::steady_clock::time_point now) const;
  /// The checkpoint at `tick`, if it is kept.
  const Checkpoint* checkpoint_at(std::uint64_t tick) const;
};

/// The member that is this stage; null if there is none.
Member* find_member(std::vector<Member>& members, const std::string& stage);

/// The newest tick, `limit` at most, at which all of `members` have a checkpoint; 0, the start, if
/// there is none.
std::uint64_t common_checkpoint(const std::vector<const Member*>& members, std::uint64_t limit);

/// The members of a plan, in the order of its stages.
std::vector<Member> list_members(const runtime::RunPlan& plan, const ProcessLayout& layout);

/// Whether all of ours have found whom they wait for, and whether all have finished.
bool all_ready(const std::vector<Member>& members);
bool all_finished(const std::vector<Member>& members);

/// Whether ticks are started by a third-party component, which is told no pace and no credit.
bool keeps_own_pace(const std::vector<Member>& members);

/// Ticks that all of ours have done, and that the one which starts them has.
std::uint64_t least_ticks(const std::vector<Member>& members);
std::uint64_t started_ticks(const std::vector<Member>& members);

/// What all members together have gathered.
RunStatistics total_statistics(const std::vector<Member>& members);

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
