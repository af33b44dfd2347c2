// SPDX-License-Identifier: Apache-2.0
#include "hunt/tick_bisect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hunt/case_run.hpp"
#include "replay/black_box_past.hpp"
#include "replay/branch.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::hunt {
namespace {

using core::Result;

/// Evenly spaced probes besides the first; halving does the rest.
constexpr std::uint64_t kSpacedProbes = 16;

/// The ticks at which a branch may begin.
struct TickRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

Result<TickRange> branch_ticks(const bridge::RunRecording& recording) {
  TickRange ticks;
  const auto branch = bridge::branch_of(recording);
  if (!branch.ok()) return branch.error();
  if (*branch) ticks.first = (*branch)->tick;
  ticks.first = std::max(ticks.first, bridge::first_fed_tick(recording));
  const auto survey = recording.survey_samples();
  if (!survey.ok()) return survey.error();
  const auto states = survey->topics.find(domain::Topic::kState);
  if (states == survey->topics.end()) return core::Error{"has no states", recording.path()};
  // The state of a run's end begins a tick in which nobody steps.
  ticks.last = std::max(ticks.first, states->second.last_tick);
  if (ticks.last > ticks.first) --ticks.last;
  return ticks;
}

class TickBisection {
 public:
  TickBisection(const bridge::RunRecording& recording, const runtime::RunPlan& recorded,
                const runtime::RunPlan& changed, const std::optional<Property>& property)
      : recording_(recording), recorded_(recorded), changed_(changed), property_(property) {}

  Result<TickBisectEnd> run() {
    const auto ticks = branch_ticks(recording_);
    if (!ticks.ok()) return ticks.error();
    CLEW_RETURN_IF_ERROR(check_faithful(ticks->last));
    auto unchanged = probe(recorded_, ticks->first);
    if (end_.interrupted) return end_;
    if (!unchanged.ok()) return unchanged.error();
    end_.unchanged = std::move(unchanged).value();
    CLEW_RETURN_IF_ERROR(probe_spaced(*ticks));
    if (!end_.interrupted) CLEW_RETURN_IF_ERROR(halve(*ticks));
    return end_;
  }

 private:
  Result<void> check_faithful(std::uint64_t last) const {
    const auto unfaithful = bridge::find_unfaithful(recording_, recorded_, last);
    if (!unfaithful.ok()) return unfaithful.error();
    if (!*unfaithful) return {};
    return core::Error{fmt::format("{} does not do what is recorded, at tick {}: no branch can go "
                                   "on from later ones",
                                   (*unfaithful)->component, (*unfaithful)->first->tick),
                       recording_.path()};
  }

  /// Runs `plan` from `tick` on to its end.
  Result<TickProbe> probe(const runtime::RunPlan& plan, std::uint64_t tick) {
    const auto outcome =
        run_branch(recording_, recorded_, plan, tick, property_ ? &*property_ : nullptr);
    if (!outcome.ok()) return outcome.error();
    if (!*outcome) {
      end_.interrupted = true;
      return core::Error{"interrupted"};
    }
    TickProbe probe{tick, (*outcome)->values.word(Field::kOutcome), {}};
    probe.verdict = verdict_word(property_, **outcome);
    return probe;
  }

  Result<void> probe_changed(std::uint64_t tick) {
    auto made = probe(changed_, tick);
    if (end_.interrupted) return {};
    if (!made.ok()) return made.error();
    const auto place =
        std::find_if(end_.probes.begin(), end_.probes.end(),
                     [&](const TickProbe& other) { return other.tick > made->tick; });
    end_.probes.insert(place, std::move(made).value());
    return {};
  }

  Result<void> probe_spaced(const TickRange& ticks) {
    const std::uint64_t span = ticks.last - ticks.first;
    const std::uint64_t probes = std::min(kSpacedProbes, span);
    for (std::uint64_t i = 0; i <= probes && !end_.interrupted; ++i) {
      const std::uint64_t offset = probes == 0 ? 0 : span / probes * i + span % probes * i / probes;
      CLEW_RETURN_IF_ERROR(probe_changed(ticks.first + offset));
    }
    return {};
  }

  bool differs(const TickProbe& probe) const { return probe.verdict != end_.unchanged.verdict; }

  /// Between the last probe that differs and the next one.
  Result<void> halve(const TickRange& ticks) {
    for (std::size_t i = 1; i < end_.probes.size(); ++i) {
      end_.turns += end_.probes[i].verdict != end_.probes[i - 1].verdict ? 1 : 0;
    }
    const auto last = std::find_if(end_.probes.rbegin(), end_.probes.rend(),
                                   [&](const TickProbe& probe) { return differs(probe); });
    if (last == end_.probes.rend()) return {};
    std::uint64_t low = last->tick;
    std::uint64_t high = last == end_.probes.rbegin() ? ticks.last + 1 : std::prev(last)->tick;
    while (high - low > 1 && !end_.interrupted) {
      const std::uint64_t middle = low + (high - low) / 2;
      CLEW_RETURN_IF_ERROR(probe_changed(middle));
      const auto made = std::find_if(end_.probes.begin(), end_.probes.end(),
                                     [&](const TickProbe& probe) { return probe.tick == middle; });
      if (made == end_.probes.end()) break;
      (differs(*made) ? low : high) = middle;
    }
    if (!end_.interrupted) end_.last_tick = low;
    return {};
  }

  const bridge::RunRecording& recording_;
  const runtime::RunPlan& recorded_;
  const runtime::RunPlan& changed_;
  const std::optional<Property>& property_;
  TickBisectEnd end_;
};

}  // namespace

Result<TickBisectEnd> bisect_ticks(const bridge::RunRecording& recording,
                                   const runtime::RunPlan& recorded,
                                   const runtime::RunPlan& changed,
                                   const std::optional<Property>& property) {
  return TickBisection(recording, recorded, changed, property).run();
}

}  // namespace clew::hunt
