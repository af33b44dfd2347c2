// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "domain/intervention.hpp"
#include "runtime/node_succession.hpp"
#include "runtime/run_plan.hpp"

namespace clew::runtime {

/// Ticks of its stage's inputs that a new behaviour is fed before it takes over: what is kept of
/// them for every stage while a run goes on.
inline constexpr std::uint64_t kFedTicks = 512;

using domain::Intervention;

/// An intervention that is planned for a tick: a new behaviour is fed the kFedTicks before.
Intervention planned_at(std::uint64_t tick, std::vector<std::string> changes);

/// Reads `TICK:CHANGE`. `option` is the name in errors.
core::Result<Intervention> read_intervention(const std::string& text, const std::string& option);

/// The plan from an intervention on, if `before` is the one up to it; data files that are new come
/// from `files`, and are noted in the intervention. Refused: what is no change of this run, and
/// what would change under a component that stays (the tick, the scan's beams, what the drive can
/// do), a component of someone else's, and the drive itself.
core::Result<RunPlan> change(const RunPlan& before, const ConfigSource& files,
                             const std::vector<StageInfo>& stages, Intervention& intervention);

/// The plans of a run one after the other.
using PlanSequence = std::vector<std::shared_ptr<const RunPlan>>;

/// The plans from each of `interventions` on, in order, as change() makes them; with `only`, for
/// that stage alone, of interventions that were checked before.
core::Result<PlanSequence> change_all(const RunPlan& first,
                                      const std::vector<Intervention>& interventions,
                                      const std::vector<StageInfo>& stages,
                                      const std::optional<std::string>& only = {});

/// The texts of a run, once `interventions` are in force: all of `bundle`, those of changes still
/// to come as well, and those that came with them.
core::Result<Bundle> changed_bundle(const Bundle& bundle,
                                    const std::vector<Intervention>& interventions,
                                    const std::vector<StageInfo>& stages);

/// What becomes of the component of `stage` at an intervention; none: it stays as it is. `make`
/// makes the new one.
std::optional<Successor> successor(const RunPlan& before,
                                   const std::shared_ptr<const RunPlan>& after,
                                   const Intervention& intervention, const std::string& stage,
                                   const MakeNode& make = make_node);

/// The nodes of a plan with all that take their places; `plans` are those of change_all.
core::Result<std::vector<NodeSuccession>> make_successions(
    const RunPlan& first, const std::vector<Intervention>& interventions,
    const PlanSequence& plans);

/// Adds to a node those that take its place.
void add_successors(const RunPlan& first, const std::vector<Intervention>& interventions,
                    const PlanSequence& plans, NodeSuccession& node,
                    const MakeNode& make = make_node);

}  // namespace clew::runtime
