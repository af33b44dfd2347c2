// SPDX-License-Identifier: Apache-2.0
#include "plot/run_track.hpp"

#include <array>
#include <filesystem>
#include <set>
#include <utility>

#include "core/yaml_reader.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"
#include "world/world.hpp"

namespace clew::plot {
namespace {

using core::Pose2;
using core::Vec2;
using domain::Topic;

/// Decodes samples into what a track needs, tick by tick.
class TrackReader {
 public:
  core::Result<void> add(const bridge::SampleView& sample) {
    switch (sample.topic) {
      case Topic::kState:
        return decode(sample, states_, state_);
      case Topic::kOdometry:
        return decode(sample, odometries_, odometry_);
      case Topic::kGuidance:
        return decode(sample, guidances_, guidance_);
      case Topic::kCommand:
        return decode(sample, commands_, command_);
      case Topic::kLandmark:
        return decode(sample, landmarks_, landmark_);
      case Topic::kTarget:
        return decode(sample, targets_, target_);
      case Topic::kEvent:
        return decode(sample, events_, event_);
      default:
        return {};
    }
  }

  /// Enters what was decoded since the last call: the samples of one tick.
  void end_tick(std::uint64_t tick, RunTrack& track) {
    if (state_) enter_state(track);
    // Without a pose there is no place to draw anything at.
    if (state_ && odometry_) {
      const FramePair frames = {state_->pose_world_robot, odometry_->pose_odom_robot};
      track.frames[tick] = frames;
      if (guidance_) enter_guidance(frames, track);
      if (command_) enter_command(frames, track);
      if (event_) enter_event(frames, track);
      if (target_) enter_target(frames, track);
      enter_belief(frames, track);
    }
    if (state_ && landmark_) enter_landmark(track);
    state_.reset();
    odometry_.reset();
    guidance_.reset();
    command_.reset();
    landmark_.reset();
    event_.reset();
    target_.reset();
  }

 private:
  template <typename Message>
  static core::Result<void> decode(const bridge::SampleView& sample, bridge::Codec<Message>& codec,
                                   std::optional<Message>& message) {
    const auto decoded = codec.decode(sample.cdr, message.emplace());
    if (decoded.ok()) return {};
    return core::Error{"tick " + std::to_string(sample.tick) + " of " +
                       std::string(domain::topic_name(sample.topic)) + ": " +
                       decoded.error().message};
  }

  void enter_state(RunTrack& track) {
    if (track.poses.empty()) track.first_tick = state_->stamp.tick;
    const domain::State& before = track.last_state;
    const Vec2 position = state_->pose_world_robot.position();
    if (state_->safety_stops > before.safety_stops) track.safety_stops.push_back(position);
    if (state_->collisions > before.collisions) track.collisions.push_back(position);
    if (state_->hit_by > before.hit_by) track.hits.push_back(position);
    track.poses.push_back(state_->pose_world_robot);
    track.recovering.push_back(guidance_ && guidance_->mode == domain::GuidanceMode::kRecover);
    track.last_state = *state_;
  }

  void enter_guidance(const FramePair& frames, RunTrack& track) {
    std::optional<Vec2> target;
    if (guidance_->target_is_virtual) target = Vec2(guidance_->target_x_m, guidance_->target_y_m);
    if (target && target != virtual_target_) {
      track.virtual_targets.push_back({frames.to_world(*target), frames.world_robot.position()});
    }
    virtual_target_ = target;
    for (const domain::VirtualObstacle& box : guidance_->virtual_obstacles) {
      if (!boxes_.insert({box.x_min_m, box.y_min_m, box.x_max_m, box.y_max_m}).second) continue;
      track.virtual_obstacles.push_back({frames.to_world({box.x_min_m, box.y_min_m}),
                                         frames.to_world({box.x_max_m, box.y_min_m}),
                                         frames.to_world({box.x_max_m, box.y_max_m}),
                                         frames.to_world({box.x_min_m, box.y_max_m})});
    }
  }

  void enter_command(const FramePair& frames, RunTrack& track) {
    for (const domain::VirtualTarget& target : command_->virtual_targets) {
      const std::pair place(target.x_m, target.y_m);
      if (!controller_targets_.insert(place).second) continue;
      track.controller_targets.push_back(frames.to_world({target.x_m, target.y_m}));
    }
  }

  /// What a plan says in place of the mission's way-points.
  void enter_target(const FramePair& frames, RunTrack& track) {
    if (!subgoals_.insert({target_->x_m, target_->y_m}).second) return;
    track.subgoals.push_back(frames.to_world({target_->x_m, target_->y_m}));
  }

  void enter_belief(const FramePair& frames, RunTrack& track) {
    if (!first_frames_) first_frames_ = frames;
    track.believed.push_back(first_frames_->to_world(frames.odom_robot.position()));
  }

  void enter_landmark(RunTrack& track) {
    if (!landmark_->presented) return;
    for (const auto& recognition : landmark_->recognitions) {
      track.landmarks.push_back({state_->pose_world_robot.position(), recognition.network});
    }
  }

  void enter_event(const FramePair& frames, RunTrack& track) {
    for (const auto& entry : event_->entries) {
      const Vec2 position = frames.to_world({entry.x_m, entry.y_m});
      switch (entry.kind) {
        case domain::EventKind::kLandmark:       // told by the landmark topic
        case domain::EventKind::kVirtualTarget:  // told by the guidance topic
          break;
        case domain::EventKind::kTrap:
          track.traps.push_back({position, earlier_visit(entry, frames, track), entry.shadow});
          break;
        default:
          track.marks.push_back({entry.kind, position});
      }
    }
  }

  static std::optional<Vec2> earlier_visit(const domain::EventEntry& entry, const FramePair& now,
                                           const RunTrack& track) {
    if (!entry.has_earlier) return std::nullopt;
    const auto then = track.frames.find(entry.earlier_tick);
    const FramePair& frames = then == track.frames.end() ? now : then->second;
    return frames.to_world({entry.earlier_x_m, entry.earlier_y_m});
  }

  bridge::Codec<domain::State> states_;
  bridge::Codec<domain::Odometry> odometries_;
  bridge::Codec<domain::Guidance> guidances_;
  bridge::Codec<domain::Command> commands_;
  bridge::Codec<domain::Landmark> landmarks_;
  bridge::Codec<domain::Event> events_;
  bridge::Codec<domain::Target> targets_;
  std::optional<domain::State> state_;
  std::optional<domain::Odometry> odometry_;
  std::optional<domain::Guidance> guidance_;
  std::optional<domain::Command> command_;
  std::optional<domain::Landmark> landmark_;
  std::optional<domain::Event> event_;
  std::optional<domain::Target> target_;
  std::optional<Vec2> virtual_target_;     ///< of the tick before, odometry's frame
  std::set<std::array<double, 4>> boxes_;  ///< that are entered
  std::set<std::pair<double, double>> subgoals_;
  std::optional<FramePair> first_frames_;
  std::set<std::pair<double, double>> controller_targets_;  ///< that are entered
};

/// A belief that is true is no other path.
constexpr double kLeastDrift_m = 0.02;

void keep_what_differs(const bridge::RunDescription& description, RunTrack& track) {
  bool drifts = false;
  for (std::size_t i = 0; i < track.believed.size() && i < track.poses.size(); ++i) {
    drifts = drifts || (track.believed[i] - track.poses[i].position()).norm() > kLeastDrift_m;
  }
  if (!drifts) track.believed.clear();
  const auto graph = description.bundle.find("graph.yaml");
  const auto root = graph == description.bundle.end()
                        ? core::Result<core::YamlNode>(core::Error{"none"})
                        : core::YamlNode::parse(graph->second, "graph.yaml");
  if (!root.ok() || !root->find("plan")) track.subgoals.clear();
}

core::Result<void> read_samples(const bridge::RunRecording& recording, RunTrack& track) {
  TrackReader reader;
  auto samples =
      recording.samples({{Topic::kState, Topic::kOdometry, Topic::kGuidance, Topic::kCommand,
                          Topic::kLandmark, Topic::kEvent, Topic::kTarget}});
  std::optional<std::uint64_t> tick;
  for (;;) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    const bool at_end = !sample->has_value();
    if (tick && (at_end || (*sample)->tick != *tick)) reader.end_tick(*tick, track);
    if (at_end) return {};
    tick = (*sample)->tick;
    CLEW_RETURN_IF_ERROR(reader.add(**sample));
  }
}

/// The behaviours that a part of the graph names: a word, a list of words, or maps from the words
/// to parameters.
std::string names_of(const std::optional<core::YamlNode>& part) {
  if (!part) return {};
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : "+") + name; };
  if (const auto word = part->string(); word.ok()) add(*word);
  if (const auto entries = part->entries(); entries.ok()) {
    for (const auto& entry : *entries) add(entry.key);
  }
  if (const auto items = part->items(); items.ok()) {
    for (const auto& item : *items) add(names_of(item));
  }
  return names;
}

/// `default: no_progress, remembered_map`; what the graph does not say is left out.
std::string graph_text(const std::string& yaml) {
  const auto root = core::YamlNode::parse(yaml, "graph.yaml");
  if (!root.ok()) return {};
  std::string text = names_of(root->find("name"));
  const auto recover = root->find("recover");
  if (!recover) return text;
  for (const char* part : {"detector", "escape"}) {
    const std::string names = names_of(recover->find(part));
    if (!names.empty()) text += (text.empty() ? "" : ", ") + names;
  }
  return text;
}

core::Result<void> read_configuration(const bridge::RunDescription& description, RunTrack& track) {
  const auto world = description.bundle.find("world.yaml");
  const auto robot = description.bundle.find("robot.yaml");
  if (world == description.bundle.end() || robot == description.bundle.end()) {
    return core::Error{"does not hold the run's world.yaml and robot.yaml"};
  }
  track.world = world->second;
  const auto graph = description.bundle.find("graph.yaml");
  if (graph != description.bundle.end()) track.graph = graph_text(graph->second);
  track.seed = description.seed;
  track.tick_s = description.tick_s;
  const auto body = runtime::read_robot({"robot.yaml", robot->second}, "robot");
  if (!body.ok()) return body.error();
  track.robot_radius_m = body->radius_m;
  const auto place = world::World::parse(track.world, "world.yaml");
  if (!place.ok()) return place.error();
  track.start = place->start();
  return {};
}

}  // namespace

Vec2 FramePair::to_world(const Vec2& place_odom) const {
  const Vec2 turn = core::direction(world_robot.heading_rad - odom_robot.heading_rad);
  const Vec2 offset = place_odom - odom_robot.position();
  return world_robot.position() + Vec2(turn.x() * offset.x() - turn.y() * offset.y(),
                                       turn.y() * offset.x() + turn.x() * offset.y());
}

core::Result<RunTrack> read_run_track(const std::string& path) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return recording.error();
  const auto refused = [&path](const std::string& why) { return core::Error{why, path}; };
  RunTrack track;
  track.name = std::filesystem::path(path).stem().string();
  track.path = path;
  track.cut_off = !recording->complete();
  if (const auto read = read_configuration(recording->description(), track); !read.ok()) {
    return refused(read.error().text());
  }
  auto missions = bridge::missions_of(recording->description().bundle, recording->interventions());
  if (!missions.ok()) return refused(missions.error().text());
  track.missions = std::move(missions).value();
  if (const auto read = read_samples(*recording, track); !read.ok()) {
    return refused(read.error().message);
  }
  keep_what_differs(recording->description(), track);
  if (track.poses.empty()) return refused("holds no sample of the topic state");
  return track;
}

}  // namespace clew::plot
