// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/composed_executor.hpp"
#include "runtime/graph.hpp"

namespace clew::runtime {

/// Everything that decides a run, read and checked: what is left is to run it.
struct RunPlan {
  Graph graph;
  RunSetup setup;
  const std::vector<StageInfo>* known_stages = nullptr;  ///< those it was prepared with
  Bundle bundle;  ///< the texts that this plan was made of; another plan made of them is the same
};

/// Reads a graph with its world, robot and data files, and makes every component once to see that
/// the parts fit. An error says what is needed and what is there.
core::Result<RunPlan> prepare_run(const std::string& graph, const GraphOverrides& overrides,
                                  const ConfigSource& source, const std::vector<StageInfo>& stages);

/// The plan that a bundle was made from: a recording's, or a running supervisor's.
core::Result<RunPlan> prepare_run(const Bundle& bundle, const std::vector<StageInfo>& stages);

/// What the stage `only` needs of a plan that somebody else has prepared: no component is made, and
/// the world, which may be large, is read only for a stage that knows it.
core::Result<RunPlan> read_prepared_run(const Bundle& bundle, const std::vector<StageInfo>& stages,
                                        const std::string& only);

/// The run that the bundle in `source` describes, with overrides; with `only`, what that stage
/// needs of it. No component is made.
core::Result<RunPlan> read_changed_run(const GraphOverrides& overrides, const ConfigSource& source,
                                       const std::vector<StageInfo>& stages,
                                       const std::optional<std::string>& only);

/// Makes the component of a stage with its ports.
core::Result<Node> make_node(const RunPlan& plan, const GraphStage& stage);
/// The same by somebody who knows of stages that are not ours.
using MakeNode = std::function<core::Result<Node>(const RunPlan&, const GraphStage&)>;

/// All of them, in the order of the graph; a stage with exec or ros2 cannot be composed.
core::Result<std::vector<Node>> make_nodes(const RunPlan& plan);

/// Reads a robot file: `{format: clew-robot/1, radius_m: 0.15}`, with an optional `name`, else it
/// is called `name`, and an optional `about`.
core::Result<domain::Robot> read_robot(const core::Resource& file, const std::string& name);

}  // namespace clew::runtime
