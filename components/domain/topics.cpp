// SPDX-License-Identifier: Apache-2.0
#include "domain/topics.hpp"

namespace clew::domain {
namespace {

struct TopicNames {
  std::string_view topic;
  std::string_view type;
};

/// Indexed by Topic.
constexpr std::array<TopicNames, kTopicCount> kNames = {{{"command", "clew::msg::Command"},
                                                         {"event", "clew::msg::Event"},
                                                         {"guidance", "clew::msg::Guidance"},
                                                         {"landmark", "clew::msg::Landmark"},
                                                         {"odometry", "clew::msg::Odometry"},
                                                         {"scan", "clew::msg::Scan"},
                                                         {"state", "clew::msg::State"},
                                                         {"target", "clew::msg::Target"}}};

}  // namespace

std::string_view topic_name(Topic topic) { return kNames[index_of(topic)].topic; }

std::string_view type_name(Topic topic) { return kNames[index_of(topic)].type; }

std::optional<Topic> topic_from_name(std::string_view name) {
  for (const Topic topic : kAllTopics) {
    if (topic_name(topic) == name) return topic;
  }
  return std::nullopt;
}

}  // namespace clew::domain
