// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "core/hash128.hpp"
#include "domain/topics.hpp"
#include "run/sample_sink.hpp"

namespace clew::hunt {

/// Where a run first differs from another.
struct FirstDifference {
  std::uint64_t tick = 0;
  domain::Topic topic = domain::Topic::kState;
};

/// What every topic said at every tick, as hashes.
class RunTrace : public bridge::SampleSink {
 public:
  core::Result<void> add(const bridge::SampleView& sample) override;

  /// Of the topics that both have, as in `clew diff`; one that ends sooner differs there.
  std::optional<FirstDifference> first_difference(const RunTrace& other) const;

 private:
  std::map<std::pair<std::uint64_t, domain::Topic>, std::pair<std::uint64_t, std::uint64_t>>
      samples_;
  std::map<domain::Topic, std::uint64_t> topics_;  ///< the last tick of each
};

}  // namespace clew::hunt
