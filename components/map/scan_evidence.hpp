// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/messages.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

/// Turns what a robot of one radius sees and feels into marks of a map, in the odometry frame.
///
/// A beam of opening w that reads d tells the least distance of anything in it: the sector of
/// radius d + r is free, and something is somewhere on its arc. The obstacle lies on the part of
/// the arc that was never observed free. If that part is at most `hit_spread_m` long, its middle is
/// a hit; otherwise all of it is suspected. Near arcs are short, and arcs that overlap while the
/// robot passes shorten each other. A ray has no width, and hits. If no part is left, something has
/// changed, and the whole arc counts.
///
/// Beams side by side are taken together at their borders, so that no cell is left out between
/// them: two cones, or rays with at most a few degrees between them, are free as far as the
/// shortest reading of their neighbours. What was hit before is gone only where a ray went through
/// its cell: the end of a wall, or one that a ray grazes, fits between two. Rays farther apart mark
/// nothing free. The body's own disc is free, and contacts of the bumpers are hits on its skin.
class ScanEvidence {
 public:
  struct Parameters {
    double hit_spread_m = 0.1;
    double clear_margin_m = 0.01;  ///< free parts end this far before what returned
  };

  ScanEvidence(const Parameters& parameters, double radius_m)
      : parameters_(parameters), radius_m_(radius_m) {}

  void mark(const domain::Odometry& odometry, const domain::Scan& scan, SeenMap& seen) const;

 private:
  void mark_free_parts(const core::Pose2& pose, const domain::Scan& scan, SeenMap& seen) const;
  void mark_between(const core::Pose2& pose, const domain::Scan& scan, std::size_t first,
                    std::size_t last, double reach_m, const SeenMap::IsGone& is_gone,
                    SeenMap& seen) const;
  void mark_arc(const core::Pose2& pose, double distance_m, double bearing_rad, double width_rad,
                SeenMap& seen) const;

  Parameters parameters_;
  double radius_m_;
};

}  // namespace clew::map
