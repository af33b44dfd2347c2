// SPDX-License-Identifier: Apache-2.0
#include "gateway/page_client.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "gateway/json_text.hpp"
#include "gateway/web_limits.hpp"

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

/// Ticks are sent together up to this size.
constexpr std::size_t kMostMessageBytes = 1024 * 1024;

std::string description_text(const RunDescription& description, const std::string& name) {
  ordered_json json = {{"name", name},
                       {"tick_s", description.tick_s},
                       {"seed", std::to_string(description.seed)},
                       {"bundle", ordered_json::object()},
                       {"topics", ordered_json::array()}};
  for (const auto& [file, text] : description.bundle) {
    if (file.find(".yaml") != std::string::npos) json["bundle"][file] = text;
  }
  for (const auto& [topic, text] : description.schemas) {
    json["topics"].push_back({{"number", static_cast<int>(topic)},
                              {"name", domain::topic_name(topic)},
                              {"type", domain::type_name(topic)},
                              {"idl", text}});
  }
  return json_text(json);
}

}  // namespace

PageClient::PageClient(LiveStream& stream, SocketSender& sender)
    : stream_(stream), sender_(sender) {
  stream_.follow(*this);
  all_ = !stream_.ended().empty();
  if (stream_.description()) begin();
  if (!stream_.ended().empty()) end();
}

void PageClient::begin() {
  sender_.send_text(description_text(*stream_.description(), stream_.name()));
  send_changes();
  send_all();
}

void PageClient::receive_text(std::string_view text) {
  const auto asked = ordered_json::parse(text, nullptr, false);
  if (!asked.is_object()) return;
  if (const auto all = asked.find("all"); all != asked.end() && all->is_boolean()) {
    all_ = all->get<bool>();
  }
  if (const auto has = asked.find("has_all"); has != asked.end() && has->is_boolean()) {
    has_all_ = has->get<bool>();
  }
  const auto from = asked.find("from");
  if (from == asked.end() || !from->is_number_unsigned()) return;
  next_ = from->get<std::uint64_t>();
  is_end_due_ = !stream_.ended().empty();
  send_all();
  tell_end();
}

void PageClient::pass_on() {
  send_changes();
  pass_on_ticks();
  tell_end();
}

void PageClient::pass_on_ticks() {
  const auto newest = stream_.newest();
  if (!newest || newest->number < next_ || sender_.queued_bytes() > kMostUnderWayBytes) return;
  if (all_) return send_all();
  missed_ += newest->number - next_;
  sender_.send_binary(std::make_shared<const std::string>(*newest->records));
  next_ = newest->number + 1;
}

void PageClient::end() {
  send_changes();
  pass_on_ticks();
  is_end_due_ = true;
  tell_end();
}

void PageClient::tell_end() {
  if (!is_end_due_ || stream_.tick_from(next_)) return;
  is_end_due_ = false;
  if (!std::exchange(has_told_missed_, true)) sender_.send_text(json_text({{"missed", missed_}}));
  sender_.send_text(json_text({{"ended", stream_.ended()}}));
}

// Before the samples of their ticks, since what they say holds from there on.
void PageClient::send_changes() {
  const auto& changes = stream_.interventions();
  const auto& incidents = stream_.incidents();
  if (!stream_.description() || changes_ + incidents_ == changes.size() + incidents.size()) return;
  ordered_json told = {{"changes", ordered_json::array()}, {"incidents", ordered_json::array()}};
  for (; changes_ < changes.size(); ++changes_) {
    const domain::Intervention& each = changes[changes_];
    told["changes"].push_back(
        {{"tick", each.tick}, {"changes", each.changes}, {"order", each.order}});
  }
  for (; incidents_ < incidents.size(); ++incidents_) {
    const domain::Incident& each = incidents[incidents_];
    told["incidents"].push_back(
        {{"tick", each.tick}, {"kind", each.kind}, {"stage", each.stage}, {"text", each.text}});
  }
  sender_.send_text(json_text(told));
}

// What is held, from next_ on, as far as the client takes it.
void PageClient::send_all() {
  std::string message;
  for (auto tick = stream_.tick_from(next_); tick; tick = stream_.tick_from(next_)) {
    message += *tick->records;
    next_ = tick->number + 1;
    if (message.size() < kMostMessageBytes) continue;
    sender_.send_binary(std::make_shared<const std::string>(std::move(message)));
    message.clear();
    if (sender_.queued_bytes() > kMostUnderWayBytes) return;
  }
  if (message.empty()) return;
  sender_.send_binary(std::make_shared<const std::string>(std::move(message)));
}

}  // namespace clew::bridge
