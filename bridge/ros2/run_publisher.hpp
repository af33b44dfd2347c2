// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "log/log.hpp"
#include "map/local_map.hpp"
#include "ros2/conversions.hpp"
#include "ros2/names.hpp"
#include "ros2/run_markers.hpp"
#include "ros2/topic_output.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"
#include "wire/sample.hpp"

namespace clew::ros2 {

/// Publishes a run as the topics of a robot: takes its samples in any order between topics, each
/// topic in its own, and says what it knows as soon as it knows it. A sample that is missing costs
/// what would be made of it, and no more.
class RunPublisher {
 public:
  /// Creates the topics. `plan` must outlive it.
  static core::Result<std::unique_ptr<RunPublisher>> create(TopicOutput& output, const Names& names,
                                                            const std::string& node_name,
                                                            const runtime::RunPlan& plan);
  /// What does not change: the frames of the robot, and the map.
  void begin();

  /// A sample of the run; bytes that are no message are counted and passed over.
  void add(const bridge::Sample& sample);
  /// What is said now and then: maps, markers, diagnostics. `idle_s`: how long the run has been
  /// silent; `dropped`: samples that the bridge lost.
  void add_report(double idle_s, std::uint64_t dropped);
  /// Where a place of ROS lies in the world. Refused: frames other than the map's and the
  /// odometry's, and places that are none.
  core::Result<core::Pose2> pose_in_world(const PoseStamped& place) const;
  /// A line of /rosout of what somebody logged: `speaker` comes after the node's name.
  void log(logs::Level level, const std::string& speaker, const std::string& text);
  /// The run is over, for whatever reason.
  void end(const std::string& why);

 private:
  RunPublisher(const Names& names, const runtime::RunPlan& plan, std::string node_name);
  core::Result<void> open(TopicOutput& output, const Names& names);
  void take(const domain::State& state);
  void take(const domain::Odometry& odometry);
  void take(const domain::Scan& scan);
  void take(const domain::Target& target);
  void take(const domain::Guidance& guidance);
  void take(const domain::Event& event);
  void take(const domain::Command&) {}
  void take(const domain::Landmark&) {}
  bool has(domain::Topic topic) const { return next_sequence_[index_of(topic)] > 0; }
  void publish_transforms();
  void say(std::uint8_t level, const std::string& text) { say(level, node_name_, text); }
  void say(std::uint8_t level, const std::string& name, const std::string& text);
  void publish_seen();
  DiagnosticArray diagnostics(double idle_s, std::uint64_t dropped) const;

  const runtime::RunPlan& plan_;
  const Frames frames_;
  const std::string node_name_;
  bridge::Codecs codecs_;
  domain::Messages messages_;  ///< the last one of each topic
  /// The sequence that the next sample of a topic has at least; 0: there was none.
  std::array<std::uint64_t, domain::kTopicCount> next_sequence_{};
  map::LocalMap seen_;
  bool seen_changed_ = false;
  RunMarkers markers_;
  std::uint64_t ticks_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t late_commands_ = 0;
  std::optional<domain::Outcome> outcome_;
  std::optional<std::uint64_t> transforms_tick_;
  std::optional<core::Vec2> goal_sent_;

  std::optional<Publisher<Clock>> clock_;
  std::optional<Publisher<LaserScan>> scan_;
  std::optional<Publisher<Odometry>> odometry_;
  std::optional<Publisher<TFMessage>> tf_;
  std::optional<Publisher<TFMessage>> tf_static_;
  std::optional<Publisher<OccupancyGrid>> map_;
  std::optional<Publisher<OccupancyGrid>> map_seen_;
  std::optional<Publisher<Path>> path_;
  std::optional<Publisher<PoseStamped>> goal_;
  std::optional<Publisher<DiagnosticArray>> diagnostics_;
  std::optional<Publisher<Log>> log_;
  std::optional<Publisher<MarkerArray>> marker_array_;
};

}  // namespace clew::ros2
