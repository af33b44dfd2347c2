// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace clew::hunt {

/// An expanded graph as values inside each other, to be compared and changed.
struct SettingTree {
  enum class Kind { kNothing, kScalar, kList, kMap };

  Kind kind = Kind::kNothing;
  std::string text;                                          ///< of a scalar
  std::vector<SettingTree> items;                            ///< of a list
  std::vector<std::pair<std::string, SettingTree>> entries;  ///< of a map, in order

  static core::Result<SettingTree> parse(const std::string& yaml, const std::string& file);
  /// On one line of YAML.
  std::string line() const;
  const SettingTree* find(const std::string& key) const;
};

/// A place where two graphs have other values: the smallest part that can be changed alone.
struct SettingDifference {
  std::vector<std::string> path;  ///< `control`, `guard_margin_m`
  std::optional<SettingTree> a;   ///< none: it is not there
  std::optional<SettingTree> b;

  /// `control.guard_margin_m`
  std::string name() const;
};

/// Where two graphs differ, in the order of a, then of b. Parameters of a behaviour that another
/// one replaces are no differences of their own: the stage or part is one as a whole.
std::vector<SettingDifference> differences(const SettingTree& a, const SettingTree& b);

/// A graph with b's value in the place of a's.
SettingTree with(const SettingTree& tree, const SettingDifference& difference);

}  // namespace clew::hunt
