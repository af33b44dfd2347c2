// SPDX-License-Identifier: Apache-2.0
#include "replay/topic_publisher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {

using domain::Topic;

std::string published_name(Topic topic, const TopicNames& names) {
  const auto found = names.find(topic);
  return found == names.end() ? std::string(domain::topic_name(topic)) : found->second;
}

core::Result<TopicPublisher> TopicPublisher::create(Participant& participant,
                                                    const runtime::Graph& graph,
                                                    const runtime::TopicSet& topics,
                                                    int history_depth, const TopicNames& names) {
  TopicPublisher publisher;
  publisher.topics_ = topics;
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    if (!topics[index]) continue;
    const runtime::GraphStage* stage = graph.writer_of(topic);
    CLEW_CHECK(stage != nullptr, std::string(domain::topic_name(topic)) + " has no writer");
    UserData user_data{std::string(idl_fingerprint()), stage->info->name};
    // Third-party components do not tell their stage.
    if (!stage->deployment.exec.empty()) user_data.stage.clear();
    auto writer = participant.create_writer({published_name(topic, names),
                                             std::string(domain::type_name(topic)),
                                             user_data.to_text(), history_depth});
    if (!writer.ok()) return writer.error();
    publisher.writers_[index] = std::move(writer).value();
    publisher.samples_[topic] = 0;
  }
  return publisher;
}

core::Result<bool> TopicPublisher::write(const RecordedTick& recorded) {
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    if (!topics_[index] || written_[index] || !recorded.has(topic)) continue;
    const WriteStatus status = writers_[index]->write(recorded.cdr(topic));
    if (status == WriteStatus::kWouldBlock) return false;
    if (status == WriteStatus::kFailed) {
      return core::Error{"cannot write '" + std::string(domain::topic_name(topic)) + "'"};
    }
    written_.set(index);
    ++samples_[topic];
  }
  written_.reset();
  return true;
}

bool TopicPublisher::acknowledged() const {
  return std::all_of(writers_.begin(), writers_.end(), [](const auto& writer) {
    return writer == nullptr || writer->acknowledged();
  });
}

}  // namespace clew::bridge
