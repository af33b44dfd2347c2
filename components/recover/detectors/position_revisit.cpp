// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/position_revisit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/fuzzy.hpp"

namespace clew::recover {
namespace {

// More than the parameter allows: a state that counts more is a stranger's.
constexpr std::int64_t kMostRecognitions = 1000;

core::Error unfit(std::string message) { return {std::move(message)}; }

}  // namespace

core::Result<std::unique_ptr<PositionRevisit>> PositionRevisit::create(
    const Parameters& parameters, const domain::BehaviourSetup&) {
  if (parameters.place_full_m >= parameters.place_none_m) {
    return unfit("position_revisit needs a place_none_m above its place_full_m");
  }
  if (parameters.direction_full_rad >= parameters.direction_none_rad) {
    return unfit("position_revisit needs a direction_none_deg above its direction_full_deg");
  }
  if (parameters.place_none_m > parameters.grid_m) {
    return unfit("position_revisit needs a grid_m of at least its place_none_m");
  }
  return std::make_unique<PositionRevisit>(parameters);
}

PositionRevisit::PositionRevisit(const Parameters& parameters)
    : parameters_(parameters),
      memory_(parameters.grid_m, static_cast<std::size_t>(parameters.capacity)) {}

std::optional<TrapEvidence> PositionRevisit::observe(const Situation& situation) {
  const core::Vec2 position = situation.pose().position();
  if (state_.begun && core::length(position - state_.last_odom) < parameters_.spacing_m) {
    return std::nullopt;
  }
  state_.begun = true;
  state_.last_odom = position;
  const PositionMemory::Visit now{situation.tick, situation.pose(), situation.odometry.travel_m,
                                  PoseDrift::of(situation.odometry)};
  const auto earlier = recognised(now);
  memory_.add(now);
  state_.in_a_row = earlier ? state_.in_a_row + 1 : 0;
  const bool turned = earlier && degrees(now, *earlier).direction < parameters_.threshold;
  state_.turned_in_a_row = earlier ? state_.turned_in_a_row + (turned ? 1 : 0) : 0;
  if (state_.in_a_row < parameters_.recognitions) return std::nullopt;

  const std::string with_another =
      state_.turned_in_a_row == 0
          ? ""
          : ", " + std::to_string(state_.turned_in_a_row) + " with another direction";
  state_.in_a_row = 0;
  state_.turned_in_a_row = 0;
  const core::Vec2 earlier_position = earlier->pose_odom.position();
  return TrapEvidence{
      EarlierVisit{earlier->tick, earlier_position, now.travel_m - earlier->travel_m,
                   static_cast<std::uint32_t>(memory_.key_at(earlier_position))},
      std::to_string(parameters_.recognitions) + " positions in a row seen before" + with_another};
}

/// The degrees to which the two rules hold.
PositionRevisit::Degrees PositionRevisit::degrees(const PositionMemory::Visit& now,
                                                  const PositionMemory::Visit& earlier) const {
  const double between_m = now.travel_m - earlier.travel_m;
  const double room_m = parameters_.grid_m - parameters_.place_none_m;
  const double wide_m = parameters_.drift_sigmas * now.drift.place_since_m(earlier.drift);
  const double place_drift_m =
      std::min(parameters_.place_drift_ratio * between_m, room_m) +
      std::min(wide_m, static_cast<double>(reach_cells() - 1) * parameters_.grid_m);
  const double direction_drift_rad =
      parameters_.direction_drift_radpm * between_m +
      parameters_.drift_sigmas * now.drift.heading_since_rad(earlier.drift);
  const double apart_m = core::distance_m(now.pose_odom, earlier.pose_odom.position());
  const double turned_rad =
      std::fabs(core::wrap_angle_rad(now.pose_odom.heading_rad - earlier.pose_odom.heading_rad));
  return {core::falling_membership(apart_m, parameters_.place_full_m + place_drift_m,
                                   parameters_.place_none_m + place_drift_m),
          core::falling_membership(turned_rad, parameters_.direction_full_rad + direction_drift_rad,
                                   parameters_.direction_none_rad + direction_drift_rad)};
}

/// The degree to which a visit counts.
double PositionRevisit::recognition(const PositionMemory::Visit& now,
                                    const PositionMemory::Visit& earlier) const {
  const Degrees degree = degrees(now, earlier);
  return parameters_.other_direction ? degree.place : std::min(degree.place, degree.direction);
}

/// The earlier visit that is recognised best, the newest of equal ones.
std::optional<PositionMemory::Visit> PositionRevisit::recognised(
    const PositionMemory::Visit& now) const {
  std::optional<PositionMemory::Visit> best;
  double best_degree = parameters_.threshold;
  memory_.around(now.pose_odom.position(), reach_cells(), [&](const PositionMemory::Visit& visit) {
    if (now.travel_m - visit.travel_m < parameters_.loop_length_m) return;
    const double degree = recognition(now, visit);
    if (degree < best_degree) return;
    if (best && degree == best_degree && visit.tick < best->tick) return;
    best = visit;
    best_degree = degree;
  });
  return best;
}

void PositionRevisit::start_afresh() {
  memory_.clear();
  state_ = {};
}

void PositionRevisit::save(core::StateWriter& writer) const {
  writer(state_);
  memory_.save(writer);
}

void PositionRevisit::load(core::StateReader& reader) {
  reader(state_);
  const bool counts = state_.in_a_row >= 0 && state_.in_a_row < kMostRecognitions &&
                      state_.turned_in_a_row >= 0 && state_.turned_in_a_row <= state_.in_a_row;
  if (!reader.check(counts, "a number of recognitions is none")) state_ = {};
  memory_.load(reader);
}

}  // namespace clew::recover
