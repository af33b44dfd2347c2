// SPDX-License-Identifier: Apache-2.0
#include "hunt/bisect_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hunt/delta_debugging.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using Indices = std::vector<std::size_t>;

struct Ran {
  std::string outcome;
  std::string verdict;
  RunTrace trace;
};

class Search {
 public:
  Search(BisectProbe probe, const std::optional<Property>& property)
      : probe_(std::move(probe)), property_(property) {
    end_.differences = std::move(probe_.differences);
  }

  Result<BisectEnd> run() {
    const auto a = ran([&](RunTrace& trace) { return probe_.run({}, trace); });
    if (end_.interrupted) return end_;
    if (!a.ok()) return a.error();
    const auto b = ran(probe_.run_b);
    if (end_.interrupted) return end_;
    if (!b.ok()) return b.error();
    end_.outcome_a = a->outcome;
    end_.outcome_b = b->outcome;
    end_.verdicts_differ = a->verdict != b->verdict;
    for (std::size_t i = 0; i < end_.differences.size() && !end_.interrupted; ++i) try_alone(i, *a);
    if (end_.verdicts_differ) isolate(b->verdict);
    sort();
    return end_;
  }

 private:
  template <typename Run>
  Result<Ran> ran(const Run& run) {
    Ran ran;
    const auto outcome = run(ran.trace);
    if (!outcome.ok()) return outcome.error();
    ++end_.runs;
    if (!*outcome) {
      end_.interrupted = true;
      return core::Error{"interrupted"};
    }
    ran.outcome = (*outcome)->values.word(Field::kOutcome);
    ran.verdict = verdict_word(property_, **outcome);
    return ran;
  }
  Result<Ran> ran_with(const Indices& changed) {
    return ran([&](RunTrace& trace) { return probe_.run(changed, trace); });
  }

  void try_alone(std::size_t index, const Ran& a) {
    BisectDifference& difference = end_.differences[index];
    const auto alone = ran_with({index});
    if (alone.ok()) {
      difference.first = a.trace.first_difference(alone->trace);
      difference.outcome = alone->outcome;
      difference.changes_verdict = alone->verdict != a.verdict;
    } else {
      difference.refused = alone.error().text();
    }
  }

  void isolate(const std::string& verdict_b) {
    Indices all(end_.differences.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    end_.cause = minimise(all, [&](const Indices& changed) {
      if (changed.empty() || end_.interrupted) return false;
      const auto some = ran_with(changed);
      return some.ok() && some->verdict == verdict_b;
    });
  }

  /// The earliest first; what changes nothing last.
  void sort() {
    Indices order(end_.differences.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto tick_of = [&](std::size_t index) {
      const auto& first = end_.differences[index].first;
      return first ? first->tick : std::numeric_limits<std::uint64_t>::max();
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return tick_of(x) < tick_of(y); });
    std::vector<BisectDifference> sorted;
    Indices place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      place[order[i]] = i;
      sorted.push_back(std::move(end_.differences[order[i]]));
    }
    end_.differences = std::move(sorted);
    for (std::size_t& index : end_.cause) index = place[index];
    std::sort(end_.cause.begin(), end_.cause.end());
  }

  BisectProbe probe_;
  const std::optional<Property>& property_;
  BisectEnd end_;
};

}  // namespace

Result<BisectEnd> search_bisect(BisectProbe probe, const std::optional<Property>& property) {
  return Search(std::move(probe), property).run();
}

}  // namespace clew::hunt
