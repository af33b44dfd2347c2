// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "process/link.hpp"
#include "process/run_members.hpp"
#include "process/supervisor.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How many samples of each topic its writer and readers hold.
inline constexpr std::uint32_t kHistoryDepth = 512;
/// How far the stage that starts ticks may be ahead of the slowest member.
inline constexpr std::uint32_t kLead = kHistoryDepth / 4;

/// What a person types, anywhere, to start a component of ours: `program` is that of clew.
std::string component_line(const std::string& program, const std::string& stage, int domain);

/// Starts the processes of a run, and gives each that reports its assignment.
class Muster {
 public:
  Muster(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain, Spooling spooling);

  /// Starts a member's process.
  core::Result<void> start(Member& member) const;
  /// How to start the recorder.
  ChildCommand recorder_command() const;
  /// What a person must do to start an external member.
  std::string how_to_start(const Member& member) const;

  /// The member that says hello: none if the run has no place for it. An error if it was built from
  /// other IDL files, which no run can go on with.
  core::Result<Member*> admit(const Hello& hello, std::vector<Member>& members) const;
  Assignment assignment_for(const std::string& stage, const std::string& middleware) const;
  Assignment assignment_for(const Member& member) const;

  /// Whether a person at a debugger takes part, who may take his time.
  bool patient() const { return !layout_.external.empty() || !layout_.prefix.empty(); }
  /// How long everybody may take to be there.
  std::chrono::steady_clock::duration start_timeout() const;

 private:
  const runtime::RunPlan& plan_;
  const ProcessLayout& layout_;
  int domain_;
  Spooling spooling_;
  std::string run_id_;
};

}  // namespace clew::bridge
