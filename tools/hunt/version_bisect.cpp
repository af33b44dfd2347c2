// SPDX-License-Identifier: Apache-2.0
#include "hunt/version_bisect.hpp"

#include <unistd.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hunt/case_run.hpp"
#include "hunt/delta_debugging.hpp"

namespace clew::hunt {
namespace {

using core::Result;

struct Ran {
  std::string outcome;
  std::string verdict;
  RunTrace trace;
};

class VersionBisection {
 public:
  VersionBisection(const runtime::RunPlan& plan, const TwoVersions& versions,
                   const std::optional<Property>& property)
      : plan_(plan), versions_(versions), property_(property) {
    for (const runtime::GraphStage& stage : plan.graph.stages) names_.push_back(stage.info->name);
    std::sort(names_.begin(), names_.end());
  }

  Result<VersionBisectEnd> run() {
    std::vector<std::size_t> all(names_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const auto own = run_with({});
    if (end_.interrupted) return end_;
    if (!own.ok()) return own.error();
    const auto other = run_with(all);
    if (end_.interrupted) return end_;
    if (!other.ok()) {
      return core::Error{"as the program of every component: " + other.error().text(),
                         versions_.other};
    }
    end_.outcome_own = own->outcome;
    end_.outcome_other = other->outcome;
    end_.verdicts_differ = own->verdict != other->verdict;
    for (std::size_t i = 0; i < names_.size() && !end_.interrupted; ++i) try_alone(i, *own);
    if (end_.verdicts_differ) isolate(all, other->verdict);
    sort_stages();
    return end_;
  }

 private:
  /// With the other version's components of these stages.
  Result<Ran> run_with(const std::vector<std::size_t>& changed) {
    bridge::ProcessLayout layout;
    layout.program = versions_.own;
    for (const std::size_t index : changed) layout.stage_program[names_[index]] = versions_.other;
    Ran ran;
    const auto outcome =
        run_as_processes(plan_, layout, property_ ? &*property_ : nullptr, &ran.trace);
    ++end_.runs;
    if (!outcome.ok()) return outcome.error();
    if (!*outcome) {
      end_.interrupted = true;
      return core::Error{"interrupted"};
    }
    ran.outcome = (*outcome)->values.word(Field::kOutcome);
    ran.verdict = verdict_word(property_, **outcome);
    return ran;
  }

  void try_alone(std::size_t index, const Ran& own) {
    VersionStage stage;
    stage.stage = names_[index];
    const auto ran = run_with({index});
    if (ran.ok()) {
      stage.first = own.trace.first_difference(ran->trace);
      stage.outcome = ran->outcome;
      stage.changes_verdict = ran->verdict != own.verdict;
    } else {
      stage.aborted = ran.error().text();
    }
    end_.stages.push_back(std::move(stage));
  }

  void isolate(const std::vector<std::size_t>& all, const std::string& verdict_other) {
    end_.cause = minimise(all, [&](const std::vector<std::size_t>& changed) {
      if (changed.empty() || end_.interrupted) return false;
      const auto ran = run_with(changed);
      return ran.ok() && ran->verdict == verdict_other;
    });
  }

  /// The earliest first; what changes nothing last.
  void sort_stages() {
    std::vector<std::string> cause;
    for (const std::size_t index : end_.cause) cause.push_back(names_[index]);
    const auto tick_of = [](const VersionStage& stage) {
      return stage.first ? stage.first->tick : std::numeric_limits<std::uint64_t>::max();
    };
    std::stable_sort(
        end_.stages.begin(), end_.stages.end(),
        [&](const VersionStage& x, const VersionStage& y) { return tick_of(x) < tick_of(y); });
    end_.cause.clear();
    for (std::size_t i = 0; i < end_.stages.size(); ++i) {
      if (std::find(cause.begin(), cause.end(), end_.stages[i].stage) != cause.end()) {
        end_.cause.push_back(i);
      }
    }
  }

  const runtime::RunPlan& plan_;
  const TwoVersions& versions_;
  const std::optional<Property>& property_;
  std::vector<std::string> names_;
  VersionBisectEnd end_;
};

/// A process has one program: which of its stages is another version could not be chosen.
Result<void> check_has_no_groups(const runtime::RunPlan& plan) {
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    const runtime::Deployment& deployment = stage.deployment;
    if (deployment.group.empty()) continue;
    return deployment.group_place.error("stage '" + stage.info->name + "' shares the process '" +
                                        deployment.group +
                                        "', which has one version as a whole; --other-version "
                                        "takes graphs in which each stage has its own process");
  }
  return {};
}

}  // namespace

Result<VersionBisectEnd> bisect_versions(const runtime::RunPlan& plan, const TwoVersions& versions,
                                         const std::optional<Property>& property) {
  if (access(versions.other.c_str(), X_OK) != 0) {
    return core::Error{"is no program that can be started", versions.other};
  }
  CLEW_RETURN_IF_ERROR(check_has_no_groups(plan));
  return VersionBisection(plan, versions, property).run();
}

}  // namespace clew::hunt
