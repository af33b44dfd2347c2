// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/archive.hpp"
#include "domain/messages.hpp"

namespace clew::control {

/// The short-term memory of returns: Lagoudakis & Maida 1999, *Sonar Short-Term Memory*. The last
/// scans, each with the pose that it was taken from, so that their returns can be told in any other
/// frame as if they had been measured from there.
///
/// A return lies in the middle of its beam (the paper's simplest sensor model), at the reading from
/// the robot's skin. *Deviation, needed* for lasers: a ray from which both neighbours differ by
/// more than 0.3 m is taken for an error. One in a hundred, over ten scans, would shut the robot
/// in.
class ScanMemory {
 public:
  struct Kept {
    core::Pose2 pose_odom_robot;
    std::vector<core::Vec2> returns_robot;
  };

  struct State {
    std::vector<Kept> scans;  ///< a cyclic buffer; without returns where there was no scan yet
    std::size_t newest = 0;
  };

  /// scans >= 1; beams: most that a scan has.
  ScanMemory(std::size_t scans, std::size_t beams, double radius_m);

  /// Keeps a scan in place of the oldest one.
  void add(const core::Pose2& pose_odom_robot, const domain::Scan& scan);
  void forget();

  /// The returns of all scans in the frame of a pose, that of the newest scan first. Those within
  /// the robot's body there are left out, most likely they are errors, and those beyond scope_m.
  void returns_seen_from(const core::Pose2& pose_odom, double scope_m,
                         std::vector<core::Vec2>& returns) const;
  /// Those of the newest scan alone.
  void newest_seen_from(const core::Pose2& pose_odom, double scope_m,
                        std::vector<core::Vec2>& returns) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  void add_seen_from(const core::Pose2& pose_odom, const Kept& kept, double scope_m,
                     std::vector<core::Vec2>& returns) const;

  double radius_m_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, ScanMemory::Kept& k) {
  visit(k.pose_odom_robot, k.returns_robot);
}

template <typename Visitor>
void visit_fields(Visitor& visit, ScanMemory::State& s) {
  visit(s.scans, s.newest);
}

}  // namespace clew::control
