// SPDX-License-Identifier: Apache-2.0
#include "gateway/foxglove_client.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "gateway/json_text.hpp"
#include "gateway/web_limits.hpp"
#include "run/sample_account.hpp"

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

/// Numbers of channels: our topics as they are, the others behind them.
constexpr std::uint32_t kFirstFoxglove = domain::kTopicCount;
constexpr std::size_t kMostSubscriptions = 1000;
constexpr char kMessageData = 1;

ordered_json channels_json(const RunDescription& description) {
  ordered_json channels = ordered_json::array();
  for (const auto& [topic, idl] : description.schemas) {
    channels.push_back({{"id", static_cast<std::uint32_t>(topic)},
                        {"topic", '/' + std::string(domain::topic_name(topic))},
                        {"encoding", "cdr"},
                        {"schemaName", domain::type_name(topic)},
                        {"schemaEncoding", "omgidl"},
                        {"schema", idl}});
  }
  std::uint32_t number = kFirstFoxglove;
  for (const FoxgloveChannel& channel : foxglove_channels()) {
    channels.push_back({{"id", number++},
                        {"topic", channel.topic},
                        {"encoding", "json"},
                        {"schemaName", channel.schema_name},
                        {"schemaEncoding", "jsonschema"},
                        {"schema", channel.schema}});
  }
  return channels;
}

template <typename Number>
void append_little_endian(Number value, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

std::optional<std::uint32_t> number_of(const ordered_json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  const auto number = found->get<std::uint64_t>();
  if (number > UINT32_MAX) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

}  // namespace

FoxgloveClient::FoxgloveClient(LiveStream& stream, SocketSender& sender)
    : stream_(stream), sender_(sender) {
  sender_.send_text(json_text({{"op", "serverInfo"},
                               {"name", "clew"},
                               {"capabilities", ordered_json::array()},
                               {"supportedEncodings", ordered_json::array()},
                               {"metadata", ordered_json::object()}}));
  stream_.follow(*this);
  if (stream_.description()) begin();
}

void FoxgloveClient::begin() {
  sender_.send_text(
      json_text({{"op", "advertise"}, {"channels", channels_json(*stream_.description())}}));
}

void FoxgloveClient::receive_text(std::string_view text) {
  const auto asked = ordered_json::parse(text, nullptr, false);
  const std::string op = asked.is_object() ? asked.value("op", ordered_json("")).dump() : "";
  if (op == "\"subscribe\"") {
    for (const auto& each : asked.value("subscriptions", ordered_json::array())) {
      const auto subscription = number_of(each, "id");
      const auto channel = number_of(each, "channelId");
      if (!subscription || !channel) return refuse("a subscription needs id and channelId");
      subscribe(*subscription, *channel);
    }
  } else if (op == "\"unsubscribe\"") {
    for (const auto& each : asked.value("subscriptionIds", ordered_json::array())) {
      if (each.is_number_unsigned()) channels_.erase(each.get<std::uint32_t>());
    }
  } else {
    refuse("this server is read only; it takes subscribe and unsubscribe");
  }
}

void FoxgloveClient::subscribe(std::uint32_t subscription, std::uint32_t channel) {
  const bool is_known = channel < kFirstFoxglove + foxglove_channels().size() &&
                        channels_.size() < kMostSubscriptions && stream_.description();
  if (!is_known) return refuse("there is no channel " + std::to_string(channel));
  channels_[subscription] = channel;
  // Each begins with what is held, also what others of this client have had: a scene needs its
  // world.
  next_ = 0;
  const auto newest = stream_.newest();
  backlog_end_ = newest ? newest->number + 1 : 0;
  auto scene = FoxgloveScene::create(*stream_.description());
  if (scene.ok()) {
    scene_ = std::move(scene).value();
  } else {
    scene_.reset();
  }
}

void FoxgloveClient::pass_on() {
  if (channels_.empty()) return;
  // After the backlog the newest only, but all of a run that has ended.
  while (sender_.queued_bytes() < kMostUnderWayBytes) {
    const bool all = next_ < backlog_end_ || !stream_.ended().empty();
    const auto tick = all ? stream_.tick_from(next_) : stream_.newest();
    if (!tick || tick->number < next_) return;
    send_tick(*tick);
    next_ = tick->number + 1;
    if (!all) return;
  }
}

void FoxgloveClient::send_tick(const LiveStream::Tick& tick) {
  const std::uint64_t time_ns = tick_to_ns(tick.number, stream_.description()->tick_s);
  std::vector<SampleView> samples;
  for_each_spooled(*tick.records, {[&](const SampleView& sample) {
                                     samples.push_back(sample);
                                     send(static_cast<std::uint32_t>(sample.topic), time_ns,
                                          sample.cdr);
                                   },
                                   [](const SpooledState&) {}});
  if (!scene_) return;
  scene_->take_changes(stream_.interventions());
  for (const FoxgloveMessage& message : scene_->convert(time_ns, samples)) {
    send(kFirstFoxglove + static_cast<std::uint32_t>(message.topic), time_ns, message.json);
  }
}

void FoxgloveClient::send(std::uint32_t channel, std::uint64_t time_ns, std::string_view payload) {
  for (const auto& [subscription, subscribed] : channels_) {
    if (subscribed != channel) continue;
    std::string bytes(1, kMessageData);
    append_little_endian(subscription, bytes);
    append_little_endian(time_ns, bytes);
    bytes.append(payload);
    sender_.send_binary(std::make_shared<const std::string>(std::move(bytes)));
  }
}

void FoxgloveClient::refuse(const std::string& why) {
  sender_.send_text(json_text({{"op", "status"}, {"level", 2}, {"message", why}}));
}

}  // namespace clew::bridge
