// SPDX-License-Identifier: Apache-2.0
/// Names of topics and frames as ROS 2 has them: namespaces, remapping, and their form on the wire.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::ros2 {

/// `from:=to`: a topic that is to have another name.
struct RemapRule {
  std::string from;
  std::string to;
};

/// Refused: what is not of the form `from:=to` with two names in it.
core::Result<RemapRule> parse_remap_rule(const std::string& text);

/// Whether a name may be a topic's: tokens of letters, digits and underscores that do not begin
/// with a digit, between single slashes. The error says what is wrong.
core::Result<void> check_topic_name(const std::string& name);
/// The same of a namespace, where `/` and nothing at all are good, too.
core::Result<void> check_namespace(const std::string& name);

/// How a node of one namespace calls its topics.
class Names {
 public:
  /// `node_namespace` as a person writes it: `robot1` and `/robot1` are the same.
  Names(const std::string& node_namespace, std::vector<RemapRule> rules);

  /// `/robot1`; `/` for none.
  const std::string& node_namespace() const { return namespace_; }
  /// The whole name of a topic: `scan` is `/robot1/scan`, `/tf` is `/tf`, both before the rules,
  /// of which the first one that fits holds.
  std::string topic(const std::string& name) const;
  /// A frame of the robot: `robot1/odom`, since /tf knows no namespaces.
  std::string frame(const std::string& name) const;

 private:
  std::string absolute(const std::string& name) const;

  std::string namespace_;
  std::vector<RemapRule> rules_;
};

/// `rt/scan` for `/scan`.
std::string dds_topic(const std::string& topic);

}  // namespace clew::ros2
