// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "core/hash128.hpp"

namespace clew::bridge {

/// The hash of a run: over the names of its topics and the values of their chains
/// (core::HashChain), in the order of the names, each as a line `name hexadecimal-digits`.
inline core::Hash128 run_hash(const std::map<std::string, core::Hash128>& chains) {
  std::string lines;
  for (const auto& [topic, chain] : chains) lines += topic + ' ' + chain.hex() + '\n';
  return core::hash128(lines);
}

}  // namespace clew::bridge
