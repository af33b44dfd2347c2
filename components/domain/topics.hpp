// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

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

/// One value of each topic, indexed by Topic.
using Messages = std::tuple<Command, Event, Guidance, Landmark, Odometry, Scan, State, Target>;
inline constexpr std::size_t kTopicCount = std::tuple_size_v<Messages>;

/// Where what is kept for each topic stands: in Messages and in arrays of kTopicCount.
constexpr std::size_t index_of(Topic topic) { return static_cast<std::size_t>(topic); }

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

namespace list_of_topics {

template <typename Tuple>
struct Of;
template <typename... Message>
struct Of<std::tuple<Message...>> {
  template <template <typename> class F>
  using PerTopic = std::tuple<F<Message>...>;
  using ConstPointer = std::variant<const Message*...>;
  using Pointer = std::variant<Message*...>;
};

template <std::size_t... I>
constexpr std::array<Topic, sizeof...(I)> all(std::index_sequence<I...>) {
  return {static_cast<Topic>(I)...};
}

}  // namespace list_of_topics

inline constexpr std::array<Topic, kTopicCount> kAllTopics =
    list_of_topics::all(std::make_index_sequence<kTopicCount>{});

/// An F<Message> of each topic, indexed by Topic: `PerTopic<Codec>`.
template <template <typename> class F>
using PerTopic = list_of_topics::Of<Messages>::PerTopic<F>;

/// A message of some topic, where the code is the same for all of them; never null.
using ConstMessagePointer = list_of_topics::Of<Messages>::ConstPointer;
using MessagePointer = list_of_topics::Of<Messages>::Pointer;

/// The DDS topic's name: `scan`.
std::string_view topic_name(Topic topic);
/// The DDS type's name: `clew::msg::Scan`.
std::string_view type_name(Topic topic);
std::optional<Topic> topic_from_name(std::string_view name);

/// A topic that is known when the program is compiled.
template <Topic topic>
struct TopicConstant : std::integral_constant<Topic, topic> {
  using Message = MessageOf<topic>;
  static constexpr std::size_t kIndex = index_of(topic);
};

/// Calls f(TopicConstant<topic>{}) for a topic known only at run time.
template <std::size_t I = 0, typename F>
decltype(auto) visit_topic(Topic topic, F&& f) {
  if constexpr (I + 1 < kTopicCount) {
    if (index_of(topic) != I) return visit_topic<I + 1>(topic, std::forward<F>(f));
  }
  return f(TopicConstant<static_cast<Topic>(I)>{});
}

/// Whether a sample may enter a component: every field keeps its rule (domain/message_fields.hpp),
/// and the fields those of their struct. The error names the field, what was found and what is
/// allowed.
core::Result<void> validate(ConstMessagePointer message);
template <typename Message>
core::Result<void> validate(const Message& message) {
  return validate(ConstMessagePointer(&message));
}

}  // namespace clew::domain
