// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/result.hpp"
#include "robot/robot_link.hpp"
#include "runtime/run_plan.hpp"

namespace clew::robot {

/// Refused, with the place in the graph: settings of a robot that are none, a ROS domain that is
/// `run_domain`, since a run has a DDS domain for itself, one of *sense* and *drive* without the
/// other, and a drive that has no acceleration to brake with.
core::Result<void> check_robots(const runtime::Graph& graph, std::optional<int> run_domain = {});

/// Whether a stage of the graph is a robot's.
bool has_robot(const runtime::Graph& graph);

/// The robots whose stages a process has. One that is met stays: whoever takes its stage's place
/// later, with another goal, speaks to the same.
class Robots {
 public:
  using Say = std::function<void(std::string)>;

  /// `on_notice` takes what a person should know, `on_fatal` why the run cannot go on.
  Robots(std::string run_id, int run_domain, Say on_notice, Say on_fatal)
      : run_id_(std::move(run_id)),
        run_domain_(run_domain),
        on_notice_(std::move(on_notice)),
        on_fatal_(std::move(on_fatal)) {}

  /// A node for a stage that has `ros2`; waits until the robot is there, for part of the time in
  /// which a run must have started.
  core::Result<runtime::Node> make_node(const runtime::RunPlan& plan,
                                        const runtime::GraphStage& stage);
  /// Tells all of them to stand still, and nothing more after that.
  void stand_still();

 private:
  core::Result<std::shared_ptr<RobotLink>> meet(const runtime::RunPlan& plan,
                                                const runtime::GraphStage& stage);

  const std::string run_id_;
  const int run_domain_;
  const Say on_notice_;
  const Say on_fatal_;
  std::map<std::string, std::shared_ptr<RobotLink>> links_;  ///< by stage
};

}  // namespace clew::robot
