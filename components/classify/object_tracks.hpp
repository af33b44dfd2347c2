// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "classify/range_pattern.hpp"
#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"

namespace clew::classify {

struct ObjectTracksParameters {
  double window_s = 1.0;
  double lost_s = 0.6;
  double fastest_mps = 1.5;
};

/// Objects followed from scan to scan, in the frame of odometry: where each was seen within a
/// window of time. An object continues the track whose foreseen place is nearest to it, the nearest
/// pairs first, as far as anything moves in the time between.
class ObjectTracks {
 public:
  static constexpr std::size_t kMostTracks = 32;
  static constexpr std::size_t kMostSightings = 32;

  struct Sighting {
    std::uint64_t tick = 0;
    core::Vec2 centre_odom = core::Vec2::Zero();
  };
  struct Track {
    core::BoundedVector<Sighting, kMostSightings> sightings;  ///< oldest first, at least one
    double width_m = 0.0;                                     ///< when it was last seen
  };
  struct State {
    core::BoundedVector<Track, kMostTracks> tracks;  ///< the longest known first
  };

  /// Where an object is and how it moves: a straight line through its sightings by least squares.
  struct Course {
    core::Vec2 centre_odom = core::Vec2::Zero();  ///< now
    core::Vec2 velocity_odom_mps = core::Vec2::Zero();
    double error_m = 0.0;  ///< root of the mean square distance of the sightings from the line
  };

  ObjectTracks(const ObjectTracksParameters& parameters, double tick_s);

  /// Takes what is seen in this tick. What exceeds the number of tracks is not followed.
  void add(std::uint64_t tick, const core::Pose2& pose_odom_robot,
           const std::vector<SeenObject>& objects);

  /// The course of a track; nothing before three sightings over half a window.
  std::optional<Course> course(const Track& track, std::uint64_t tick) const;

  /// Whether its state, which may come from a file, is one that tracks can have at this tick.
  bool is_valid() const;
  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  struct Pair {
    std::size_t track = 0;
    std::size_t object = 0;
    double distance_m = 0.0;
  };

  double elapsed_s(std::uint64_t from, std::uint64_t to) const;
  core::Vec2 foreseen_odom(const Track& track, std::uint64_t tick) const;
  void pair_all(std::uint64_t tick);
  void see(std::uint64_t tick, Track& track, std::size_t object);
  void forget(std::uint64_t tick);

  ObjectTracksParameters parameters_;
  double tick_s_;
  State state_;
  // Scratch, of the last step.
  std::vector<core::Vec2> centres_odom_;
  std::vector<double> widths_m_;
  std::vector<Pair> pairs_;
  std::vector<bool> taken_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, ObjectTracks::Sighting& s) {
  visit(s.tick, s.centre_odom);
}
template <typename Visitor>
void visit_fields(Visitor& visit, ObjectTracks::Track& t) {
  visit(t.sightings, t.width_m);
}
template <typename Visitor>
void visit_fields(Visitor& visit, ObjectTracks::State& s) {
  visit(s.tracks);
}

}  // namespace clew::classify
