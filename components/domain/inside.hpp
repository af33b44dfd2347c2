// SPDX-License-Identifier: Apache-2.0
/// What a behaviour tells of its inside after a step, for people who ask about a tick: `clew
/// explain`, `clew plot --tick`, the page of `clew view`. It is no sample: nothing is sent,
/// recorded or decided by it, and nothing is computed before somebody asks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry.hpp"
#include "domain/picture.hpp"

namespace clew::domain {

/// Numbers over two axes: a surface, a lattice, a map. Drawn with row 0 at the top.
struct InsideGrid {
  std::size_t columns = 1;
  std::vector<double> values;  ///< row by row
  std::string columns_are;     ///< what changes along a row, with its unit
  std::string rows_are;        ///< what changes from row to row, with its unit
  std::optional<std::size_t> marked = std::nullopt;  ///< the place of the value that counts now
};

struct InsideValue;

/// Values by name, in the order in which they were told. Names are in snake case, each once.
class InsideGroup {
 public:
  /// A finite number. The unit is the suffix that names of numbers carry: m, rad, mps, radps, s,
  /// ticks; empty for a plain number.
  void number(std::string name, double value, std::string unit = {});
  /// The same of a bound that is infinite as long as there is none; then it is the text `none`.
  void bound(std::string name, double value, std::string unit = {});
  void flag(std::string name, bool value);
  void text(std::string name, std::string value);
  void list(std::string name, std::vector<double> values, std::string unit = {});
  void grid(std::string name, InsideGrid grid, std::string unit = {});
  /// A place in the frame of odometry: a group of `x` and `y`.
  void place(std::string name, const core::Vec2& place_odom);
  /// A group of values in this one; valid until the next value is told.
  InsideGroup& group(std::string name);
  /// One more of several groups of the same name; valid until the next value is told.
  InsideGroup& item(const std::string& name);

  void put(InsideValue value);
  const std::vector<InsideValue>& values() const { return values_; }
  bool empty() const { return values_.empty(); }

 private:
  std::vector<InsideValue> values_;
};

/// A value with its name and unit.
struct InsideValue {
  using Items = std::vector<InsideGroup>;

  std::string name;
  std::string unit;
  std::variant<double, bool, std::string, std::vector<double>, InsideGrid, InsideGroup, Items>
      value;
};

/// All that is told of a tick; empty if nothing is.
struct Inside {
  std::string text;    ///< whole sentences: what it saw, what it weighed, what decided
  InsideGroup values;  ///< the numbers behind the text
  Picture picture;     ///< what of them has a place, to be drawn over the map

  /// Adds a sentence, which ends with a full stop.
  void say(const std::string& sentence);
  /// Adds what a part tells: its text and picture, and its values as a group.
  void add(std::string name, Inside part);
  bool empty() const { return text.empty() && values.empty() && picture.empty(); }
};

}  // namespace clew::domain
