// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "domains/condition.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::domains {

/// A domain that a bridge joins.
struct JoinedDomain {
  std::string name;  ///< in the file
  std::string run;   ///< the domain's number, or a run's name
  bridge::Vendor vendor = bridge::Vendor::kCycloneDds;
  bool on_network = false;  ///< beyond 127.0.0.1
};

/// What is passed on.
struct TopicRule {
  std::string topic;  ///< as on DDS, with at most one `*`: `rt/*`
  std::string as;     ///< its name on the other side; a `*` stands for what the first one is
  std::string type;   ///< only this one; empty: any
  std::size_t from = 0;
  std::vector<std::size_t> to;
  double rate_hz = 0.0;          ///< of a writer's samples, at most; 0: all
  std::vector<Condition> where;  ///< all must hold
  int depth = 64;                ///< samples that a writer keeps
  bool best_effort = false;      ///< read like that, whatever the writer offers

  /// The other side's name of a topic; none if the rule is not of it.
  std::optional<std::string> renamed(const std::string& found) const;
};

/// A bridge's file, `clew-bridge/1`.
struct BridgeFile {
  std::vector<JoinedDomain> domains;
  std::vector<TopicRule> rules;
};

/// Reads a file. Refused, with the place and what is allowed: unknown or duplicate keys, domains
/// that are not in the file, a topic to where it comes from, the same twice, wildcards that do not
/// fit each other, conditions that a type cannot meet.
core::Result<BridgeFile> read_bridge_file(const core::Resource& file);

}  // namespace clew::domains
