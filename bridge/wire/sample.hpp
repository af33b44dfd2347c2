// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "domain/topics.hpp"

namespace clew::bridge {

/// One serialised sample of a topic; `cdr` belongs to whoever made it.
struct SampleView {
  domain::Topic topic = domain::Topic::kCommand;
  std::uint64_t tick = 0;
  std::uint64_t sequence = 0;  ///< its stamp's; that of a third party need not be the tick
  std::string_view cdr;
};

/// A serialised sample with bytes of its own.
struct Sample {
  Sample() = default;
  explicit Sample(const SampleView& view)
      : topic(view.topic), tick(view.tick), sequence(view.sequence), cdr(view.cdr) {}

  SampleView view() const { return {topic, tick, sequence, cdr}; }

  domain::Topic topic = domain::Topic::kCommand;
  std::uint64_t tick = 0;
  std::uint64_t sequence = 0;
  std::string cdr;
};

}  // namespace clew::bridge
