// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "contract/mission.hpp"

namespace clew::stages {

/// What is in configs/.
runtime::ConfigPath shipped_configs();

/// The names of the graphs in configs/.
std::vector<std::string> shipped_graphs();

/// A run of a shipped graph.
class Mission : public contract::Mission {
 public:
  /// `graph` in `world`; `with` and `set` as on the command line.
  Mission(const std::string& graph, const std::string& world,
          const std::vector<std::string>& with = {}, const std::vector<std::string>& set = {});

  /// Why the same would not be run; empty if it would.
  static std::string refusal(const std::string& graph, const std::string& world,
                             const std::vector<std::string>& with);

  void load(const Saved& saved);
};

}  // namespace clew::stages
