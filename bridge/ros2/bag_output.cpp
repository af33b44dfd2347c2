// SPDX-License-Identifier: Apache-2.0
#include "ros2/bag_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

namespace clew::ros2 {
namespace {

using bridge::WriteStatus;
namespace fs = std::filesystem;

constexpr char kLibrary[] = "clew";
constexpr char kMetadataFile[] = "metadata.yaml";

std::string indented(const std::string& text, int spaces) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    out += std::string(static_cast<std::size_t>(spaces), ' ') + line + '\n';
  }
  return out;
}

/// `run` for `out/run/`: rosbag2 names a bag's files after its directory.
std::string bag_name(const std::string& directory) {
  const fs::path path = fs::absolute(directory).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

class BagOutput::TopicWriter : public bridge::SampleWriter {
 public:
  TopicWriter(BagOutput& bag, std::size_t topic) : bag_(bag), topic_(topic) {}
  WriteStatus write(std::string_view cdr) override { return bag_.write(topic_, cdr); }
  bool acknowledged() const override { return true; }
  std::string guid() const override { return {}; }

 private:
  BagOutput& bag_;
  const std::size_t topic_;
};

core::Result<std::unique_ptr<BagOutput>> BagOutput::create(const std::string& directory,
                                                           bool force) {
  std::error_code error;
  if (fs::exists(directory, error) && !force) {
    return core::Error{"exists; --force replaces the bag in it", directory};
  }
  fs::create_directories(directory, error);
  if (error) return core::Error{error.message(), directory};
  const std::string file = bag_name(directory) + "_0.mcap";
  auto writer =
      bridge::mcap::McapWriter::create((fs::path(directory) / file).string(), force,
                                       {"ros2", kLibrary, bridge::mcap::Compression::kZstd});
  if (!writer.ok()) return writer.error();
  return std::unique_ptr<BagOutput>(new BagOutput(directory, file, std::move(writer).value()));
}

BagOutput::BagOutput(std::string directory, std::string file, bridge::mcap::McapWriter writer)
    : directory_(std::move(directory)), file_(std::move(file)), writer_(std::move(writer)) {}

core::Result<std::unique_ptr<bridge::SampleWriter>> BagOutput::open_topic(
    const std::string& topic, const MessageType& type, const QosProfile& profile) {
  const std::uint16_t schema = writer_.add_schema(type.name, "ros2msg", type.definition);
  const std::uint16_t channel = writer_.add_channel(
      schema, topic, "cdr",
      {{"offered_qos_profiles", offered_qos_yaml(profile)}, {"topic_type_hash", type.hash}});
  topics_.push_back({topic, type.name, type.hash, profile, channel});
  return std::unique_ptr<bridge::SampleWriter>(
      std::make_unique<TopicWriter>(*this, topics_.size() - 1));
}

WriteStatus BagOutput::write(std::size_t topic, std::string_view cdr) {
  if (!state_.ok()) return WriteStatus::kFailed;
  // rosbag2 writes no sequence numbers.
  state_ = writer_.write(bridge::mcap::Message{topics_[topic].channel, 0, time_ns_, time_ns_, cdr});
  if (!state_.ok()) return WriteStatus::kFailed;
  first_ns_ = std::min(first_ns_, time_ns_);
  ++topics_[topic].message_count;
  ++message_count_;
  return WriteStatus::kTaken;
}

std::string BagOutput::metadata_yaml() const {
  const std::uint64_t first_ns = message_count_ > 0 ? first_ns_ : 0;
  const std::uint64_t duration_ns = message_count_ > 0 ? time_ns_ - first_ns : 0;
  std::string topics;
  for (const BagTopic& topic : topics_) {
    topics += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles:\n{}"
        "        type_description_hash: {}\n      message_count: {}\n",
        topic.name, topic.type, indented(offered_qos_yaml(topic.profile), 10), topic.hash,
        topic.message_count);
  }
  return fmt::format(
      "rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: mcap\n"
      "  duration:\n    nanoseconds: {1}\n  starting_time:\n    nanoseconds_since_epoch: {0}\n"
      "  message_count: {2}\n  topics_with_message_count:\n{3}"
      "  compression_format: \"\"\n  compression_mode: \"\"\n"
      "  relative_file_paths:\n    - {4}\n  files:\n    - path: {4}\n"
      "      starting_time:\n        nanoseconds_since_epoch: {0}\n"
      "      duration:\n        nanoseconds: {1}\n      message_count: {2}\n"
      "  custom_data: ~\n  ros_distro: jazzy\n",
      first_ns, duration_ns, message_count_, topics, file_);
}

core::Result<void> BagOutput::finish() {
  CLEW_RETURN_IF_ERROR(state_);
  const std::string yaml = metadata_yaml();
  CLEW_RETURN_IF_ERROR(
      writer_.write(bridge::mcap::Metadata{"rosbag2", {{"serialized_metadata", yaml}}}));
  CLEW_RETURN_IF_ERROR(writer_.finish());
  auto file =
      bridge::mcap::OutputFile::create((fs::path(directory_) / kMetadataFile).string(), true);
  if (!file.ok()) return file.error();
  CLEW_RETURN_IF_ERROR(file->append(yaml));
  return file->publish();
}

}  // namespace clew::ros2
