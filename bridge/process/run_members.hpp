// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  std::vector<std::string> missing;  ///< endpoints that it still waits for
  bool ready = false;
  Progress progress;
  std::optional<Finished> finished;
};

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

/// Who has not reported, and every endpoint that somebody waits for: `observed` by the observer. A
/// line each, after a line break.
std::string missing_text(const std::vector<Member>& members,
                         const std::vector<std::string>& observed);

/// How many ticks each member has done: ` drive 57 sense 57 ...`.
std::string ticks_text(const std::vector<Member>& members);

}  // namespace clew::bridge
