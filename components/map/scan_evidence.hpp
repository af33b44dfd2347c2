// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/math.hpp"
#include "domain/messages.hpp"
#include "map/seen_map.hpp"
#include "map/seen_window.hpp"

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

  void mark(const domain::Odometry& odometry, const domain::Scan& scan, SeenMap& seen);

 private:
  /// Beams whose free parts are taken together: from the middle of the first to that of the last,
  /// or all of a single one.
  struct Group {
    std::size_t first = 0;
    std::size_t last = 0;
    double reach_m = 0.0;  ///< from the robot's centre
    double right_rad = 0.0;
    double opening_rad = 0.0;
    Vec2 right = Vec2::UnitX();  ///< with the robot's heading along x
    Vec2 left = Vec2::UnitX();
  };
  /// How the beams of a scan lie, and what follows from that.
  struct Fan {
    double bearing_first_rad = 0.0;
    double bearing_step_rad = 0.0;
    double beam_width_rad = 0.0;
    std::vector<Vec2> beams;  ///< directions, with the robot's heading along x
    std::vector<Group> groups;
  };
  /// Where something is that a beam has met.
  struct Arc {
    Vec2 middle = Vec2::Zero();  ///< of the circle
    double distance_m = 0.0;
    double bearing_rad = 0.0;  ///< of its middle
    double width_rad = 0.0;
    std::size_t pieces = 0;  ///< half a cell long at most; 0 of a ray

    double angle_rad(std::size_t i) const;  ///< of a place on it, i <= pieces
    double x_m(std::size_t i) const { return middle.x() + distance_m * core::cos(angle_rad(i)); }
    double y_m(std::size_t i) const { return middle.y() + distance_m * core::sin(angle_rad(i)); }
    Vec2 place(std::size_t i) const { return {x_m(i), y_m(i)}; }
  };

  void lay_out(const domain::Scan& scan);
  void group_beams(const domain::Scan& scan);
  void group(const domain::Scan& scan, std::size_t first, std::size_t last, double reach_m);
  void mark_free(const core::Pose2& pose, const domain::Scan& scan, const Group& beams,
                 const SeenMap::IsGone& is_gone, SeenMap& seen);
  void mark_ray(const Arc& ray, const Vec2& beam, SeenMap& seen);
  void mark_arc(const Arc& arc, SeenMap& seen);
  void find_cells(const Arc& arc);
  SeenWindow::Cell cell_of(const Arc& arc, std::size_t i, const Vec2& direction) const;
  Vec2 turned(const Vec2& direction) const;

  Parameters parameters_;
  double radius_m_;
  // Memory to work in, and what every scan of the same layout has.
  Fan fan_;
  SeenWindow window_;
  Vec2 heading_ = Vec2::UnitX();         // the robot's, as a direction
  std::vector<SeenWindow::Cell> cells_;  // of an arc's places, if the window decides
};

}  // namespace clew::map
