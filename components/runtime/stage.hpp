// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "runtime/component.hpp"

namespace clew::world {
class World;
}

namespace clew::runtime {

/// What holds for a whole run, and every component may know.
struct RunSetup {
  std::uint64_t seed = 1;
  std::uint32_t robot_index = 0;  ///< that of BehaviourSetup; random numbers depend on it
  std::uint64_t max_ticks = 20000;
  std::shared_ptr<const world::World> world;  ///< null for a stage that may not know it
  /// What behaviours may know of it, the layout of the scans included.
  domain::BehaviourSetup behaviour;
};

/// A chosen variant of a part, with a value for each of its parameters.
struct PartChoice {
  std::string name;
  core::ParameterValues parameters;
};

/// The configuration of one stage, checked and complete.
struct StageConfig {
  std::string stage;
  core::ParameterValues parameters;                      ///< of the stage itself
  std::map<std::string, std::vector<PartChoice>> parts;  ///< by the part's name

  /// The only choice of a part that is no list.
  const PartChoice& part(const std::string& wanted) const;
};

/// What `clew list` prints of a behaviour, and what the check of a graph knows of it.
struct VariantInfo {
  std::string name;
  std::string summary;  ///< one line, with the source
  std::vector<core::ParameterInfo> parameters;
  TopicSet needs;  ///< optional inputs of the stage that this variant cannot do without
};

/// A choice that a stage offers: `behaviour`, or recover's `detector` and `escape`.
struct PartInfo {
  std::string name;
  bool is_list = false;  ///< any number, in order
  std::vector<VariantInfo> variants;

  /// None if there is no variant of that name.
  const VariantInfo* find(const std::string& wanted) const;
};

/// A value of a graph's key `mission`, short for the stage with one of its behaviours.
struct MissionInfo {
  std::string word;
  std::string behaviour;
};

/// A stage: its declarations, and how to make its component. The list of all of them is
/// stages::all().
struct StageInfo {
  std::string name;
  std::string summary;
  std::vector<PortInfo> ports;
  std::vector<core::ParameterInfo> parameters;
  std::vector<PartInfo> parts;
  /// The duration of a tick that this configuration asks for; 0 where it does not care.
  std::function<double(const StageConfig&)> tick_s;
  /// The layout of the scans that this configuration makes; only sense has one.
  std::function<domain::ScanLayout(const StageConfig&)> scan_layout;
  /// Makes the component, and with it checks data files and fit: an error says what is needed and
  /// what is there.
  std::function<core::Result<std::unique_ptr<Component>>(const StageConfig&, const RunSetup&)> make;
  /// What the drive of this configuration can do; only drive knows.
  std::function<domain::MotionLimits(const StageConfig&)> motion_limits = nullptr;
  /// Whether its component is told the world; all others know what sensors and the bus tell.
  bool knows_world = false;
  /// Short forms of the stage in a graph.
  std::vector<MissionInfo> missions = {};
};

/// Who writes a topic, as a message calls it: a stage's name, or what is missing.
std::string writer_of(Topic topic, const std::vector<StageInfo>& stages);

}  // namespace clew::runtime
