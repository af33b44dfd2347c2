// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace clew::hunt {

/// A parameter that a search may choose: `control.range_m=0.5..1.5`.
struct ParameterRange {
  std::string path;
  double low = 0.0;
  double high = 0.0;
  bool whole = false;  ///< both ends were written as whole numbers: only such ones are chosen

  /// `PATH=VALUE` for a share of the range, 0 to 1. Numbers have six significant digits, so that
  /// people can read and repeat them.
  std::string setting(double share) const;
};

/// What a list of --set texts comes to.
struct Settings {
  std::vector<std::string> fixed;  ///< as they are
  std::vector<ParameterRange> ranges;
};

/// Sorts `PATH=LOW..HIGH` from `PATH=VALUE`. Refused: a range whose ends are no finite numbers, or
/// not in order.
core::Result<Settings> read_settings(const std::vector<std::string>& texts);

}  // namespace clew::hunt
