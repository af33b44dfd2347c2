// SPDX-License-Identifier: Apache-2.0
#include "bag_import/bag_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "recording/mcap_reader.hpp"
#include "ros2/message_codec.hpp"
#include "ros2/robot_inputs.hpp"

namespace clew::bag_import {
namespace {

namespace fs = std::filesystem;
namespace mcap = bridge::mcap;
using core::Error;
using core::Result;

/// The MCAP files of a bag, in the order of their names, as rosbag2 numbers them.
Result<std::vector<std::string>> files_of(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return std::vector<std::string>{path};
  std::vector<std::string> files;
  bool has_database = false;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const std::string kind = entry.path().extension().string();
    if (kind == ".mcap") files.push_back(entry.path().string());
    has_database = has_database || kind == ".db3";
  }
  if (error) return Error{error.message(), path};
  if (files.empty()) {
    return Error{has_database ? "is a bag of SQLite; 'ros2 bag convert' makes one of MCAP"
                              : "has no .mcap file",
                 path};
  }
  // x_2 before x_10.
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    return std::make_pair(a.size(), a) < std::make_pair(b.size(), b);
  });
  return files;
}

struct Channels {
  std::set<std::uint16_t> scan;
  std::set<std::uint16_t> odometry;
  std::set<std::uint16_t> transforms;
};

/// The name of the wanted topic of a type, among those that the bag has.
Result<std::string> choose(const std::set<std::string>& there, const std::string& wanted,
                           std::string_view type, const std::string& path) {
  std::string listed;
  for (const std::string& name : there) listed += (listed.empty() ? "" : ", ") + name;
  if (wanted.empty() && there.size() == 1) return *there.begin();
  if (there.count(wanted) > 0) return wanted;
  if (there.empty()) return Error{fmt::format("has no topic of {}", type), path};
  return Error{wanted.empty()
                   ? fmt::format("has several topics of {}: {}; name one", type, listed)
                   : fmt::format("has no topic '{}' of {}; it has {}", wanted, type, listed),
               path};
}

Result<Channels> channels_of(const mcap::McapReader& reader, const BagTopics& topics,
                             const std::string& path) {
  const auto type_of = [&](const mcap::Channel& channel) -> std::string {
    const auto schema = reader.schemas().find(channel.schema_id);
    return schema == reader.schemas().end() || channel.message_encoding != "cdr"
               ? ""
               : schema->second.name;
  };
  std::set<std::string> scans;
  std::set<std::string> odometries;
  for (const auto& [id, channel] : reader.channels()) {
    const std::string type = type_of(channel);
    if (type == ros2::kTypeName<ros2::LaserScan>) scans.insert(channel.topic);
    if (type == ros2::kTypeName<ros2::Odometry>) odometries.insert(channel.topic);
  }
  const auto scan = choose(scans, topics.scan, ros2::kTypeName<ros2::LaserScan>, path);
  if (!scan.ok()) return scan.error();
  const auto odometry = choose(odometries, topics.odometry, ros2::kTypeName<ros2::Odometry>, path);
  if (!odometry.ok()) return odometry.error();
  Channels channels;
  for (const auto& [id, channel] : reader.channels()) {
    const std::string type = type_of(channel);
    if (channel.topic == *scan && scans.count(channel.topic) > 0) channels.scan.insert(id);
    if (channel.topic == *odometry) channels.odometry.insert(id);
    if (channel.topic == "/tf_static" && type == ros2::kTypeName<ros2::TFMessage>) {
      channels.transforms.insert(id);
    }
  }
  return channels;
}

class BagReader {
 public:
  explicit BagReader(RobotBag& bag) : bag_(bag) {}

  Result<void> read(const std::string& path, const BagTopics& topics) {
    const auto reader = mcap::McapReader::open(path);
    if (!reader.ok()) return reader.error();
    const auto channels = channels_of(*reader, topics, path);
    if (!channels.ok()) return channels.error();
    auto messages = reader->messages(mcap::Order::kLogTime);
    while (true) {
      const auto message = messages.next();
      if (!message.ok()) return message.error();
      if (!*message) return {};
      const auto taken = take(**message, *channels);
      if (!taken.ok()) return Error{taken.error().message, path};
    }
  }

  /// Where the scans' frame lies in that of the robot, over one transform.
  void place_laser() {
    if (bag_.scans.empty() || bag_.odometry.empty()) return;
    const std::string laser = bag_.scans.front().header.frame_id;
    const std::string robot = bag_.odometry.front().child_frame_id;
    bag_.laser_is_known = laser == robot;
    for (const ros2::TransformStamped& transform : transforms_) {
      if (transform.header.frame_id != robot || transform.child_frame_id != laser) continue;
      bag_.pose_robot_laser = {transform.transform.translation.x, transform.transform.translation.y,
                               ros2::to_heading_rad(transform.transform.rotation)};
      bag_.laser_is_known = true;
    }
  }

 private:
  Result<void> take(const mcap::Message& message, const Channels& channels) {
    if (channels.scan.count(message.channel_id) > 0) {
      return ros2::decode(message.data, bag_.scans.emplace_back());
    }
    if (channels.odometry.count(message.channel_id) > 0) {
      return ros2::decode(message.data, bag_.odometry.emplace_back());
    }
    if (channels.transforms.count(message.channel_id) == 0) return {};
    ros2::TFMessage transforms;
    CLEW_RETURN_IF_ERROR(ros2::decode(message.data, transforms));
    transforms_.insert(transforms_.end(), transforms.transforms.begin(),
                       transforms.transforms.end());
    return {};
  }

  RobotBag& bag_;
  std::vector<ros2::TransformStamped> transforms_;
};

template <typename Message>
void sort_by_stamp(std::vector<Message>& messages) {
  std::stable_sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
    return std::make_pair(a.header.stamp.sec, a.header.stamp.nanosec) <
           std::make_pair(b.header.stamp.sec, b.header.stamp.nanosec);
  });
}

}  // namespace

Result<RobotBag> read_bag(const std::string& path, const BagTopics& topics) {
  const auto files = files_of(path);
  if (!files.ok()) return files.error();
  RobotBag bag;
  BagReader reader(bag);
  for (const std::string& file : *files) CLEW_RETURN_IF_ERROR(reader.read(file, topics));
  if (bag.scans.empty() || bag.odometry.empty()) {
    return Error{
        fmt::format("has {} scans and {} odometries", bag.scans.size(), bag.odometry.size()), path};
  }
  sort_by_stamp(bag.scans);
  sort_by_stamp(bag.odometry);
  reader.place_laser();
  return bag;
}

}  // namespace clew::bag_import
