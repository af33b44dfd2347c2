// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "run/run_page.hpp"
#include "runtime/intervention.hpp"

namespace clew::bridge {

/// The account of what is changed in a run while it goes on: checks each change against the plan
/// that it changes, and knows the plan that follows. All arguments of the constructor must outlive
/// it.
class RunControl {
 public:
  RunControl(const runtime::RunPlan& first, const std::vector<runtime::StageInfo>& stages,
             const runtime::ConfigSource& files);

  /// Takes over what changed, and what was planned, in a run that is gone on with.
  /// What stages have seen is known from `first_tick` on.
  void take_over(std::vector<domain::Intervention> interventions, runtime::PlanSequence plans,
                 std::uint64_t first_tick);
  /// Plans changes before the run begins; those of one tick are one.
  core::Result<void> plan(std::vector<domain::Intervention> interventions);
  /// Changes the run from `tick` on. Refused, and nothing is changed: what runtime::change refuses,
  /// a tick at or before that of another change, and one after the run's last.
  core::Result<domain::Intervention> change(std::vector<std::string> changes, std::uint64_t tick);
  /// The first tick at which a change may follow those that are known.
  std::uint64_t next_free_tick() const;

  /// What shows the run; null: nothing can. It must outlive this.
  RunPage* page() const { return page_; }
  void set_page(RunPage* page) { page_ = page; }
  /// How somebody who commands the run calls it: its name, or the number of its domain.
  void set_called(std::string called) { called_ = std::move(called); }
  /// Opens the page; none: it is on its way, ask again.
  std::optional<core::Result<std::string>> open_page();

  const runtime::RunPlan& first() const { return first_; }
  /// In the order of their ticks, and the plan from each of them on.
  const std::vector<domain::Intervention>& interventions() const { return interventions_; }
  const runtime::PlanSequence& plans() const { return plans_; }
  /// The plan before the last intervention.
  const runtime::RunPlan& plan_before_last() const;
  /// Whether another goal was in force at `tick` than when the run began.
  bool goal_changed_by(std::uint64_t tick) const;

 private:
  core::Result<void> add(domain::Intervention intervention);
  const runtime::RunPlan& last() const { return plans_.empty() ? first_ : *plans_.back(); }

  const runtime::RunPlan& first_;
  const std::vector<runtime::StageInfo>& stages_;
  const runtime::ConfigSource& files_;
  std::vector<domain::Intervention> interventions_;
  runtime::PlanSequence plans_;
  std::uint64_t first_tick_ = 0;
  RunPage* page_ = nullptr;
  std::string called_;
};

}  // namespace clew::bridge
