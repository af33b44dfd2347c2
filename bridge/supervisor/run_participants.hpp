// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/run_plan.hpp"
#include "security/run_security.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// The identity of the run's own participant, which reads what third-party components write.
inline constexpr const char* kObserverIdentity = "run";

/// Who takes part in a run of that layout, and what each may do: a process writes the outputs of
/// its stages and reads their inputs. Whoever looks on may read everything.
std::vector<SecuredParticipant> run_participants(const runtime::Graph& graph,
                                                 const ProcessLayout& layout);

/// Who may take part in a run of any graph in which each stage has a process of its own, and what
/// each may ever do there.
std::vector<SecuredParticipant> all_participants(const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::bridge
