// SPDX-License-Identifier: Apache-2.0
/// How often each of the things decided that a component chooses among: rules, cells of a table,
/// neurons, categories, cases. Counted is what components tell of their insides.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "domain/inside.hpp"

namespace clew::insides {

/// One of the things that are chosen among.
struct Case {
  std::string name;
  std::uint64_t decided = 0;  ///< ticks at which it was the strongest, or the winner, or the case
  std::uint64_t held = 0;     ///< ticks at which it had a say
};

/// A choice of a component, as its inside names it: `controller.rules`.
struct Choice {
  std::string of;
  std::uint64_t ticks = 0;  ///< at which it was to be made
  bool is_closed = true;    ///< all cases are known; false: only those that came up
  std::vector<Case> cases;

  Case& case_of(const std::string& name);
  void add(const Choice& other);
};

/// The choices of one component, over all ticks that are added. What is a choice:
/// - items with a `strength`, each a rule: the strongest decides, times its `weight` if it has one;
/// - a group `strengths` of numbers by name: the same;
/// - a grid of `..strengths` (cells of a table) or `distances..` (neurons): the marked one decides;
/// - items with `since_last_win`, each a category: one that won in this tick;
/// - a text `decided`, `mode`, `phase`, or the `name` of an escape: a case.
/// A network decides when it is presented with a vector: where `vector_presented` is told and
/// false, nothing was asked of it.
class Decisions {
 public:
  void add(const domain::Inside& inside);
  const std::vector<Choice>& choices() const { return choices_; }

 private:
  void add(const domain::InsideGroup& group, const std::string& path, bool asked);
  void add_value(const domain::InsideValue& value, const std::string& path, bool asked);
  void add_items(const domain::InsideValue::Items& items, const std::string& path, bool asked);
  void add_rules(const domain::InsideValue::Items& items, const std::string& path);
  void add_categories(const domain::InsideValue::Items& items, const std::string& path);
  void add_strengths(const domain::InsideGroup& group, const std::string& path);
  void add_grid(const domain::InsideGrid& grid, const std::string& path, bool is_strength);
  Choice& choice_of(const std::string& path);

  std::vector<Choice> choices_;  ///< in the order in which they came up
};

}  // namespace clew::insides
