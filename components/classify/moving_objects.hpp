// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "classify/class_sequence.hpp"
#include "classify/classifier.hpp"
#include "classify/object_tracks.hpp"
#include "classify/range_pattern.hpp"
#include "classify/spatial_classes.hpp"
#include "core/angle.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/moving_object.hpp"
#include "domain/setup.hpp"
#include "scan/seven_cones.hpp"

namespace clew::classify {

struct MovingObjectsParameters {
  RangePatternParameters pattern;
  ObjectTracksParameters tracks;
  double moving_mps = 0.15;
  double steady_m = 0.08;
  double along_rad = core::radians(30.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MovingObjectsParameters& p) {
  visit.number("join_m", p.pattern.join_m, "m", {0.01, 1.0},
               "returns of neighbouring beams within this distance are of one object");
  visit.number("widest_m", p.pattern.widest_m, "m", {0.05, 5.0}, "what is wider is a wall");
  visit.number("window_s", p.tracks.window_s, "s", {0.3, 5.0},
               "length of the sequence of range patterns that tells a motion");
  visit.number("lost_s", p.tracks.lost_s, "s", {0.1, 5.0},
               "an object that was not seen for longer is forgotten");
  visit.number("fastest_mps", p.tracks.fastest_mps, "m/s", {0.1, 10.0},
               "greatest speed of an object, which bounds where it is looked for");
  visit.number("moving_mps", p.moving_mps, "m/s", {0.01, 5.0}, "what is slower is static");
  visit.number("steady_m", p.steady_m, "m", {0.001, 1.0},
               "what strays farther from a straight line than this is static: it has no course");
  visit.angle("along_deg", p.along_rad, {1.0, 89.0},
              "what moves within this angle of the line of sight approaches or recedes");
}

/// Tells moving objects by sequences of range patterns, as Krishna & Kalra 2000, section 5, propose
/// without saying how. So all of it is ours.
///
/// The first layer finds objects in each scan (range_pattern.hpp), and the spatial class of Table I
/// as *krishna_kalra* does. The second follows each object over a window of scans
/// (object_tracks.hpp). The robot's own motion is taken off by odometry. What moves slower than
/// moving_mps is static; the rest approaches, recedes, or crosses to the left or right, by the
/// angle between its course and the line of sight.
///
/// `landmark` carries the four nearest moving objects, and static ones in what places are left, as
/// recognitions (domain/moving_object.hpp). No landmark vector is ever presented.
class MovingObjects final : public Classifier {
 public:
  using Parameters = MovingObjectsParameters;

  /// Refuses sensors that leave one of the seven sectors without a beam, or whose beams are too far
  /// apart to tell a person from a wall.
  static core::Result<std::unique_ptr<MovingObjects>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup);

  MovingObjects(const Parameters& parameters, double robot_radius_m, double tick_s);

  void step(const domain::Odometry& odometry, const domain::Scan& scan,
            domain::Landmark& landmark) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            domain::Inside& inside) const override;

 private:
  /// An object whose motion is known.
  struct Known {
    domain::MovingObject object;
    ObjectTracks::Course course;
    double width_m = 0.0;
  };

  std::vector<Known> known(std::uint64_t tick, const core::Pose2& pose_odom_robot) const;
  domain::ObjectMotion motion_of(const ObjectTracks::Course& course,
                                 const core::Vec2& robot_odom) const;

  Parameters parameters_;
  double robot_radius_m_;
  scan::SevenCones eyes_{std::numeric_limits<double>::infinity()};
  ClassSequence sequence_{true};
  ObjectTracks tracks_;
  std::vector<SeenObject> seen_;  // scratch, of the last step
};

}  // namespace clew::classify
