// SPDX-License-Identifier: Apache-2.0
#include "recover/recover_component.hpp"

#include <cmath>
#include <utility>

#include "core/angle.hpp"

namespace clew::recover {
namespace {

using domain::Event;
using domain::EventEntry;
using domain::EventKind;
using domain::Guidance;
using domain::Topic;

/// Adds a mark at the robot's position. Beyond the list's bound, marks are dropped.
void mark(Event& event, EventKind kind, const std::string& rule, const Situation& situation,
          std::string text) {
  if (event.entries.full()) return;
  EventEntry entry;
  entry.kind = kind;
  entry.rule = rule;
  entry.x_m = situation.pose().x_m;
  entry.y_m = situation.pose().y_m;
  entry.text = std::move(text);
  event.entries.push_back(entry);
}

void mark_trap(Event& event, const std::string& rule, bool shadow, const Situation& situation,
               const TrapEvidence& evidence) {
  if (event.entries.full()) return;
  mark(event, EventKind::kTrap, rule, situation, evidence.text);
  EventEntry& entry = event.entries[event.entries.size() - 1];
  entry.shadow = shadow;
  if (!evidence.earlier) return;
  entry.has_earlier = true;
  entry.earlier_tick = evidence.earlier->tick;
  entry.earlier_x_m = evidence.earlier->position_odom.x();
  entry.earlier_y_m = evidence.earlier->position_odom.y();
  entry.cell = evidence.earlier->cell;
  entry.travel_m = evidence.earlier->travel_m;
}

void mark_landmarks(Event& event, const Situation& situation) {
  if (situation.landmark == nullptr) return;
  const domain::Landmark& landmark = *situation.landmark;
  for (const domain::Recognition& recognition : landmark.recognitions) {
    std::string text;
    for (const std::uint8_t spatial_class : landmark.classes) {
      text += text.empty() ? '[' : ' ';
      text += std::to_string(spatial_class);
    }
    const bool by_som = recognition.network == domain::Network::kSom;
    mark(event, EventKind::kLandmark, by_som ? "som" : "fuzzy_art", situation, text + ']');
    if (!event.entries.empty()) {
      event.entries[event.entries.size() - 1].cell = recognition.neuron;
    }
  }
}

void seek(const Situation& situation, Guidance& guidance) {
  guidance.target_x_m = situation.target_odom.x();
  guidance.target_y_m = situation.target_odom.y();
}

/// What `target` says of arrival holds where the target in force is the mission's.
void tell_arrival(const domain::Target& target, Guidance& guidance) {
  if (guidance.target_is_virtual) return;
  guidance.target_radius_m = target.radius_m;
  guidance.target_has_heading = target.has_heading;
  guidance.target_heading_rad = target.heading_rad;
  guidance.target_heading_tolerance_rad = target.heading_tolerance_rad;
}

/// Who, and why if a reason was given, within the bound of texts.
std::string in_short(const std::string& who, const std::string& reason) {
  return (reason.empty() ? who : who + ": " + reason).substr(0, domain::kMaxTextLength);
}

}  // namespace

std::vector<runtime::PortInfo> RecoverComponent::ports() {
  return {runtime::required_input(Topic::kOdometry, "where the robot believes it is"),
          runtime::required_input(Topic::kScan, "what is around"),
          runtime::required_input(Topic::kTarget, "where the mission wants the robot"),
          runtime::optional_input(Topic::kLandmark, "what kind of place this is"),
          runtime::output(Topic::kGuidance, "the active target, and what control must do"),
          runtime::output(Topic::kEvent, "landmarks, traps and escapes, for people")};
}

void RecoverComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  decide(inputs, outputs);
  tell_arrival(inputs.get<domain::Target>(), outputs.get<Guidance>());
}

void RecoverComponent::decide(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& target = inputs.get<domain::Target>();
  const core::Vec2 target_odom = target.position();
  const auto* landmark = inputs.find<domain::Landmark>();
  // Without a vector, recognitions are of moving objects, which are no places.
  if (landmark != nullptr && !landmark->presented) landmark = nullptr;
  const Situation situation{inputs.tick(),
                            inputs.get<domain::Odometry>(),
                            inputs.get<domain::Scan>(),
                            landmark,
                            target_odom,
                            state_.virtual_target_odom.value_or(target_odom),
                            target.radius_m,
                            parts_.local_map ? &*parts_.local_map : nullptr,
                            &path_finders_};
  pursued_odom_ = situation.pursued_odom;
  auto& guidance = outputs.get<Guidance>();
  auto& event = outputs.get<Event>();
  seek(situation, guidance);
  guidance.why = state_.why;
  const bool has_none = target.radius_m == 0.0 && situation.target_distance_m() == 0.0;
  const bool turns = is_to_turn(target, situation.pose());
  const bool waits = has_none || turns;
  if (waits) wait();
  if (state_.gave_up) {
    guidance.mode = domain::GuidanceMode::kUnreachable;
    return;
  }

  see(situation, outputs);
  if (waits) return;
  notice_arrival(target);
  for (auto& escape : parts_.escapes) escape.behaviour->watch(situation);
  {
    const auto part = outputs.part(parts_.detector.name);
    take_evidence(situation, event);
  }
  if (state_.escaping) {
    const auto part = outputs.part(parts_.escapes[state_.escape].name);
    step_escape(situation, guidance, event);
  }
  mark_virtual_target(guidance, event);
  if (!parts_.shadows.empty()) {
    const auto part = outputs.part("shadows");
    watch_shadows(situation, event);
  }
  mark_landmarks(event, situation);
  if (!guidance.has_override) act_at_once(situation, guidance, event);
}

/// Takes what is seen into the local map, if there is one and it is begun.
void RecoverComponent::see(const Situation& situation, const runtime::TickOutputs& outputs) {
  if (!parts_.local_map || (parts_.maps_late && !state_.maps)) return;
  const auto part = outputs.part("map");
  parts_.local_map->see(situation.odometry, situation.scan);
}

/// Whether the robot is where the mission wants it, and only has to turn there. Once it has met the
/// heading, control steers again, as control::HeadingTurn says: odometry has drifted.
bool RecoverComponent::is_to_turn(const domain::Target& target, const core::Pose2& pose) {
  const bool is_there =
      target.has_heading && core::distance_m(pose, target.position()) <= target.radius_m;
  if (!is_there || state_.met_odom != target.position()) state_.met_odom.reset();
  if (!is_there) return false;
  const double off_rad = core::wrap_angle_rad(pose.heading_rad - target.heading_rad);
  if (std::fabs(off_rad) <= target.heading_tolerance_rad) state_.met_odom = target.position();
  return !state_.met_odom;
}

/// The mission has nowhere to go to, and its target is where the robot believes to be; or the robot
/// is at its target and turns. Nothing of the goal before counts for the next one.
void RecoverComponent::wait() {
  state_.gave_up = false;
  state_.why.clear();
  state_.escape = 0;
  state_.virtual_target_odom.reset();
  stop_escaping();
}

/// What was seen on the way to a way-point proves no trap on the way from it, which may lead back.
void RecoverComponent::notice_arrival(const domain::Target& target) {
  const std::uint32_t before = std::exchange(state_.waypoint, target.waypoint);
  if (before > 0 && before != target.waypoint) start_detectors_afresh();
}

/// Asks the detector in command. What it says starts the first escape, or goes to the one at work.
void RecoverComponent::take_evidence(const Situation& situation, Event& event) {
  auto evidence = parts_.detector.behaviour->observe(situation);
  if (!evidence) return;
  if (!state_.escaping) {
    mark_trap(event, parts_.detector.name, false, situation, *evidence);
    state_.evidence = std::move(*evidence);
    begin_escape(state_.escape, situation, event);
  } else if (parts_.escapes[state_.escape].behaviour->take_up(situation, *evidence)) {
    mark_trap(event, parts_.detector.name, false, situation, *evidence);
    state_.evidence = std::move(*evidence);
    start_detectors_afresh();
  }
}

void RecoverComponent::watch_shadows(const Situation& situation, Event& event) {
  for (auto& shadow : parts_.shadows) {
    const auto evidence = shadow.behaviour->observe(situation);
    if (evidence) mark_trap(event, shadow.name, true, situation, *evidence);
  }
}

/// Hands over to an escape; beyond the last one, the robot seeks again, and the first one is next.
void RecoverComponent::begin_escape(std::uint32_t index, const Situation& situation, Event& event) {
  if (index >= parts_.escapes.size()) {
    state_.escape = 0;
    stop_escaping();
    return;
  }
  state_.escaping = true;
  state_.escape = index;
  state_.maps = state_.maps || parts_.escapes[index].behaviour->reads_local_map();
  mark(event, EventKind::kEscapeBegun, parts_.escapes[index].name, situation, {});
  parts_.escapes[index].behaviour->begin(situation, state_.evidence);
}

void RecoverComponent::step_escape(const Situation& situation, Guidance& guidance, Event& event) {
  const std::string& name = parts_.escapes[state_.escape].name;
  guidance.mode = domain::GuidanceMode::kRecover;
  guidance.why.clear();
  state_.why.clear();
  const EscapeStatus status = parts_.escapes[state_.escape].behaviour->step(situation, guidance);
  if (status == EscapeStatus::kActive) return;
  if (status == EscapeStatus::kLooksAgain) {
    if (parts_.local_map) parts_.local_map->forget();
    return;
  }

  const std::string reason = guidance.why;
  if (status == EscapeStatus::kEnded) {
    mark(event, EventKind::kEscapeEnded, name, situation, reason);
    stop_escaping();
  } else if (status == EscapeStatus::kFailed) {
    mark(event, EventKind::kEscapeFailed, name, situation, reason);
    begin_escape(state_.escape + 1, situation, event);
    if (!state_.escaping) state_.why = in_short("all escapes failed, at last " + name, reason);
  } else {
    mark(event, EventKind::kUnreachable, name, situation, reason);
    stop_escaping();
    state_.gave_up = true;
    state_.why = in_short(name, reason);
  }
  // What the escape said in its last tick is void; the next one speaks from the next tick on.
  guidance.has_override = false;
  guidance.override_motion = {};
  guidance.virtual_obstacles.clear();
  guidance.why = state_.why;
  guidance.target_is_virtual = false;
  guidance.mode = state_.gave_up ? domain::GuidanceMode::kUnreachable
                                 : (state_.escaping ? domain::GuidanceMode::kRecover
                                                    : domain::GuidanceMode::kSeek);
  seek(situation, guidance);
}

/// Logs a virtual target when it is set, at its own place.
void RecoverComponent::mark_virtual_target(const Guidance& guidance, Event& event) {
  const auto before_odom = state_.virtual_target_odom;
  state_.virtual_target_odom.reset();
  if (!guidance.target_is_virtual) return;
  const core::Vec2 target_odom(guidance.target_x_m, guidance.target_y_m);
  state_.virtual_target_odom = target_odom;
  if ((before_odom && *before_odom == target_odom) || event.entries.full()) return;
  EventEntry entry;
  entry.kind = EventKind::kVirtualTarget;
  entry.rule = parts_.escapes[state_.escape].name;
  entry.x_m = target_odom.x();
  entry.y_m = target_odom.y();
  entry.text = guidance.why;
  event.entries.push_back(entry);
}

/// Immediate memory: a turn on the spot, in place of this tick's motion.
void RecoverComponent::act_at_once(const Situation& situation, Guidance& guidance, Event& event) {
  if (!parts_.immediate_memory || situation.landmark == nullptr || state_.gave_up) return;
  const auto turn_rad = parts_.immediate_memory->turn_rad(*situation.landmark);
  if (!turn_rad) return;
  guidance.has_override = true;
  guidance.override_motion.kind = domain::CommandKind::kTurnAndStep;
  guidance.override_motion.turn_rad = *turn_rad;
  guidance.why = "reflex";
  mark(event, EventKind::kReflex, "immediate_memory", situation, {});
}

void RecoverComponent::stop_escaping() {
  state_.escaping = false;
  start_detectors_afresh();
}

void RecoverComponent::start_detectors_afresh() {
  parts_.detector.behaviour->start_afresh();
  for (auto& shadow : parts_.shadows) shadow.behaviour->start_afresh();
}

void RecoverComponent::save(core::StateWriter& writer) const {
  writer(state_);
  if (parts_.local_map) parts_.local_map->save(writer);
  parts_.detector.behaviour->save(writer);
  for (const auto& shadow : parts_.shadows) shadow.behaviour->save(writer);
  for (const auto& escape : parts_.escapes) escape.behaviour->save(writer);
}

void RecoverComponent::load(core::StateReader& reader) {
  reader(state_);
  const bool has_escape = state_.escape < parts_.escapes.size();
  reader.check(has_escape || (state_.escape == 0 && !state_.escaping), "there is no such escape");
  reader.check(state_.why.size() <= domain::kMaxTextLength &&
                   state_.evidence.text.size() <= domain::kMaxTextLength,
               "a text is too long");
  if (!reader.ok()) state_ = {};
  if (parts_.local_map) parts_.local_map->load(reader);
  parts_.detector.behaviour->load(reader);
  for (auto& shadow : parts_.shadows) shadow.behaviour->load(reader);
  for (auto& escape : parts_.escapes) escape.behaviour->load(reader);
}

}  // namespace clew::recover
