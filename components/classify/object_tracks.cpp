// SPDX-License-Identifier: Apache-2.0
#include "classify/object_tracks.hpp"

#include <algorithm>
#include <cmath>

namespace clew::classify {
namespace {

constexpr double kSlack_m = 0.1;  // by which a centre is misjudged
constexpr std::size_t kLeastSightings = 3;

}  // namespace

ObjectTracks::ObjectTracks(const ObjectTracksParameters& parameters, double tick_s)
    : parameters_(parameters), tick_s_(tick_s) {}

double ObjectTracks::elapsed_s(std::uint64_t from, std::uint64_t to) const {
  return static_cast<double>(to - from) * tick_s_;
}

void ObjectTracks::add(std::uint64_t tick, const core::Pose2& pose_odom_robot,
                       const std::vector<SeenObject>& objects) {
  centres_odom_.clear();
  widths_m_.clear();
  const core::Vec2 ahead = core::direction(pose_odom_robot.heading_rad);
  const core::Vec2 left(-ahead.y(), ahead.x());
  for (const SeenObject& object : objects) {
    centres_odom_.push_back(pose_odom_robot.position() + object.centre_robot.x() * ahead +
                            object.centre_robot.y() * left);
    widths_m_.push_back(object.width_m);
  }
  taken_.assign(objects.size(), false);
  pair_all(tick);
  forget(tick);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (taken_[i] || state_.tracks.full()) continue;
    state_.tracks.push_back({});
    see(tick, state_.tracks[state_.tracks.size() - 1], i);
  }
}

/// Gives objects to tracks, the nearest pairs first; of equal ones the older track's.
void ObjectTracks::pair_all(std::uint64_t tick) {
  pairs_.clear();
  for (std::size_t t = 0; t < state_.tracks.size(); ++t) {
    const Track& track = state_.tracks[t];
    const core::Vec2 foreseen = foreseen_odom(track, tick);
    const double since_s = elapsed_s(track.sightings[track.sightings.size() - 1].tick, tick);
    const double most_m = kSlack_m + parameters_.fastest_mps * since_s;
    for (std::size_t i = 0; i < centres_odom_.size(); ++i) {
      const double distance_m = core::length(centres_odom_[i] - foreseen);
      if (distance_m <= most_m) pairs_.push_back({t, i, distance_m});
    }
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const Pair& a, const Pair& b) { return a.distance_m < b.distance_m; });
  for (const Pair& pair : pairs_) {
    Track& track = state_.tracks[pair.track];
    const bool seen = track.sightings[track.sightings.size() - 1].tick == tick;
    if (taken_[pair.object] || seen) continue;
    see(tick, track, pair.object);
  }
}

core::Vec2 ObjectTracks::foreseen_odom(const Track& track, std::uint64_t tick) const {
  const auto known = course(track, tick);
  return known ? known->centre_odom : track.sightings[track.sightings.size() - 1].centre_odom;
}

void ObjectTracks::see(std::uint64_t tick, Track& track, std::size_t object) {
  taken_[object] = true;
  auto& sightings = track.sightings;
  if (sightings.full()) {
    for (std::size_t i = 1; i < sightings.size(); ++i) sightings[i - 1] = sightings[i];
    sightings.resize(sightings.size() - 1);
  }
  sightings.push_back({tick, centres_odom_[object]});
  track.width_m = widths_m_[object];
}

/// Drops tracks that were not seen for too long, and sightings before the window, which ends with
/// the last one.
void ObjectTracks::forget(std::uint64_t tick) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < state_.tracks.size(); ++t) {
    Track& track = state_.tracks[t];
    auto& sightings = track.sightings;
    const std::uint64_t seen = sightings[sightings.size() - 1].tick;
    const double unseen_s = elapsed_s(seen, tick);
    if (unseen_s > parameters_.lost_s + 0.5 * tick_s_) continue;
    std::size_t first = 0;
    while (first + 1 < sightings.size() &&
           elapsed_s(sightings[first].tick, seen) > parameters_.window_s + 0.5 * tick_s_) {
      ++first;
    }
    for (std::size_t i = first; i < sightings.size(); ++i) sightings[i - first] = sightings[i];
    sightings.resize(sightings.size() - first);
    if (kept != t) state_.tracks[kept] = track;
    ++kept;
  }
  state_.tracks.resize(kept);
}

std::optional<ObjectTracks::Course> ObjectTracks::course(const Track& track,
                                                         std::uint64_t tick) const {
  const auto& sightings = track.sightings;
  const double count = static_cast<double>(sightings.size());
  const double span_s = elapsed_s(sightings[0].tick, sightings[sightings.size() - 1].tick);
  if (sightings.size() < kLeastSightings || span_s < 0.5 * parameters_.window_s) {
    return std::nullopt;
  }
  double mean_s = 0.0;
  core::Vec2 mean = core::Vec2::Zero();
  for (const Sighting& sighting : sightings) {
    mean_s -= elapsed_s(sighting.tick, tick) / count;
    mean += sighting.centre_odom / count;
  }
  double spread = 0.0;
  core::Vec2 together = core::Vec2::Zero();
  for (const Sighting& sighting : sightings) {
    const double off_s = -elapsed_s(sighting.tick, tick) - mean_s;
    spread += off_s * off_s;
    together += off_s * (sighting.centre_odom - mean);
  }
  Course course;
  course.velocity_odom_mps = together / spread;
  course.centre_odom = mean - mean_s * course.velocity_odom_mps;
  double squares = 0.0;
  for (const Sighting& sighting : sightings) {
    const double before_s = elapsed_s(sighting.tick, tick);
    const core::Vec2 off =
        sighting.centre_odom - (course.centre_odom - before_s * course.velocity_odom_mps);
    squares += off.x() * off.x() + off.y() * off.y();
  }
  course.error_m = std::sqrt(squares / count);
  return course;
}

bool ObjectTracks::is_valid() const {
  return std::all_of(state_.tracks.begin(), state_.tracks.end(), [](const Track& track) {
    const auto& sightings = track.sightings;
    const auto* unordered =
        std::adjacent_find(sightings.begin(), sightings.end(),
                           [](const Sighting& a, const Sighting& b) { return a.tick >= b.tick; });
    return !sightings.empty() && unordered == sightings.end();
  });
}

}  // namespace clew::classify
