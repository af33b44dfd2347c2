// SPDX-License-Identifier: Apache-2.0
/// What the detectors that know places again tell of them.
#include <algorithm>
#include <cmath>

#include "domain/words.hpp"
#include "recover/detectors/landmark_revisit.hpp"
#include "recover/detectors/position_revisit.hpp"

namespace clew::recover {
namespace {

std::string landmark_name(const std::pair<domain::Network, std::uint32_t>& key) {
  return (key.first == domain::Network::kSom ? "SOM " : "ART ") + std::to_string(key.second);
}

}  // namespace

void LandmarkRevisit::tell(const Situation& situation, domain::Inside& inside) const {
  const core::Pose2& pose = situation.pose();
  domain::PictureLayer places{"visits to landmarks", domain::PictureLayer::Kind::kPoints, {}, {}};
  std::int64_t most_matches = 0;
  std::string awaited;
  for (const auto& [key, queue] : state_.queues) {
    std::int64_t matches = 0;
    domain::InsideGroup& item = inside.values.item("landmarks");
    item.text("landmark", landmark_name(key));
    for (const Visit& visit : queue) {
      const double apart_m = core::distance_m(pose, visit.position_odom);
      const double loop_m = situation.odometry.travel_m - visit.travel_m;
      const double turned_rad =
          std::fabs(core::wrap_angle_rad(visit.heading_rad - pose.heading_rad));
      const double reach_m = match_radius_m(PoseDrift::of(situation.odometry), visit);
      const bool matches_here = apart_m <= reach_m && loop_m >= parameters_.loop_length_m &&
                                turned_rad <= parameters_.heading_tolerance_rad;
      if (matches_here) ++matches;
      domain::InsideGroup& told = item.item("visits");
      told.number("tick", static_cast<double>(visit.tick));
      told.place("place", visit.position_odom);
      told.number("from_here", apart_m, "m");
      told.number("path_since", loop_m, "m");
      told.flag("matches_here", matches_here);
      places.places_odom.push_back(visit.position_odom);
    }
    if (matches > most_matches) {
      most_matches = matches;
      awaited = landmark_name(key);
    }
  }
  const auto share =
      static_cast<double>(most_matches) / static_cast<double>(parameters_.earlier_visits);
  inside.values.number("match_radius", parameters_.match_radius_m, "m");
  inside.values.number("loop_length", parameters_.loop_length_m, "m");
  inside.values.number("alarm_share", std::min(1.0, share));
  inside.picture.layers.push_back(std::move(places));
  inside.say("It remembers " + domain::say_count(state_.queues.size(), "landmark") + "; " +
             (awaited.empty() ? "none of them was seen here before."
                              : awaited + " was seen here before, so it is a trap if that is "
                                          "recognised here."));
}

void PositionRevisit::tell(const Situation& situation, domain::Inside& inside) const {
  const PositionMemory::Visit now{situation.tick, situation.pose(), situation.odometry.travel_m,
                                  PoseDrift::of(situation.odometry)};
  double best = 0.0;
  double best_place = 0.0;
  memory_.around(now.pose_odom.position(), reach_cells(), [&](const PositionMemory::Visit& visit) {
    if (now.travel_m - visit.travel_m < parameters_.loop_length_m) return;
    best = std::max(best, recognition(now, visit));
    best_place = std::max(best_place, degrees(now, visit).place);
  });
  inside.values.number("known_cells", static_cast<double>(memory_.size()));
  inside.values.number("recognition", best);
  inside.values.number("same_place", best_place);
  inside.values.number("threshold", parameters_.threshold);
  inside.values.number("recognised_in_a_row", static_cast<double>(state_.in_a_row));
  inside.values.number("needed_in_a_row", static_cast<double>(parameters_.recognitions));
  inside.values.number("alarm_share", static_cast<double>(state_.in_a_row) /
                                          static_cast<double>(parameters_.recognitions));
  inside.say("This place is recognised to " + domain::say_percent(best) + "; the last " +
             std::to_string(state_.in_a_row) + " of the " +
             std::to_string(parameters_.recognitions) +
             " positions in a row that make a trap were seen before.");
  if (best < parameters_.threshold && best_place >= parameters_.threshold) {
    inside.say("The robot was at this place before, but with another direction.");
  }
}

}  // namespace clew::recover
