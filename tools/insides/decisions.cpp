// SPDX-License-Identifier: Apache-2.0
#include "insides/decisions.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <variant>

namespace clew::insides {
namespace {

using domain::InsideGroup;
using domain::InsideValue;

/// Texts that say which case it was.
constexpr std::array<std::string_view, 3> kCases = {"decided", "mode", "phase"};
constexpr std::string_view kEscape = "escape.name";

template <typename Value>
const Value* find(const InsideGroup& group, std::string_view name) {
  for (const InsideValue& value : group.values()) {
    if (value.name == name) return std::get_if<Value>(&value.value);
  }
  return nullptr;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

bool is_case(std::string_view path, std::string_view name) {
  return std::find(kCases.begin(), kCases.end(), name) != kCases.end() || path == kEscape;
}

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + '.' + name;
}

/// What an item is called: by its first text, else by its place.
std::string name_of(const InsideGroup& item, std::size_t place) {
  for (const InsideValue& value : item.values()) {
    if (const auto* text = std::get_if<std::string>(&value.value)) return *text;
  }
  return std::to_string(place + 1);
}

}  // namespace

Case& Choice::case_of(const std::string& name) {
  const auto found = std::find_if(cases.begin(), cases.end(),
                                  [&](const Case& known) { return known.name == name; });
  if (found != cases.end()) return *found;
  cases.push_back({name, 0, 0});
  return cases.back();
}

void Choice::add(const Choice& other) {
  ticks += other.ticks;
  is_closed = is_closed && other.is_closed;
  for (const Case& one : other.cases) {
    Case& mine = case_of(one.name);
    mine.decided += one.decided;
    mine.held += one.held;
  }
}

void Decisions::add(const domain::Inside& inside) {
  const bool* presented = find<bool>(inside.values, "vector_presented");
  add(inside.values, {}, presented == nullptr || *presented);
}

void Decisions::add(const InsideGroup& group, const std::string& path, bool asked) {
  for (const InsideValue& value : group.values()) add_value(value, joined(path, value.name), asked);
}

void Decisions::add_value(const InsideValue& value, const std::string& path, bool asked) {
  if (const auto* text = std::get_if<std::string>(&value.value)) {
    if (!is_case(path, value.name)) return;
    Choice& choice = choice_of(path);
    choice.is_closed = false;
    ++choice.ticks;
    Case& named = choice.case_of(*text);
    ++named.decided;
    ++named.held;
  } else if (const auto* grid = std::get_if<domain::InsideGrid>(&value.value)) {
    const bool is_strength = ends_with(value.name, "strengths");
    const bool is_lattice = value.name.rfind("distances", 0) == 0;
    if (asked && grid->marked && (is_strength || is_lattice)) add_grid(*grid, path, is_strength);
  } else if (const auto* group = std::get_if<InsideGroup>(&value.value)) {
    if (value.name == "strengths") return add_strengths(*group, path);
    add(*group, path, asked);
  } else if (const auto* items = std::get_if<InsideValue::Items>(&value.value)) {
    add_items(*items, path, asked);
  }
}

void Decisions::add_items(const InsideValue::Items& items, const std::string& path, bool asked) {
  if (items.empty()) return;
  if (find<double>(items.front(), "strength") != nullptr) return add_rules(items, path);
  if (find<double>(items.front(), "since_last_win") != nullptr) {
    if (asked) add_categories(items, path);
    return;
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    add(items[i], path + '[' + name_of(items[i], i) + ']', asked);
  }
}

void Decisions::add_rules(const InsideValue::Items& items, const std::string& path) {
  Choice& choice = choice_of(path);
  ++choice.ticks;
  std::optional<std::size_t> decisive;
  double most = 0.0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double* strength = find<double>(items[i], "strength");
    const double* weight = find<double>(items[i], "weight");
    const double say =
        (strength == nullptr ? 0.0 : *strength) * (weight == nullptr ? 1.0 : *weight);
    Case& rule = choice.case_of(std::to_string(i + 1));
    if (say > 0.0) ++rule.held;
    if (say <= most) continue;
    most = say;
    decisive = i;
  }
  if (decisive) ++choice.cases[*decisive].decided;
}

void Decisions::add_categories(const InsideValue::Items& items, const std::string& path) {
  Choice& choice = choice_of(path);
  choice.is_closed = false;
  ++choice.ticks;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double* number = find<double>(items[i], "category");
    const auto place = number == nullptr ? i : static_cast<std::size_t>(*number);
    Case& category = choice.case_of(std::to_string(place));
    ++category.held;
    const double* since = find<double>(items[i], "since_last_win");
    if (since != nullptr && *since == 0.0) ++category.decided;
  }
}

void Decisions::add_strengths(const InsideGroup& group, const std::string& path) {
  Choice& choice = choice_of(path);
  ++choice.ticks;
  std::string decisive;
  double most = 0.0;
  for (const InsideValue& value : group.values()) {
    const auto* strength = std::get_if<double>(&value.value);
    if (strength == nullptr) continue;
    Case& rule = choice.case_of(value.name);
    if (*strength > 0.0) ++rule.held;
    if (*strength <= most) continue;
    most = *strength;
    decisive = value.name;
  }
  if (!decisive.empty()) ++choice.case_of(decisive).decided;
}

void Decisions::add_grid(const domain::InsideGrid& grid, const std::string& path,
                         bool is_strength) {
  Choice& choice = choice_of(path);
  ++choice.ticks;
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    if (choice.cases.size() == i) {
      choice.cases.push_back({"row " + std::to_string(i / grid.columns + 1) + ", column " +
                                  std::to_string(i % grid.columns + 1),
                              0, 0});
    }
    const bool decided = grid.marked == i;
    if (decided) ++choice.cases[i].decided;
    if (decided || (is_strength && grid.values[i] > 0.0)) ++choice.cases[i].held;
  }
}

Choice& Decisions::choice_of(const std::string& path) {
  const auto found = std::find_if(choices_.begin(), choices_.end(),
                                  [&](const Choice& known) { return known.of == path; });
  if (found != choices_.end()) return *found;
  choices_.push_back({path, 0, true, {}});
  return choices_.back();
}

}  // namespace clew::insides
