// SPDX-License-Identifier: Apache-2.0
#include "domain/inside.hpp"

#include <cmath>
#include <iterator>

namespace clew::domain {

void InsideGroup::number(std::string name, double value, std::string unit) {
  put({std::move(name), std::move(unit), value});
}

void InsideGroup::bound(std::string name, double value, std::string unit) {
  if (std::isinf(value)) return put({std::move(name), std::move(unit), std::string("none")});
  number(std::move(name), value, std::move(unit));
}

void InsideGroup::flag(std::string name, bool value) { put({std::move(name), {}, value}); }

void InsideGroup::text(std::string name, std::string value) {
  put({std::move(name), {}, std::move(value)});
}

void InsideGroup::list(std::string name, std::vector<double> values, std::string unit) {
  put({std::move(name), std::move(unit), std::move(values)});
}

void InsideGroup::grid(std::string name, InsideGrid grid, std::string unit) {
  put({std::move(name), std::move(unit), std::move(grid)});
}

void InsideGroup::place(std::string name, const core::Vec2& place_odom) {
  InsideGroup& place = group(std::move(name));
  place.number("x", place_odom.x(), "m");
  place.number("y", place_odom.y(), "m");
}

InsideGroup& InsideGroup::group(std::string name) {
  put({std::move(name), {}, InsideGroup{}});
  return std::get<InsideGroup>(values_.back().value);
}

InsideGroup& InsideGroup::item(const std::string& name) {
  const bool goes_on = !values_.empty() && values_.back().name == name &&
                       std::holds_alternative<InsideValue::Items>(values_.back().value);
  if (!goes_on) put({name, {}, InsideValue::Items{}});
  auto& items = std::get<InsideValue::Items>(values_.back().value);
  items.emplace_back();
  return items.back();
}

void InsideGroup::put(InsideValue value) { values_.push_back(std::move(value)); }

void Inside::say(const std::string& sentence) {
  if (sentence.empty()) return;
  if (!text.empty()) text += ' ';
  text += sentence;
}

void Inside::add(std::string name, Inside part) {
  say(part.text);
  if (!part.values.empty()) values.put({std::move(name), {}, std::move(part.values)});
  std::move(part.picture.layers.begin(), part.picture.layers.end(),
            std::back_inserter(picture.layers));
  std::move(part.picture.charts.begin(), part.picture.charts.end(),
            std::back_inserter(picture.charts));
}

}  // namespace clew::domain
