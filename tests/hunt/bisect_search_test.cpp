// SPDX-License-Identifier: Apache-2.0
#include "hunt/bisect_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace clew::hunt {
namespace {

using Indices = std::vector<std::size_t>;

bool holds(const Indices& changed, std::size_t index) {
  return std::count(changed.begin(), changed.end(), index) > 0;
}

/// Five differences: `idle` changes nothing, `both` and `needs` change the outcome together, `late`
/// a sample of tick 9, `alone` none can have without `both`.
class Five {
 public:
  enum : std::size_t { kIdle, kBoth, kLate, kNeeds, kAlone };

  BisectProbe probe() {
    BisectProbe probe;
    for (const char* name : {"idle", "both", "late", "needs", "alone"}) {
      BisectDifference one;
      one.name = name;
      probe.differences.push_back(one);
    }
    probe.run = [this](const Indices& changed, RunTrace& trace) { return run(changed, trace); };
    probe.run_b = [this](RunTrace& trace) {
      return run({kIdle, kBoth, kLate, kNeeds, kAlone}, trace);
    };
    return probe;
  }

  int runs = 0;
  int interrupted_at = -1;

 private:
  BisectProbe::Outcome run(const Indices& changed, RunTrace& trace) {
    if (holds(changed, kAlone) && !holds(changed, kBoth)) return core::Error{"does not fit"};
    if (runs++ == interrupted_at) return std::optional<CaseOutcome>();
    for (std::uint64_t tick = 0; tick < 10; ++tick) {
      const bool differs = (tick == 9 && holds(changed, kLate)) ||
                           (tick == 4 && holds(changed, kBoth)) ||
                           (tick == 2 && holds(changed, kNeeds));
      EXPECT_TRUE(trace.add({domain::Topic::kState, tick, tick, differs ? "other" : "same"}).ok());
    }
    CaseOutcome outcome;
    const bool is_b = holds(changed, kBoth) && holds(changed, kNeeds);
    outcome.values.set_word(Field::kOutcome, is_b ? "timeout" : "reached");
    return std::optional<CaseOutcome>(outcome);
  }
};

TEST(BisectSearch, FindsTheFewestThatTogetherGiveTheOtherOutcome) {
  Five five;

  const auto end = search_bisect(five.probe(), {});

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(end->outcome_a, "reached");
  EXPECT_EQ(end->outcome_b, "timeout");
  EXPECT_TRUE(end->verdicts_differ);
  ASSERT_EQ(end->cause.size(), 2u);
  EXPECT_EQ(end->differences[end->cause[0]].name, "needs");
  EXPECT_EQ(end->differences[end->cause[1]].name, "both");
  EXPECT_EQ(end->runs, static_cast<std::size_t>(five.runs));
}

TEST(BisectSearch, SortsWhatEachDoesAloneByItsFirstTick) {
  Five five;

  const auto end = search_bisect(five.probe(), {});

  ASSERT_TRUE(end.ok()) << end.error().text();
  std::vector<std::string> names;
  for (const BisectDifference& one : end->differences) {
    names.push_back(one.name + (one.first ? " " + std::to_string(one.first->tick) : "") +
                    (one.refused.empty() ? "" : " " + one.refused));
    EXPECT_FALSE(one.changes_verdict) << one.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"needs 2", "both 4", "late 9", "idle",
                                             "alone does not fit"}));
}

TEST(BisectSearch, EndsWhereARunIsInterrupted) {
  for (int at = 0; at < 8; ++at) {
    Five five;
    five.interrupted_at = at;

    const auto end = search_bisect(five.probe(), {});

    ASSERT_TRUE(end.ok()) << end.error().text();
    EXPECT_TRUE(end->interrupted) << at;
    EXPECT_EQ(five.runs, at + 1);
  }
}

TEST(BisectSearch, RefusesWhatTheTwoRunsRefuse) {
  BisectProbe probe;
  probe.run = [](const Indices&, RunTrace&) -> BisectProbe::Outcome {
    return std::optional<CaseOutcome>(CaseOutcome());
  };
  probe.run_b = [](RunTrace&) -> BisectProbe::Outcome { return core::Error{"no such program"}; };

  EXPECT_EQ(search_bisect(probe, {}).error().text(), "no such program");
  probe.run = [](const Indices&, RunTrace&) -> BisectProbe::Outcome {
    return core::Error{"no such run"};
  };
  EXPECT_EQ(search_bisect(probe, {}).error().text(), "no such run");
}

}  // namespace
}  // namespace clew::hunt
