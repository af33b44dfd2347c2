// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/result.hpp"
#include "domain/messages.hpp"

namespace clew::domain {

/// The topics, in the order of their names: the order of a recording within a tick, and of the
/// hash.
enum class Topic : std::uint8_t {
  kCommand,
  kEvent,
  kGuidance,
  kLandmark,
  kOdometry,
  kScan,
  kState,
  kTarget
};
inline constexpr std::size_t kTopicCount = 8;

/// Where what is kept for each topic stands: in Messages and in arrays of kTopicCount.
constexpr std::size_t index_of(Topic topic) { return static_cast<std::size_t>(topic); }

/// One value of each topic, indexed by Topic.
using Messages = std::tuple<Command, Event, Guidance, Landmark, Odometry, Scan, State, Target>;
static_assert(std::tuple_size_v<Messages> == kTopicCount);

template <Topic topic>
using MessageOf = std::tuple_element_t<index_of(topic), Messages>;

/// The topic whose messages are of type M.
template <typename M, std::size_t I = 0>
constexpr Topic topic_of() {
  static_assert(I < kTopicCount, "not a message type");
  if constexpr (std::is_same_v<M, std::tuple_element_t<I, Messages>>) {
    return static_cast<Topic>(I);
  } else {
    return topic_of<M, I + 1>();
  }
}

inline constexpr std::array<Topic, kTopicCount> kAllTopics = {
    Topic::kCommand,  Topic::kEvent, Topic::kGuidance, Topic::kLandmark,
    Topic::kOdometry, Topic::kScan,  Topic::kState,    Topic::kTarget};

/// The DDS topic's name: `scan`.
std::string_view topic_name(Topic topic);
/// The DDS type's name: `clew::msg::Scan`.
std::string_view type_name(Topic topic);
std::optional<Topic> topic_from_name(std::string_view name);

/// Calls f(std::integral_constant<Topic, topic>{}) for a topic known only at run time.
template <typename F>
decltype(auto) visit_topic(Topic topic, F&& f) {
  switch (topic) {
    case Topic::kCommand:
      return f(std::integral_constant<Topic, Topic::kCommand>{});
    case Topic::kEvent:
      return f(std::integral_constant<Topic, Topic::kEvent>{});
    case Topic::kGuidance:
      return f(std::integral_constant<Topic, Topic::kGuidance>{});
    case Topic::kLandmark:
      return f(std::integral_constant<Topic, Topic::kLandmark>{});
    case Topic::kOdometry:
      return f(std::integral_constant<Topic, Topic::kOdometry>{});
    case Topic::kScan:
      return f(std::integral_constant<Topic, Topic::kScan>{});
    case Topic::kState:
      return f(std::integral_constant<Topic, Topic::kState>{});
    case Topic::kTarget:
      break;
  }
  return f(std::integral_constant<Topic, Topic::kTarget>{});
}

/// Whether a sample may enter a component: every number finite and in its range, every list within
/// its bound, every enumerator known. The error names the field, what was found and what is
/// allowed.
core::Result<void> validate(const Command& m);
core::Result<void> validate(const Event& m);
core::Result<void> validate(const Guidance& m);
core::Result<void> validate(const Landmark& m);
core::Result<void> validate(const Odometry& m);
core::Result<void> validate(const Scan& m);
core::Result<void> validate(const State& m);
core::Result<void> validate(const Target& m);

}  // namespace clew::domain
