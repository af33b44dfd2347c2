// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "domain/messages.hpp"
#include "map/scan_evidence.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

/// What ScanEvidence does, without anything that makes it fast: each sector and each place is
/// computed by itself, and is SeenMap's to mark.
class PlainScanEvidence {
 public:
  PlainScanEvidence(const ScanEvidence::Parameters& parameters, double radius_m)
      : parameters_(parameters), radius_m_(radius_m) {}

  void mark(const domain::Odometry& odometry, const domain::Scan& scan, SeenMap& seen) const;

 private:
  void mark_free_parts(const core::Pose2& pose, const domain::Scan& scan, SeenMap& seen) const;
  void mark_between(const core::Pose2& pose, const domain::Scan& scan, std::size_t first,
                    std::size_t last, double reach_m, const SeenMap::IsGone& is_gone,
                    SeenMap& seen) const;
  void mark_arc(const core::Pose2& pose, double distance_m, double bearing_rad, double width_rad,
                SeenMap& seen) const;

  ScanEvidence::Parameters parameters_;
  double radius_m_;
};

}  // namespace clew::map
