// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "domains/domain_bridge.hpp"

namespace clew::domains {

struct BridgeProcess {
  double status_s = 0.0;  ///< how often `report` is called; 0: at the end only
  std::function<void(const std::string&)> tell;
  std::function<void(const DomainBridge&)> report;
};

/// Joins the domains of a file until SIGINT or SIGTERM comes. Refused: a run that is not there, the
/// same domain by two names, and what a vendor refuses.
core::Result<void> run_bridge_process(const BridgeFile& file, const BridgeProcess& process);

/// What became of the samples, a line a passage: for people, or as JSON.
std::string passages_text(const DomainBridge& bridge);
std::string passages_json(const DomainBridge& bridge);

}  // namespace clew::domains
