// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "runtime/config_source.hpp"
#include "runtime/node.hpp"
#include "runtime/stage.hpp"
#include "world/world.hpp"

namespace clew::runtime {

/// What the command line changes in a graph file. Texts are as typed, without the option.
struct GraphOverrides {
  std::optional<std::string> world;
  std::optional<std::string> robot;
  std::vector<std::string> with;  ///< `STAGE[.PART]=NAME[,NAME...]`
  std::vector<std::string> set;   ///< `STAGE[.PART][.NAME].PARAM=VALUE`
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> max_ticks;
  std::optional<std::uint64_t> robot_index;
  std::optional<world::Goals> goals;
};

/// Where something stands: in a graph file, or in the option that gave it.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;

  core::Error error(std::string message) const { return {std::move(message), file, line, column}; }
};

/// A data file that a parameter of a chosen behaviour names.
struct NamedFile {
  std::string parameter;
  std::string folder;
  std::string name;
  Place place;
};

/// How a stage is run, which changes no result.
struct Deployment {
  std::string middleware;         ///< `cyclonedds`, `fastdds`, or empty: the run's default
  std::vector<std::string> exec;  ///< command of a third-party component; empty: ours
  bool json_lines = false;  ///< with exec: it speaks JSON lines, and a relay of ours DDS for it
  bool stateless = false;   ///< with exec: its outputs follow from the inputs of the tick alone
  /// A robot of ROS 2 takes the stage's place, and this is where it is found; bridge/robot knows
  /// the settings.
  std::optional<std::map<std::string, std::string>> ros2;
  std::uint32_t restart_limit = 100;  ///< how often its process may be restarted in a run
  double restart_backoff_s = 0.0;     ///< how long it stays down before
  std::string group;                  ///< stages of one group share a process; empty: its own
  Place group_place;                  ///< where the group is named
  std::string host;                   ///< on which its process runs; empty: where the run does

  /// Whether the stage's behaviour does what the stage does: not a program, and not a robot.
  bool is_ours() const { return exec.empty() && !ros2; }
  /// Whether a third-party component is on the wire itself.
  bool is_on_the_wire() const { return !exec.empty() && !json_lines; }
  /// Whether its process can take up where another one of it has left.
  bool may_restart() const { return exec.empty() || stateless; }
};

/// A stage of a graph, its names and values checked against the stage's declarations.
struct GraphStage {
  const StageInfo* info = nullptr;
  /// With exec or ros2: empty, but for the behaviour that says what others must know of it
  /// beforehand: the arrangement of a sensor's scans, a drive's tick and limits.
  StageConfig config;
  Deployment deployment;
  NodePorts ports;
  Place place;
  std::vector<NamedFile> files;

  /// Its part of a graph file, with every value in it.
  std::string expanded_yaml() const;
};

/// A host's name is a word of a command line, and that of its certificate.
bool is_host_name(const std::string& name);
inline constexpr char kHostNameRule[] =
    "up to 48 letters, digits, '-', '.' and '_', the first no '-'";

/// What a graph's `security` says if each run is to have keys of its own.
inline constexpr char kMintedKeys[] = "minted";

/// A graph, complete: every default filled in, every port wired.
struct Graph {
  std::string name;
  std::string world;
  std::string robot;
  std::uint64_t seed = 1;
  std::uint64_t max_ticks = 20000;
  std::uint64_t robot_index = 0;  ///< among the robots of its world
  double start_timeout_s = 10.0;
  std::optional<world::Goals> goals;  ///< in the place of the world's way-points and target
  std::string layout = "processes";   ///< or `composed`; the command line outranks it
  /// What protects its wire: a directory of keys, or empty, keys for the run alone. None: nothing.
  std::optional<std::string> security;
  double tick_s = 0.0;
  /// In an order in which an input of the same tick is written before it is read.
  std::vector<GraphStage> stages;
  std::vector<std::string> unwired;  ///< optional ports without a writer: `recover.landmark`
  Place place;
  Place world_place;
  Place robot_place;
  Place goals_place;

  const GraphStage* find(const std::string& stage) const;
  /// The stage that writes a topic, if any.
  const GraphStage* writer_of(Topic topic) const;
  /// The stages that read a topic, in order.
  std::vector<const GraphStage*> readers_of(Topic topic) const;

  /// The graph as a graph file with every value in it. How stages are deployed is left out, except
  /// exec and ros2: the same run has the same text in every layout.
  std::string expanded_yaml() const;
};

/// Reads and checks a graph file. Refused, with the place and what is allowed: unknown, missing,
/// duplicate or unused keys, unknown behaviours, wrong types, values out of range, required ports
/// that nobody writes, behaviours that miss an input they need, two writers of a topic, cycles
/// without a delay, and overrides that name what is not there.
core::Result<Graph> load_graph(const core::Resource& file, const std::string& name,
                               const GraphOverrides& overrides,
                               const std::vector<StageInfo>& stages);

}  // namespace clew::runtime
