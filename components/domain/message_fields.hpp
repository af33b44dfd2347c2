// SPDX-License-Identifier: Apache-2.0
/// The fields of every message and the names of every enumerator. A test holds them equal to the
/// texts in idl/, and to the members of the structs.
#pragma once

#include "core/math.hpp"
#include "domain/field.hpp"
#include "domain/landmark_classes.hpp"
#include "domain/messages.hpp"

namespace clew::domain {

inline constexpr double kFullTurn_rad = 2.0 * core::kPi;

template <>
inline constexpr std::array kEnumeratorNames<CommandKind> = {
    "COMMAND_STOP", "COMMAND_TURN_AND_STEP", "COMMAND_VELOCITIES", "COMMAND_WHEEL_SPEEDS",
    "COMMAND_GIVE_UP"};
template <>
inline constexpr std::array kEnumeratorNames<EventKind> = {
    "EVENT_LANDMARK",     "EVENT_REFLEX",        "EVENT_TRAP",           "EVENT_ESCAPE_BEGUN",
    "EVENT_ESCAPE_ENDED", "EVENT_ESCAPE_FAILED", "EVENT_VIRTUAL_TARGET", "EVENT_UNREACHABLE"};
template <>
inline constexpr std::array kEnumeratorNames<GuidanceMode> = {"GUIDANCE_SEEK", "GUIDANCE_RECOVER",
                                                              "GUIDANCE_UNREACHABLE"};
template <>
inline constexpr std::array kEnumeratorNames<Network> = {"NETWORK_SOM", "NETWORK_FUZZY_ART"};
template <>
inline constexpr std::array kEnumeratorNames<Outcome> = {"OUTCOME_RUNNING", "OUTCOME_REACHED",
                                                         "OUTCOME_COLLIDED", "OUTCOME_UNREACHABLE",
                                                         "OUTCOME_TIMEOUT"};

template <>
inline constexpr auto kFields<TickStamp> = std::make_tuple(
    field("tick", &TickStamp::tick), field("sim_time_s", &TickStamp::sim_time_s, NotNegative{}),
    field("sequence_number", &TickStamp::sequence));

template <>
inline constexpr auto kFields<Pose2> = std::make_tuple(field("x_m", &Pose2::x_m),
                                                       field("y_m", &Pose2::y_m),
                                                       field("heading_rad", &Pose2::heading_rad,
                                                             WrappedAngle{}));

template <>
inline constexpr auto kFields<Motion> = std::make_tuple(
    field("kind", &Motion::kind), field("turn_rad", &Motion::turn_rad, WithOthers{}),
    field("step_m", &Motion::step_m, WithOthers{}),
    field("speed_mps", &Motion::speed_mps, WithOthers{}),
    field("turn_rate_radps", &Motion::turn_rate_radps, WithOthers{}),
    field("left_mps", &Motion::left_mps, WithOthers{}),
    field("right_mps", &Motion::right_mps, WithOthers{}));

template <>
inline constexpr auto kFields<EventEntry> = std::make_tuple(
    field("kind", &EventEntry::kind), field("shadow", &EventEntry::shadow),
    field("rule", &EventEntry::rule, TextUpTo{kMaxNameLength}), field("x_m", &EventEntry::x_m),
    field("y_m", &EventEntry::y_m), field("has_earlier", &EventEntry::has_earlier),
    field("earlier_tick", &EventEntry::earlier_tick),
    field("earlier_x_m", &EventEntry::earlier_x_m), field("earlier_y_m", &EventEntry::earlier_y_m),
    field("cell", &EventEntry::cell), field("travel_m", &EventEntry::travel_m, NotNegative{}),
    field("text", &EventEntry::text, TextUpTo{kMaxTextLength}));

template <>
inline constexpr auto kFields<VirtualObstacle> = std::make_tuple(
    field("x_min_m", &VirtualObstacle::x_min_m, WithOthers{}),
    field("y_min_m", &VirtualObstacle::y_min_m, WithOthers{}),
    field("x_max_m", &VirtualObstacle::x_max_m), field("y_max_m", &VirtualObstacle::y_max_m));

template <>
inline constexpr auto kFields<Recognition> = std::make_tuple(
    field("network", &Recognition::network), field("neuron", &Recognition::neuron),
    field("created", &Recognition::created),
    field("prototype_classes", &Recognition::prototype_classes, InRange{0.0, kLastClass}));

template <>
inline constexpr auto kFields<PoseCovariance> =
    std::make_tuple(field("x_m2", &PoseCovariance::x_m2, NotNegative{}),
                    field("xy_m2", &PoseCovariance::xy_m2, WithOthers{}),
                    field("x_heading_m_rad", &PoseCovariance::x_heading_m_rad, WithOthers{}),
                    field("y_m2", &PoseCovariance::y_m2, NotNegative{}),
                    field("y_heading_m_rad", &PoseCovariance::y_heading_m_rad, WithOthers{}),
                    field("heading_rad2", &PoseCovariance::heading_rad2, NotNegative{}));

template <>
inline constexpr auto kFields<VirtualTarget> = std::make_tuple(field("x_m", &VirtualTarget::x_m),
                                                               field("y_m", &VirtualTarget::y_m));

template <>
inline constexpr auto kFields<Command> = std::make_tuple(field("stamp", &Command::stamp),
                                                         field("motion", &Command::motion),
                                                         field("virtual_targets",
                                                               &Command::virtual_targets));

template <>
inline constexpr auto kFields<Event> = std::make_tuple(field("stamp", &Event::stamp),
                                                       field("entries", &Event::entries));

template <>
inline constexpr auto kFields<Guidance> =
    std::make_tuple(field("stamp", &Guidance::stamp), field("target_x_m", &Guidance::target_x_m),
                    field("target_y_m", &Guidance::target_y_m),
                    field("target_is_virtual", &Guidance::target_is_virtual),
                    field("target_radius_m", &Guidance::target_radius_m, NotNegative{}),
                    field("target_has_heading", &Guidance::target_has_heading),
                    field("target_heading_rad", &Guidance::target_heading_rad, WrappedAngle{}),
                    field("target_heading_tolerance_rad", &Guidance::target_heading_tolerance_rad,
                          InRange{0.0, core::kPi}),
                    field("mode", &Guidance::mode), field("has_override", &Guidance::has_override),
                    field("override_motion", &Guidance::override_motion),
                    field("virtual_obstacles", &Guidance::virtual_obstacles),
                    field("why", &Guidance::why, TextUpTo{kMaxTextLength}));

template <>
inline constexpr auto kFields<Landmark> = std::make_tuple(
    field("stamp", &Landmark::stamp),
    field("spatial_class", &Landmark::spatial_class, AtMost{kLastClass}),
    field("run_length", &Landmark::run_length), field("presented", &Landmark::presented),
    field("classes", &Landmark::classes, AtMost{kLastClass}),
    field("run_lengths", &Landmark::run_lengths), field("recognitions", &Landmark::recognitions));

template <>
inline constexpr auto kFields<Odometry> = std::make_tuple(
    field("stamp", &Odometry::stamp), field("pose_odom_robot", &Odometry::pose_odom_robot),
    field("covariance", &Odometry::covariance), field("speed_mps", &Odometry::speed_mps),
    field("turn_rate_radps", &Odometry::turn_rate_radps),
    field("travel_m", &Odometry::travel_m, NotNegative{}), field("blocked", &Odometry::blocked),
    field("contact_bearings_rad", &Odometry::contact_bearings_rad, WrappedAngle{}));

template <>
inline constexpr auto kFields<Scan> = std::make_tuple(
    field("stamp", &Scan::stamp),
    field("bearing_first_rad", &Scan::bearing_first_rad, InRange{-kFullTurn_rad, kFullTurn_rad}),
    field("bearing_step_rad", &Scan::bearing_step_rad, InRange{-kFullTurn_rad, kFullTurn_rad}),
    field("beam_width_rad", &Scan::beam_width_rad, InRange{0.0, kFullTurn_rad}),
    field("range_min_m", &Scan::range_min_m, WithOthers{}),
    field("range_max_m", &Scan::range_max_m, NotNegative{}),
    field("ranges_m", &Scan::ranges_m, ListUpTo{kMaxRanges, WithOthers{}}));

template <>
inline constexpr auto kFields<State> = std::make_tuple(
    field("stamp", &State::stamp), field("pose_world_robot", &State::pose_world_robot),
    field("speed_mps", &State::speed_mps), field("turn_rate_radps", &State::turn_rate_radps),
    field("path_length_m", &State::path_length_m, NotNegative{}), field("outcome", &State::outcome),
    field("command_late", &State::command_late), field("collisions", &State::collisions),
    field("hit_by", &State::hit_by), field("safety_stops", &State::safety_stops));

template <>
inline constexpr auto kFields<Target> = std::make_tuple(
    field("stamp", &Target::stamp), field("x_m", &Target::x_m), field("y_m", &Target::y_m),
    field("radius_m", &Target::radius_m, NotNegative{}), field("has_heading", &Target::has_heading),
    field("heading_rad", &Target::heading_rad, WrappedAngle{}),
    field("heading_tolerance_rad", &Target::heading_tolerance_rad, InRange{0.0, core::kPi}),
    field("waypoint", &Target::waypoint), field("waypoints", &Target::waypoints));

}  // namespace clew::domain
