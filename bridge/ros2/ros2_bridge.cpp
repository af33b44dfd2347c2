// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_bridge.hpp"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "line/command_desk.hpp"
#include "line/link.hpp"
#include "log/log.hpp"
#include "ros2/goal_input.hpp"
#include "ros2/node.hpp"
#include "ros2/robot_inputs.hpp"
#include "ros2/run_publisher.hpp"
#include "run/end_signals.hpp"
#include "run/limits.hpp"
#include "runtime/goals.hpp"
#include "watch/run_watch.hpp"

namespace clew::ros2 {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// A person may start the bridge first and the run afterwards.
constexpr auto kJoinTimeout = std::chrono::seconds(60);
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr int kInterruptedStatus = 130;

/// A run that answers later hangs; what it publishes is waiting meanwhile.
constexpr auto kAnswerTimeout = std::chrono::seconds(2);

/// Until there is a run, nothing is to be ended in order: signals do what they do to any program.
core::Result<void> wait_for_run(const std::string& run, SteadyClock::time_point deadline) {
  const auto socket = bridge::is_domain_number(run)
                          ? bridge::Link::connect(std::stoi(run), deadline)
                          : bridge::Link::connect(run, deadline);
  if (!socket.ok()) return socket.error();
  // Who says nothing is taken for a stranger.
  bridge::Link link(*socket);
  bridge::post_command(link, {bridge::RunCommand::Kind::kStatus, {}, std::nullopt});
  static_cast<void>(link.wait_for_frame(SteadyClock::now() + kAnswerTimeout));
  return {};
}

core::Result<bridge::CommandAnswer> change(const std::string& run, const std::string& text) {
  const auto socket = bridge::connect_to_run(run);
  if (!socket.ok()) return socket.error();
  bridge::Link link(*socket);
  bridge::post_command(link, {bridge::RunCommand::Kind::kChange, {text}, std::nullopt});
  const auto frame = link.wait_for_frame(SteadyClock::now() + kAnswerTimeout);
  if (!frame.ok()) return frame.error();
  return bridge::answer_of(*frame);
}

/// Hands goals on to the run, which fixes the tick and records it; says what became of it.
void hand_on(GoalInput& goals, const RunPublisher& publisher, const std::string& run,
             const std::optional<double>& heading_tolerance_rad) {
  for (const std::string& notice : goals.take_notices()) {
    logs::warning("{}", notice);
  }
  const auto poses = goals.take();
  if (!poses) return;
  world::Goals places;
  for (const PoseStamped& pose : *poses) {
    const auto place = publisher.pose_in_world(pose);
    if (!place.ok()) {
      logs::warning("the goal is refused: {}", place.error().message);
      return;
    }
    places.push_back({place->position(), std::nullopt});
    // An orientation of zeros is none.
    if (!heading_tolerance_rad || !to_pose2(pose.pose).ok()) continue;
    places.back().heading = {place->heading_rad, *heading_tolerance_rad};
  }
  const std::string text = runtime::goals_change(places);
  const auto answer = change(run, text);
  if (answer.ok()) {
    logs::info("{} at tick {}", text, answer->tick);
  } else {
    logs::warning("{} is refused: {}", text, answer.error().text());
  }
}

/// What this process logs, until /rosout is told of it: any thread may log, one publishes.
class Logged {
 public:
  Logged() {
    logs::listen([this](logs::Level level, const std::string& text) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (lines_.size() < kMostLines) lines_.emplace_back(level, text);
    });
  }
  ~Logged() { logs::listen(nullptr); }
  Logged(const Logged&) = delete;
  Logged& operator=(const Logged&) = delete;

  void publish(RunPublisher& publisher) {
    std::vector<std::pair<logs::Level, std::string>> lines;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      lines.swap(lines_);
    }
    for (const auto& [level, text] : lines) publisher.log(level, "bridge", text);
  }

 private:
  static constexpr std::size_t kMostLines = 1000;

  std::mutex mutex_;
  std::vector<std::pair<logs::Level, std::string>> lines_;
};

/// Publishes what comes until the run is over or a signal comes, which it returns; else 0. `goals`
/// may be null.
int follow(bridge::RunWatch& watch, RunPublisher& publisher, GoalInput* goals,
           const std::optional<double>& heading_tolerance_rad, Logged& logged,
           bridge::EndSignals& signals) {
  SteadyClock::time_point heard_at = SteadyClock::now();
  SteadyClock::time_point next_report = heard_at + kReportPeriod;
  bool goes_on = true;
  while (true) {
    // What came before the run's end is published, too.
    const std::vector<bridge::Sample> samples = watch.take();
    for (const bridge::Sample& sample : samples) publisher.add(sample);
    for (const std::string& line : watch.take_notices()) {
      publisher.log(logs::Level::kWarning, "run", line);
    }
    logged.publish(publisher);
    if (!goes_on && samples.empty()) return 0;
    const SteadyClock::time_point now = SteadyClock::now();
    if (!samples.empty()) heard_at = now;
    if (now >= next_report) {
      next_report = now + kReportPeriod;
      publisher.add_report(std::chrono::duration<double>(now - heard_at).count(), watch.dropped());
    }
    if (goals != nullptr && goes_on) {
      hand_on(*goals, publisher, std::to_string(watch.run().domain), heading_tolerance_rad);
    }
    if (const int number = signals.take()) return number;
    if (goes_on) watch.wait({signals.descriptor()}, next_report - now);
    goes_on = goes_on && watch.goes_on();
  }
}

}  // namespace

core::Result<int> run_ros2_bridge(const BridgeOptions& options,
                                  const std::vector<runtime::StageInfo>& stages) {
  const auto deadline = SteadyClock::now() + kJoinTimeout;
  CLEW_RETURN_IF_ERROR(wait_for_run(options.run, deadline));
  bridge::EndSignals signals;
  auto watch = bridge::RunWatch::join(options.run, deadline);
  if (!watch.ok()) return watch.error();
  const auto plan = runtime::prepare_run((*watch)->run().bundle, stages);
  if (!plan.ok()) return plan.error();

  const int domain = (*watch)->run().domain;
  if (domain == options.network.domain) {
    return core::Error{
        fmt::format("domain {} is the run's own: ROS needs another one; give "
                    "--ros-domain or ROS_DOMAIN_ID",
                    domain)};
  }
  NodeConfig config;
  config.vendor = options.vendor;
  config.network = options.network;
  config.distro = options.distro;
  config.name = options.node_name;
  const Names names(options.node_namespace, options.remap);
  config.node_namespace = names.node_namespace();
  config.origin.id = (*watch)->run().run_id;
  Logged logged;
  auto node = Node::create(config);
  if (!node.ok()) return node.error();
  auto publisher = RunPublisher::create(**node, names, config.name, *plan);
  if (!publisher.ok()) return publisher.error();
  std::optional<GoalInput> goals;
  if (options.takes_goals) {
    goals.emplace(**node);
    CLEW_RETURN_IF_ERROR(goals->listen(**node, names.topic("goal_pose"), names.topic("waypoints")));
  }
  CLEW_RETURN_IF_ERROR((*node)->announce());
  (*publisher)->begin();
  logs::info("run {} in domain {}, ROS domain {} on {}", config.origin.id, domain,
             options.network.domain, options.network.on_network ? "the network" : "127.0.0.1");

  const int number = follow(**watch, **publisher, goals ? &*goals : nullptr,
                            options.goal_heading_tolerance_rad, logged, signals);
  (*publisher)->end(number == 0 ? "the run is over" : "the bridge was told to end");
  return number == 0 ? 0 : kInterruptedStatus;
}

}  // namespace clew::ros2
