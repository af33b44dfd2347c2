// SPDX-License-Identifier: Apache-2.0
#include "bag_import/bag_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "recorder/recording_sink.hpp"
#include "ros2/robot_inputs.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"

namespace clew::bag_import {
namespace {

using core::Error;
using core::Result;
using domain::Topic;

constexpr double kTargetRadius_m = 0.2;
/// Room around the path in the world that the recording says it ran in.
constexpr double kAround_m = 5.0;

/// The graph's files, with a world of our own.
class AroundTheBag : public runtime::ConfigSource {
 public:
  AroundTheBag(std::string world) : world_(std::move(world)) {}
  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    if (folder == "worlds") return core::Resource{"the bag's surroundings", world_};
    return files_.find(folder, name);
  }

 private:
  std::string world_;
  runtime::ConfigPath files_ = runtime::ConfigPath::from_environment();
};

/// The bag's odometry as Clew has it, with its times.
struct Track {
  std::vector<double> times_s;
  std::vector<domain::Odometry> odometry;
};

Result<Track> track_of(const RobotBag& bag) {
  Track track;
  ros2::OdometryInput input;
  for (const ros2::Odometry& message : bag.odometry) {
    auto odometry = input.next(message);
    if (!odometry.ok()) return odometry.error();
    track.times_s.push_back(ros2::to_seconds(message.header.stamp));
    track.odometry.push_back(std::move(odometry).value());
  }
  return track;
}

std::string world_around(const Track& track, const core::Vec2& target) {
  core::Vec2 least = target;
  core::Vec2 most = target;
  for (const domain::Odometry& odometry : track.odometry) {
    least = least.cwiseMin(odometry.pose_odom_robot.position());
    most = most.cwiseMax(odometry.pose_odom_robot.position());
  }
  const core::Pose2& start = track.odometry.front().pose_odom_robot;
  return fmt::format(
      "format: clew-world/1\nname: bag\nabout: \"What the robot of a bag saw; its obstacles are "
      "not "
      "known.\"\nbounds: [{}, {}, {}, {}]\nstart: [{}, {}, {}]\ntarget: [{}, {}]\n"
      "target_radius: {}\n",
      least.x() - kAround_m, least.y() - kAround_m, most.x() + kAround_m, most.y() + kAround_m,
      start.x_m, start.y_m, start.heading_rad, target.x(), target.y(), kTargetRadius_m);
}

/// Steps the stages that think on what the bag has, and records all topics.
class BagRun {
 public:
  BagRun(const runtime::RunPlan& plan, const RobotBag& bag, const Track& track,
         bridge::RecordingSink& sink)
      : plan_(plan), bag_(bag), track_(track), sink_(sink) {}

  Result<std::uint64_t> run(const core::Vec2& target) {
    CLEW_RETURN_IF_ERROR(make_nodes());
    const double begin_s =
        std::max(track_.times_s.front(), ros2::to_seconds(bag_.scans.front().header.stamp));
    const double end_s =
        std::min(track_.times_s.back(), ros2::to_seconds(bag_.scans.back().header.stamp));
    if (end_s < begin_s) return Error{"its scans and its odometry do not overlap"};
    const auto last =
        static_cast<std::uint64_t>(std::floor((end_s - begin_s) / plan_.graph.tick_s + 1e-9));
    for (std::uint64_t tick = 0; tick <= last; ++tick) {
      const double time_s = begin_s + static_cast<double>(tick) * plan_.graph.tick_s;
      CLEW_RETURN_IF_ERROR(step(tick, time_s, target, tick == last));
    }
    return last + 1;
  }

 private:
  /// All stages but those whose place the bag takes: drive and sense.
  Result<void> make_nodes() {
    const runtime::GraphStage* drive = plan_.graph.writer_of(Topic::kState);
    const runtime::GraphStage* sense = plan_.graph.writer_of(Topic::kScan);
    for (const runtime::GraphStage& stage : plan_.graph.stages) {
      if (&stage == drive || &stage == sense) continue;
      auto node = runtime::make_node(plan_, stage);
      if (!node.ok()) return node.error();
      nodes_.push_back(std::move(node).value());
    }
    return {};
  }

  Result<void> step(std::uint64_t tick, double time_s, const core::Vec2& target, bool is_last) {
    const domain::TickStamp stamp{tick, static_cast<double>(tick) * plan_.graph.tick_s, tick};
    while (next_odometry_ + 1 < track_.times_s.size() &&
           track_.times_s[next_odometry_ + 1] <= time_s + 1e-9) {
      ++next_odometry_;
    }
    while (next_scan_ + 1 < bag_.scans.size() &&
           ros2::to_seconds(bag_.scans[next_scan_ + 1].header.stamp) <= time_s + 1e-9) {
      ++next_scan_;
    }
    auto& odometry = std::get<domain::Odometry>(messages_);
    odometry = track_.odometry[next_odometry_];
    const domain::BehaviourSetup& setup = plan_.setup.behaviour;
    auto scan = ros2::to_scan(bag_.scans[next_scan_], bag_.pose_robot_laser, setup.scan,
                              setup.robot.radius_m);
    if (!scan.ok()) return scan.error();
    std::get<domain::Scan>(messages_) = std::move(scan).value();
    std::get<domain::Target>(messages_) = {{}, target.x(), target.y(), kTargetRadius_m};
    fill_state(odometry, target, is_last);
    for (const Topic topic : {Topic::kState, Topic::kOdometry, Topic::kTarget, Topic::kScan}) {
      if (topic == Topic::kTarget && is_taken_over(topic)) continue;
      CLEW_RETURN_IF_ERROR(record(topic, &stamp));
    }
    for (runtime::Node& node : nodes_) {
      runtime::TopicSet present = node.ports().inputs;
      if (tick > 0) present |= node.ports().delayed_inputs;
      node.step(tick, present, messages_);
      for (const Topic topic : node.ports().output_order) {
        CLEW_RETURN_IF_ERROR(record(topic, nullptr));
      }
    }
    return {};
  }

  void fill_state(const domain::Odometry& odometry, const core::Vec2& target, bool is_last) {
    auto& state = std::get<domain::State>(messages_);
    state.pose_world_robot = odometry.pose_odom_robot;
    state.speed_mps = odometry.speed_mps;
    state.turn_rate_radps = odometry.turn_rate_radps;
    state.path_length_m = odometry.travel_m;
    if (!is_last) return;
    const double left_m = (odometry.pose_odom_robot.position() - target).norm();
    state.outcome =
        left_m <= kTargetRadius_m ? domain::Outcome::kReached : domain::Outcome::kTimeout;
  }

  /// Whether a stage of the graph writes the topic, and not drive.
  bool is_taken_over(Topic topic) const {
    return std::any_of(nodes_.begin(), nodes_.end(), [&](const runtime::Node& node) {
      return node.ports().outputs[index_of(topic)];
    });
  }

  Result<void> record(Topic topic, const domain::TickStamp* stamp) {
    return domain::visit_topic(topic, [&](auto constant) -> Result<void> {
      auto& message = std::get<constant.kIndex>(messages_);
      if (stamp != nullptr) message.stamp = *stamp;
      const auto valid = domain::validate(message);
      if (!valid.ok()) return valid.error();
      return sink_.add({topic, message.stamp.tick, message.stamp.sequence,
                        std::get<constant.kIndex>(codecs_).encode(message)});
    });
  }

  const runtime::RunPlan& plan_;
  const RobotBag& bag_;
  const Track& track_;
  bridge::RecordingSink& sink_;
  std::vector<runtime::Node> nodes_;
  domain::Messages messages_;
  bridge::Codecs codecs_;
  std::size_t next_odometry_ = 0;
  std::size_t next_scan_ = 0;
};

Error in_bag(const BagImport& order, const Error& error) {
  return {error.message, error.file.empty() ? order.bag : error.file, error.line, error.column};
}

}  // namespace

Result<ImportedBag> import_bag(const BagImport& order,
                               const std::vector<runtime::StageInfo>& stages) {
  const auto bag = read_bag(order.bag, order.topics);
  if (!bag.ok()) return bag.error();
  const auto track = track_of(*bag);
  if (!track.ok()) return in_bag(order, track.error());
  const core::Vec2 target =
      order.target.value_or(track->odometry.back().pose_odom_robot.position());
  runtime::GraphOverrides overrides = order.overrides;
  overrides.world = "bag";
  const AroundTheBag files(world_around(*track, target));
  const auto plan = runtime::prepare_run(order.graph, overrides, files, stages);
  if (!plan.ok()) return plan.error();
  auto sink = bridge::RecordingSink::create(*plan, order.output, order.force);
  if (!sink.ok()) return sink.error();
  const auto ticks = BagRun(*plan, *bag, *track, **sink).run(target);
  if (!ticks.ok()) {
    bridge::mcap::OutputFile::discard(order.output);
    return in_bag(order, ticks.error());
  }
  const bridge::RecordingAccount account = (*sink)->close({});
  if (!account.failure.empty()) return Error{account.failure, order.output};
  return ImportedBag{*ticks, static_cast<double>(*ticks - 1) * plan->graph.tick_s,
                     bag->laser_is_known};
}

}  // namespace clew::bag_import
