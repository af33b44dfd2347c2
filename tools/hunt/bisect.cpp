// SPDX-License-Identifier: Apache-2.0
#include "hunt/bisect.hpp"

#include <utility>

#include "hunt/setting_tree.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using runtime::Bundle;

constexpr char kGraph[] = "graph.yaml";

/// A difference of the graph, or of a file beside it.
struct SideDifference {
  std::optional<SettingDifference> setting;
  std::string file;

  BisectDifference described() const {
    BisectDifference described;
    described.name = setting ? setting->name() : file;
    if (setting && setting->a) described.a = setting->a->line();
    if (setting && setting->b) described.b = setting->b->line();
    return described;
  }
};

class Sides {
 public:
  Sides(const BisectSide& a, const BisectSide& b) : a_(a), b_(b) {}

  Result<void> find_differences() {
    auto tree_a = SettingTree::parse(a_.bundle.at(kGraph), a_.name);
    if (!tree_a.ok()) return tree_a.error();
    const auto tree_b = SettingTree::parse(b_.bundle.at(kGraph), b_.name);
    if (!tree_b.ok()) return tree_b.error();
    for (SettingDifference& found : hunt::differences(*tree_a, *tree_b)) {
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

  std::vector<BisectDifference> described() const {
    std::vector<BisectDifference> described;
    for (const SideDifference& one : differences_) described.push_back(one.described());
    return described;
  }

  /// Run A with B's values of these differences. Files that only B has are there for its graph.
  Bundle mixed(const std::vector<std::size_t>& changed) const {
    if (changed.empty()) return a_.bundle;
    Bundle bundle = a_.bundle;
    bundle.insert(b_.bundle.begin(), b_.bundle.end());
    SettingTree tree = tree_a_;
    for (const std::size_t index : changed) {
      const SideDifference& difference = differences_[index];
      if (difference.setting) {
        tree = with(tree, *difference.setting);
      } else {
        bundle[difference.file] = b_.bundle.at(difference.file);
      }
    }
    bundle[kGraph] = tree.line() + '\n';
    return bundle;
  }

 private:
  const BisectSide& a_;
  const BisectSide& b_;
  SettingTree tree_a_;
  std::vector<SideDifference> differences_;
};

}  // namespace

Result<BisectEnd> bisect(const BisectSide& a, const BisectSide& b,
                         const std::optional<Property>& property,
                         const std::vector<runtime::StageInfo>& stages) {
  for (const BisectSide* side : {&a, &b}) {
    if (side->bundle.count(kGraph) == 0) return core::Error{"holds no graph", side->name};
  }
  Sides sides(a, b);
  CLEW_RETURN_IF_ERROR(sides.find_differences());
  const auto run = [&](const Bundle& bundle, RunTrace& trace) -> BisectProbe::Outcome {
    const auto plan = runtime::prepare_run(bundle, stages);
    if (!plan.ok()) return plan.error();
    return run_plan(*plan, property ? &*property : nullptr, &trace);
  };
  return search_bisect({sides.described(),
                        [&](const std::vector<std::size_t>& changed, RunTrace& trace) {
                          return run(sides.mixed(changed), trace);
                        },
                        [&](RunTrace& trace) { return run(b.bundle, trace); }},
                       property);
}

}  // namespace clew::hunt
