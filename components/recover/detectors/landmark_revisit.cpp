// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/landmark_revisit.hpp"

#include <cmath>
#include <string>

namespace clew::recover {
namespace {

std::string describe(const domain::Landmark& landmark, const domain::Recognition& recognition) {
  std::string text = recognition.network == domain::Network::kSom ? "SOM [" : "ART [";
  for (std::size_t i = 0; i < landmark.classes.size(); ++i) {
    if (i > 0) text += ' ';
    text += std::to_string(landmark.classes[i]);
  }
  return text + "] seen here before";
}

}  // namespace

core::Result<std::unique_ptr<LandmarkRevisit>> LandmarkRevisit::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  return std::make_unique<LandmarkRevisit>(parameters, setup.tick_s);
}

std::optional<TrapEvidence> LandmarkRevisit::observe(const Situation& situation) {
  std::optional<TrapEvidence> evidence = notice_standing_still(situation);
  if (situation.landmark == nullptr) return evidence;
  for (const domain::Recognition& recognition : situation.landmark->recognitions) {
    auto found = visit(situation, recognition);
    if (found && !evidence) evidence = std::move(found);
  }
  return evidence;
}

std::optional<TrapEvidence> LandmarkRevisit::notice_standing_still(const Situation& situation) {
  if (parameters_.still_s == 0.0) return std::nullopt;
  const core::Pose2& pose = situation.pose();
  const Visit now{situation.tick, pose.position(), pose.heading_rad, situation.odometry.travel_m,
                  PoseDrift::of(situation.odometry)};
  auto& stay = state_.stay;
  const bool stays = !stay.empty() && core::length(stay[0].position_odom - now.position_odom) <=
                                          parameters_.match_radius_m;
  if (stays && static_cast<double>(now.tick - stay[0].tick) * tick_s_ < parameters_.still_s) {
    return std::nullopt;
  }
  std::optional<TrapEvidence> evidence;
  if (stays) {
    const EarlierVisit since{stay[0].tick, stay[0].position_odom, now.travel_m - stay[0].travel_m,
                             0};
    evidence = TrapEvidence{since, "stands still", true};
  }
  stay.clear();
  stay.push_back(now);
  return evidence;
}

/// Compares a win with the earlier ones of the same neuron, and puts it in the queue.
std::optional<TrapEvidence> LandmarkRevisit::visit(const Situation& situation,
                                                   const domain::Recognition& recognition) {
  const Key key{recognition.network, recognition.neuron};
  const bool full = state_.queues.size() >= static_cast<std::size_t>(parameters_.capacity);
  if (full && state_.queues.count(key) == 0) return std::nullopt;
  Queue& queue = state_.queues[key];
  if (recognition.created) queue.clear();

  const core::Pose2& pose = situation.pose();
  const Visit now{situation.tick, pose.position(), pose.heading_rad, situation.odometry.travel_m,
                  PoseDrift::of(situation.odometry)};
  std::optional<TrapEvidence> evidence;
  if (const Visit* earlier = find_loop(queue, now)) {
    evidence = TrapEvidence{EarlierVisit{earlier->tick, earlier->position_odom,
                                         now.travel_m - earlier->travel_m, recognition.neuron},
                            describe(*situation.landmark, recognition)};
  }

  if (queue.full()) {
    for (std::size_t i = 1; i < queue.size(); ++i) queue[i - 1] = queue[i];
    queue.resize(queue.size() - 1);
  }
  queue.push_back(now);
  return evidence;
}

/// How far a visit may lie from here and be of the same place.
double LandmarkRevisit::match_radius_m(const PoseDrift& now, const Visit& earlier) const {
  return parameters_.match_radius_m + parameters_.drift_sigmas * now.place_since_m(earlier.drift);
}

/// The newest earlier visit to this place, if there are as many as it takes.
const LandmarkRevisit::Visit* LandmarkRevisit::find_loop(const Queue& queue,
                                                         const Visit& now) const {
  const Visit* newest = nullptr;
  std::int64_t matches = 0;
  for (const Visit& visit : queue) {
    const bool same_place =
        core::length(visit.position_odom - now.position_odom) <= match_radius_m(now.drift, visit);
    const bool is_loop = now.travel_m - visit.travel_m >= parameters_.loop_length_m;
    const bool same_heading =
        std::fabs(core::wrap_angle_rad(visit.heading_rad - now.heading_rad)) <=
        parameters_.heading_tolerance_rad;
    if (!same_place || !is_loop || !same_heading) continue;
    newest = &visit;
    ++matches;
  }
  return matches >= parameters_.earlier_visits ? newest : nullptr;
}

void LandmarkRevisit::save(core::StateWriter& writer) const { writer(state_); }

void LandmarkRevisit::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::recover
