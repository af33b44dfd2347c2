// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::scan {

/// What a behaviour needs of a range sensor; what is not set does not matter.
struct ScanNeeds {
  std::size_t least_beams = 1;
  /// Between the axes of neighbouring beams.
  double most_apart_rad = std::numeric_limits<double>::infinity();
  /// Between the edges of neighbouring beams.
  double most_unseen_rad = std::numeric_limits<double>::infinity();
  double least_axis_rad = 0.0;    ///< of the outermost beam, on each side
  double least_seen_rad = 0.0;    ///< what the outermost beam sees, on each side
  double least_field_rad = 0.0;   ///< ScanLayout::field_rad
  std::string field_reason = {};  ///< where that comes from, for the message
};

/// Fails if a layout does not give what is needed; `behaviour` names the caller in the error, which
/// says what that is, and what the sensor gives.
core::Result<void> check_needs(const ScanNeeds& needs, const domain::ScanLayout& layout,
                               const std::string& behaviour);

}  // namespace clew::scan
