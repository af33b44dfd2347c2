// SPDX-License-Identifier: Apache-2.0
#include "run/run_control.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace clew::bridge {

using core::Result;
using domain::Intervention;

RunControl::RunControl(const runtime::RunPlan& first, const std::vector<runtime::StageInfo>& stages,
                       const runtime::ConfigSource& files)
    : first_(first), stages_(stages), files_(files) {}

void RunControl::take_over(std::vector<Intervention> interventions, runtime::PlanSequence plans,
                           std::uint64_t first_tick) {
  first_tick_ = first_tick;
  interventions_ = std::move(interventions);
  plans_ = std::move(plans);
}

std::optional<Result<std::string>> RunControl::open_page() {
  if (page_ == nullptr) return core::Error{"this run cannot be shown"};
  return page_->open(called_);
}

Result<void> RunControl::add(Intervention intervention) {
  auto after = runtime::change(last(), files_, stages_, intervention);
  if (!after.ok()) return after.error();
  plans_.push_back(std::make_shared<const runtime::RunPlan>(std::move(after).value()));
  interventions_.push_back(std::move(intervention));
  return {};
}

Result<void> RunControl::plan(std::vector<Intervention> interventions) {
  std::stable_sort(interventions.begin(), interventions.end(),
                   [](const Intervention& a, const Intervention& b) { return a.tick < b.tick; });
  for (auto first = interventions.begin(); first != interventions.end();) {
    Intervention merged = std::move(*first);
    for (++first; first != interventions.end() && first->tick == merged.tick; ++first) {
      merged.changes.insert(merged.changes.end(), first->changes.begin(), first->changes.end());
    }
    const std::uint64_t tick = merged.tick;
    const auto added = add(std::move(merged));
    if (added.ok()) continue;
    return core::Error{added.error().text(), "--at " + std::to_string(tick)};
  }
  return {};
}

Result<Intervention> RunControl::change(std::vector<std::string> changes, std::uint64_t tick) {
  if (tick < next_free_tick()) {
    return core::Error{"the run changes at tick " + std::to_string(interventions_.back().tick) +
                       " already: the next change is possible at tick " +
                       std::to_string(next_free_tick())};
  }
  if (tick > first_.graph.max_ticks) {
    return core::Error{"tick " + std::to_string(tick) + " never comes: the run ends at tick " +
                       std::to_string(first_.graph.max_ticks) + ", its max_ticks"};
  }
  Intervention intervention = runtime::planned_at(tick, std::move(changes));
  intervention.fed_from = std::max(intervention.fed_from, first_tick_);
  CLEW_RETURN_IF_ERROR(add(std::move(intervention)));
  return interventions_.back();
}

std::uint64_t RunControl::next_free_tick() const {
  return interventions_.empty() ? 1 : interventions_.back().tick + 1;
}

const runtime::RunPlan& RunControl::plan_before_last() const {
  return plans_.size() < 2 ? first_ : *plans_[plans_.size() - 2];
}

bool RunControl::goal_changed_by(std::uint64_t tick) const {
  return std::any_of(interventions_.begin(), interventions_.end(), [&](const Intervention& known) {
    return known.tick <= tick &&
           std::any_of(known.changes.begin(), known.changes.end(),
                       [](const std::string& change) { return change.rfind("goal=", 0) == 0; });
  });
}

}  // namespace clew::bridge
