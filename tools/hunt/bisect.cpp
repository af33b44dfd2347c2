// SPDX-License-Identifier: Apache-2.0
#include "hunt/bisect.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hunt/delta_debugging.hpp"
#include "hunt/setting_tree.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using runtime::Bundle;

constexpr char kGraph[] = "graph.yaml";

/// A difference of the graph, or of a file beside it.
struct Difference {
  std::optional<SettingDifference> setting;
  std::string file;

  std::string name() const { return setting ? setting->name() : file; }
};

struct Ran {
  std::string outcome;
  std::string verdict;
  RunTrace trace;
};

class Bisection {
 public:
  Bisection(const BisectSide& a, const BisectSide& b, const std::optional<Property>& property,
            const std::vector<runtime::StageInfo>& stages)
      : a_(a), b_(b), property_(property), stages_(stages) {}

  Result<BisectEnd> run() {
    CLEW_RETURN_IF_ERROR(find_differences());
    auto of_a = run_bundle(a_.bundle);
    if (end_.interrupted) return end_;
    if (!of_a.ok()) return of_a.error();
    const auto of_b = run_bundle(b_.bundle);
    if (end_.interrupted) return end_;
    if (!of_b.ok()) return of_b.error();
    ran_a_ = std::move(of_a).value();
    end_.outcome_a = ran_a_.outcome;
    end_.outcome_b = of_b->outcome;
    verdict_b_ = of_b->verdict;
    end_.verdicts_differ = ran_a_.verdict != verdict_b_;
    try_each_alone();
    if (end_.verdicts_differ) isolate();
    sort_settings();
    return end_;
  }

 private:
  Result<void> find_differences() {
    auto tree_a = SettingTree::parse(a_.bundle.at(kGraph), a_.name);
    if (!tree_a.ok()) return tree_a.error();
    const auto tree_b = SettingTree::parse(b_.bundle.at(kGraph), b_.name);
    if (!tree_b.ok()) return tree_b.error();
    for (SettingDifference& found : differences(*tree_a, *tree_b)) {
      // The names of the graph, world and robot decide nothing: their files do.
      const std::string name = found.name();
      if (name != "name" && name != "world" && name != "robot") differences_.push_back({found, {}});
    }
    for (const auto& [file, text] : b_.bundle) {
      const auto of_a = a_.bundle.find(file);
      if (file != kGraph && of_a != a_.bundle.end() && of_a->second != text) {
        differences_.push_back({std::nullopt, file});
      }
    }
    tree_a_ = std::move(tree_a).value();
    return {};
  }

  /// Run A with B's values of these differences. Files that only B has are there for its graph.
  Bundle mixed(const std::vector<std::size_t>& changed) const {
    Bundle bundle = a_.bundle;
    bundle.insert(b_.bundle.begin(), b_.bundle.end());
    SettingTree tree = tree_a_;
    for (const std::size_t index : changed) {
      const Difference& difference = differences_[index];
      if (difference.setting) {
        tree = with(tree, *difference.setting);
      } else {
        bundle[difference.file] = b_.bundle.at(difference.file);
      }
    }
    bundle[kGraph] = tree.line() + '\n';
    return bundle;
  }

  Result<Ran> run_bundle(const Bundle& bundle) {
    const auto plan = runtime::prepare_run(bundle, stages_);
    if (!plan.ok()) return plan.error();
    Ran ran;
    const auto outcome = run_plan(*plan, property_ ? &*property_ : nullptr, &ran.trace);
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

  void try_each_alone() {
    for (std::size_t i = 0; i < differences_.size() && !end_.interrupted; ++i) {
      BisectSetting setting;
      setting.name = differences_[i].name();
      if (const auto& found = differences_[i].setting) {
        setting.a = found->a ? found->a->line() : "";
        setting.b = found->b ? found->b->line() : "";
      }
      const auto ran = run_bundle(mixed({i}));
      if (ran.ok()) {
        setting.first = ran_a_.trace.first_difference(ran->trace);
        setting.outcome = ran->outcome;
        setting.changes_verdict = ran->verdict != ran_a_.verdict;
      } else {
        setting.refused = ran.error().text();
      }
      end_.settings.push_back(std::move(setting));
    }
  }

  void isolate() {
    std::vector<std::size_t> all(differences_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    end_.cause = minimise(all, [&](const std::vector<std::size_t>& changed) {
      if (changed.empty() || end_.interrupted) return false;
      const auto ran = run_bundle(mixed(changed));
      return ran.ok() && ran->verdict == verdict_b_;
    });
  }

  /// The earliest first; what changes nothing last.
  void sort_settings() {
    std::vector<std::size_t> order(end_.settings.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto tick_of = [&](std::size_t index) {
      const BisectSetting& setting = end_.settings[index];
      return setting.first ? setting.first->tick : std::numeric_limits<std::uint64_t>::max();
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return tick_of(x) < tick_of(y); });
    std::vector<BisectSetting> sorted;
    std::vector<std::size_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      place[order[i]] = i;
      sorted.push_back(std::move(end_.settings[order[i]]));
    }
    end_.settings = std::move(sorted);
    for (std::size_t& index : end_.cause) index = place[index];
    std::sort(end_.cause.begin(), end_.cause.end());
  }

  const BisectSide& a_;
  const BisectSide& b_;
  const std::optional<Property>& property_;
  const std::vector<runtime::StageInfo>& stages_;
  SettingTree tree_a_;
  std::vector<Difference> differences_;
  Ran ran_a_;
  std::string verdict_b_;
  BisectEnd end_;
};

}  // namespace

Result<BisectEnd> bisect(const BisectSide& a, const BisectSide& b,
                         const std::optional<Property>& property,
                         const std::vector<runtime::StageInfo>& stages) {
  for (const BisectSide* side : {&a, &b}) {
    if (side->bundle.count(kGraph) == 0) return core::Error{"holds no graph", side->name};
  }
  return Bisection(a, b, property, stages).run();
}

}  // namespace clew::hunt
