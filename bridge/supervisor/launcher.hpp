// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "line/frames.hpp"
#include "line/run_key.hpp"
#include "runtime/run_plan.hpp"
#include "security/run_security.hpp"
#include "supervisor/member.hpp"
#include "supervisor/process_layout.hpp"
#include "vendors/third_party_environment.hpp"

namespace clew::bridge {

/// What a person must do, anywhere, to start the component of a stage, be it ours or not: `program`
/// is that of clew.
std::string how_to_start(const runtime::RunPlan& plan, const runtime::GraphStage& stage,
                         const std::string& program, int domain,
                         const ThirdPartyEnvironment& environment);

/// The files of a run that a stage is told: all, but the world only to one that may know it.
runtime::Bundle bundle_for(const runtime::RunPlan& plan, const runtime::GraphStage& stage);

/// Adds to an assignment what follows from the plan and its layout: the bundle, the pace, and the
/// endpoints that those of `stages`, which share a process, must be matched with before tick 0.
void fill_assignment(const runtime::RunPlan& plan, const ProcessLayout& layout,
                     const std::vector<std::string>& stages, Assignment& assignment);

/// The middleware of a stage: from the command line, else from the graph, else the default.
std::string middleware_of(const runtime::GraphStage& stage, const ProcessLayout& layout);

/// The host on which a stage's process runs; empty: this one.
std::string host_of(const runtime::GraphStage& stage, const ProcessLayout& layout);

/// How to start a member's process.
ChildCommand command_of(const Member& member, const runtime::RunPlan& plan,
                        const ProcessLayout& layout, const ThirdPartyEnvironment& environment);

/// How a program is started: ChildProcess::start but in tests.
using StartProcess = std::function<core::Result<ChildProcess>(const ChildCommand&)>;

/// Starts the processes of a run, and gives each that reports its assignment.
class Launcher {
 public:
  /// `security` may be null: the run is open.
  Launcher(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain, Spooling spooling,
           StartProcess start = ChildProcess::start, RunSecurity::Shared security = nullptr);

  /// Lets those that report from now on hand over what they write.
  void spool();
  /// Starts a member's process.
  core::Result<void> start(Member& member) const;
  /// How to start the recorder.
  ChildCommand recorder_command() const;
  /// What a person must do to start an external member.
  std::string how_to_start(const Member& member) const;

  /// The member that says hello: none if the run has no place for it. An error if it was built from
  /// other IDL files, which no run can go on with.
  core::Result<Member*> admit(const Hello& hello, std::vector<Member>& members) const;
  Assignment assignment_for(const std::vector<std::string>& stages,
                            const std::string& middleware) const;
  Assignment assignment_for(const Member& member) const;
  /// Of the run's own participant, which reads what third-party components write.
  Assignment assignment_for_observer() const;
  /// With every file of the run, the world too.
  Assignment assignment_for_watcher() const;

  /// Whether a person at a debugger takes part. Then the run waits longer.
  bool patient() const { return !layout_.external.empty() || !layout_.prefix.empty(); }
  /// How long it waits else: longer over a network than on one computer.
  const Patience& patience() const { return layout_.hosts ? kPatienceOverHosts : kPatienceHere; }
  /// How long the processes of a run may take to start.
  std::chrono::steady_clock::duration start_timeout() const;

 private:
  /// Of a participant of the run; none if the run is open.
  std::optional<SecurityFiles> security_of(const std::string& name,
                                           const std::string& middleware) const;
  std::optional<NetworkAddresses> network() const;
  const ThirdPartyEnvironment& environment_of(const Member& member) const;

  const runtime::RunPlan& plan_;
  const ProcessLayout& layout_;
  int domain_;
  Spooling spooling_;
  StartProcess start_;
  std::string run_id_;
  RunKey run_key_;
  RunSecurity::Shared security_;
  ThirdPartyEnvironment environment_;
  std::map<std::string, ThirdPartyEnvironment> secured_environments_;  ///< by stage
};

}  // namespace clew::bridge
