// SPDX-License-Identifier: Apache-2.0
#include "hunt/run_trace.hpp"

#include <string>

namespace clew::hunt {

core::Result<void> RunTrace::add(const bridge::SampleView& sample) {
  const core::Hash128 hash = core::hash128(std::string(sample.cdr));
  samples_[{sample.tick, sample.topic}] = {hash.low, hash.high};
  topics_[sample.topic] = sample.tick;
  return {};
}

std::optional<FirstDifference> RunTrace::first_difference(const RunTrace& other) const {
  for (const auto& [key, hash] : samples_) {
    if (other.topics_.count(key.second) == 0) continue;
    const auto found = other.samples_.find(key);
    if (found == other.samples_.end() || found->second != hash) {
      return FirstDifference{key.first, key.second};
    }
  }
  for (const auto& [key, hash] : other.samples_) {
    if (topics_.count(key.second) > 0 && samples_.count(key) == 0) {
      return FirstDifference{key.first, key.second};
    }
  }
  return std::nullopt;
}

}  // namespace clew::hunt
