// SPDX-License-Identifier: Apache-2.0
/// Our half of the tests against other implementations of the format; see npm/.
///   interop write FILE COMPRESSION    records a run and prints, as JSON, what it recorded
///   interop read                      prints, as one JSON line for each file named in a line of
///                                     stdin, what our reader finds in it

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "message_json.hpp"
#include "random_messages.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/run_recorder.hpp"
#include "recording/run_recording.hpp"
#include "wire/codec.hpp"

namespace clew::recording_test {
namespace {

using nlohmann::json;
using namespace bridge;

std::string hexadecimal(std::string_view bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

template <typename T>
T value_or_exit(core::Result<T> result) {
  if (!result.ok()) {
    std::fprintf(stderr, "%s\n", result.error().text().c_str());
    std::exit(1);
  }
  return std::move(result).value();
}

void ok_or_exit(const core::Result<void>& result) {
  if (result.ok()) return;
  std::fprintf(stderr, "%s\n", result.error().text().c_str());
  std::exit(1);
}

RunDescription description() {
  RunDescription run;
  run.tick_s = 0.1;
  run.seed = 18446744073709551615U;
  run.versions = {{"clew", "0.1.0"}};
  run.idl_fingerprint = std::string(idl_fingerprint());
  run.bundle = {{"graph.yaml", "world: u-trap\n"}, {"world.yaml", "about: \"\xC3\xBC\"\n"}};
  for (const auto topic : domain::kAllTopics) run.schemas[topic] = idl_text(topic);
  return run;
}

int write(const std::string& path, const std::string& compression_name) {
  constexpr std::uint64_t kTicks = 80;
  RunDescription run = description();
  run.compression = mcap::compression_from_name(compression_name).value();
  auto recorder = value_or_exit(RunRecorder::create(path, run, true));
  json samples = json::array();
  RandomMessages random(1);
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    for (const auto topic : domain::kAllTopics) {
      domain::visit_topic(topic, [&](auto constant) {
        using Message = domain::MessageOf<decltype(constant)::value>;
        Message message;
        random.fill(message);
        Codec<Message> codec;
        ok_or_exit(recorder.add(topic, tick, tick, codec.encode(message)));
        const std::string time = std::to_string(tick * 100'000'000);
        samples.push_back({{"topic", "/" + std::string(domain::topic_name(topic))},
                           {"sequence", tick},
                           {"log_time_ns", time},
                           {"publish_time_ns", time},
                           {"fields", to_json(message)}});
      });
    }
  }
  ok_or_exit(recorder.finish());
  const auto end = value_or_exit(RunRecording::open(path)).end();
  const json metadata = {{kDescriptionName, to_metadata(run).entries},
                         {kEndName, to_metadata(end.value()).entries}};
  const json written = {{"attachments", run.bundle}, {"metadata", metadata}, {"samples", samples}};
  std::printf("%s\n", written.dump().c_str());
  return 0;
}

json messages_of(const mcap::McapReader& reader, mcap::Order order) {
  json messages = json::array();
  auto stream = reader.messages(order);
  for (;;) {
    const auto message = value_or_exit(stream.next());
    if (!message) return messages;
    messages.push_back({{"topic", reader.channels().at(message->channel_id).topic},
                        {"sequence", message->sequence},
                        {"log_time_ns", std::to_string(message->log_time_ns)},
                        {"publish_time_ns", std::to_string(message->publish_time_ns)},
                        {"data", hexadecimal(message->data)}});
  }
}

json declarations_of(const mcap::McapReader& reader) {
  json schemas = json::array();
  for (const auto& [id, schema] : reader.schemas()) {
    schemas.push_back(
        {{"id", id}, {"name", schema.name}, {"encoding", schema.encoding}, {"data", schema.data}});
  }
  json channels = json::array();
  for (const auto& [id, channel] : reader.channels()) {
    channels.push_back({{"id", id},
                        {"schema_id", channel.schema_id},
                        {"topic", channel.topic},
                        {"message_encoding", channel.message_encoding},
                        {"metadata", channel.metadata}});
  }
  return {{"schemas", schemas}, {"channels", channels}};
}

json read(const std::string& path) {
  const auto reader = value_or_exit(mcap::McapReader::open(path));
  ok_or_exit(reader.verify());
  json attachments = json::array();
  mcap::ByteBuffer buffer;
  for (const auto& place : reader.attachments()) {
    const auto attachment = value_or_exit(reader.attachment(place, buffer));
    attachments.push_back({{"name", attachment.name},
                           {"media_type", attachment.media_type},
                           {"log_time_ns", std::to_string(attachment.log_time_ns)},
                           {"create_time_ns", std::to_string(attachment.create_time_ns)},
                           {"data", hexadecimal(attachment.data)}});
  }
  json metadata = json::array();
  for (const auto& place : reader.metadata()) {
    const auto record = value_or_exit(reader.metadata(place));
    metadata.push_back({{"name", record.name}, {"entries", record.entries}});
  }
  json found = declarations_of(reader);
  found["header"] = {{"profile", reader.header().profile}, {"library", reader.header().library}};
  found["indexed"] = reader.indexed();
  found["tear"] = reader.tear() ? json(reader.tear()->reason) : json();
  found["in_file_order"] = messages_of(reader, mcap::Order::kFile);
  found["by_time"] = messages_of(reader, mcap::Order::kLogTime);
  found["attachments"] = attachments;
  found["metadata"] = metadata;
  return found;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 3 && arguments[0] == "write") return write(arguments[1], arguments[2]);
  if (arguments.size() != 1 || arguments[0] != "read") return 2;
  for (std::string path; std::getline(std::cin, path);) {
    std::printf("%s\n", read(path).dump().c_str());
  }
  return 0;
}

}  // namespace
}  // namespace clew::recording_test

int main(int argc, char** argv) { return clew::recording_test::run({argv + 1, argv + argc}); }
