// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "domain/topics.hpp"

namespace clew::bridge {

/// Samples that a recording of a run lacks, though their writers should have written them.
class SampleLosses {
 public:
  /// `topic` has no sample of the ticks from `first` to `last`.
  void add_ticks(domain::Topic topic, std::uint64_t first, std::uint64_t last);
  /// `topic` has a sample of `tick`, but `count` sequence numbers before it are missing.
  void add_sequences(domain::Topic topic, std::uint64_t tick, std::uint64_t count);

  std::uint64_t samples() const { return samples_; }
  /// `'scan' of ticks 5 to 7`, `2 samples of 'command' before tick 9`, ..., by topic; of many, how
  /// many more there are.
  std::vector<std::string> texts() const;

 private:
  struct Loss {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint64_t first_tick = 0;
    std::uint64_t last_tick = 0;
    std::uint64_t sequences = 0;  ///< 0: the ticks are missing
  };
  void add(const Loss& loss);

  std::vector<Loss> losses_;
  std::uint64_t unlisted_ = 0;
  std::uint64_t samples_ = 0;
};

}  // namespace clew::bridge
