// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hunt/bisect_search.hpp"
#include "runtime/config_source.hpp"

namespace clew::hunt {

/// One of two runs: all that decides it, and what it is called.
struct BisectSide {
  std::string name;
  runtime::Bundle bundle;
};

/// Which settings and files of two runs make them differ: see search_bisect.
///
/// Refused: runs that cannot be made in one process.
core::Result<BisectEnd> bisect(const BisectSide& a, const BisectSide& b,
                               const std::optional<Property>& property,
                               const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::hunt
