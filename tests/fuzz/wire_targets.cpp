// SPDX-License-Identifier: Apache-2.0
/// What comes over DDS: samples of each topic, samples of ROS 2, and what endpoints say of
/// themselves.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "component/start_barrier.hpp"
#include "dds/origin.hpp"
#include "line/run_key.hpp"
#include "line/user_data.hpp"
#include "random_messages.hpp"
#include "ros2/message_codec.hpp"
#include "target.hpp"
#include "wire/codec.hpp"

namespace clew::fuzz {
namespace {

using namespace bridge;

template <typename Message>
void read_sample_of(std::string_view cdr) {
  Codec<Message> codec;
  Message message;
  const bool holds_values = codec.decode_unvalidated(cdr, message).ok();
  if (!is_good(codec.decode(cdr, message))) return;
  CLEW_CHECK(holds_values, "only the valid message can be read");
  const std::string canonical(codec.encode(message));  // aborts if the message is not valid
  Message again;
  CLEW_CHECK(codec.decode(canonical, again).ok(), "our own bytes are refused");
  CLEW_CHECK(codec.encode(again) == canonical, "the same message has other bytes");
}

/// Behind one byte that chooses the topic.
void read_sample(std::string_view input) {
  if (input.empty()) return;
  const auto topic = static_cast<unsigned char>(input[0]) % domain::kTopicCount;
  domain::visit_topic(static_cast<domain::Topic>(topic), [&](auto constant) {
    read_sample_of<typename decltype(constant)::Message>(input.substr(1));
  });
}

Seeds samples() {
  RandomMessages random(1);
  Seeds seeds;
  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      typename decltype(constant)::Message message;
      random.fill(message);
      std::vector<char> buffer;
      seeds.push_back(std::string(1, static_cast<char>(constant.kIndex)));
      seeds.back() += encode(&message, buffer);
    });
  }
  return seeds;
}

/// All that the bridge and its robots read of others, and what holds every kind of field.
using RosMessages =
    std::tuple<ros2::LaserScan, ros2::Odometry, ros2::TFMessage, ros2::PoseStamped, ros2::Path,
               ros2::TwistStamped, ros2::OccupancyGrid, ros2::DiagnosticArray, ros2::MarkerArray,
               ros2::ParticipantEntitiesInfo<16>, ros2::ParticipantEntitiesInfo<24>>;

template <typename Visit, std::size_t... kIndex>
void visit_ros_message(std::size_t chosen, const Visit& visit, std::index_sequence<kIndex...>) {
  (void)((kIndex == chosen && (visit(std::tuple_element_t<kIndex, RosMessages>{}), true)) || ...);
}
constexpr auto kEveryRosMessage = std::make_index_sequence<std::tuple_size_v<RosMessages>>();

/// Behind one byte that chooses the type. What is read is what its own bytes say.
void read_ros_sample(std::string_view input) {
  if (input.empty()) return;
  const auto type = static_cast<unsigned char>(input[0]) % std::tuple_size_v<RosMessages>;
  const auto read = [&](auto message) {
    if (!is_good(ros2::decode(input.substr(1), message))) return;
    std::vector<char> buffer;
    const std::string canonical(ros2::encode(message, buffer));
    CLEW_CHECK(ros2::decode(canonical, message).ok(), "our own bytes are refused");
    std::vector<char> other;
    CLEW_CHECK(ros2::encode(message, other) == canonical, "the same message has other bytes");
  };
  visit_ros_message(type, read, kEveryRosMessage);
}

ros2::PoseStamped a_pose() {
  ros2::PoseStamped pose;
  pose.header.stamp.sec = 7;
  pose.header.frame_id = "map";
  pose.pose.position.x = 1.5;
  pose.pose.orientation.w = 1.0;
  return pose;
}

void fill(ros2::LaserScan& scan) {
  scan.header.frame_id = "laser";
  scan.ranges = {1.0F, 2.0F, NAN, INFINITY};
}
void fill(ros2::Odometry& odometry) { odometry.child_frame_id = "base_link"; }
void fill(ros2::TFMessage& tree) {
  tree.transforms.resize(2);
  tree.transforms[1].child_frame_id = "odom";
}
void fill(ros2::PoseStamped& pose) { pose = a_pose(); }
void fill(ros2::Path& path) { path.poses = {a_pose(), a_pose()}; }
void fill(ros2::OccupancyGrid& grid) {
  grid.info.width = grid.info.height = 2;
  grid.data = {0, 100, -1, 50};
}
void fill(ros2::DiagnosticArray& array) {
  array.status.resize(1);
  array.status[0].values.resize(2);
}
void fill(ros2::MarkerArray& array) { array.markers.resize(2); }
template <typename Other>
void fill(Other&) {}

Seeds ros_samples() {
  Seeds seeds;
  for (std::size_t type = 0; type < std::tuple_size_v<RosMessages>; ++type) {
    const auto write = [&](auto message) {
      fill(message);
      std::vector<char> buffer;
      seeds.push_back(std::string(1, static_cast<char>(type)));
      seeds.back() += ros2::encode(message, buffer);
    };
    visit_ros_message(type, write, kEveryRosMessage);
  }
  return seeds;
}

const std::string kGuid = "0123456789abcdef01234567000001c1";
const std::string kOwnGuid = "fedcba98765432100123456700000103";

/// Whatever an endpoint of somebody else's says, it is not taken for one of the run's own: what is
/// sealed holds for another participant.
void read_identity(std::string_view text) {
  const UserData data = UserData::parse(text);
  const UserData again = UserData::parse(data.to_text());
  CLEW_CHECK(again.stage == data.stage && again.seal == data.seal &&
                 again.idl_fingerprint == data.idl_fingerprint,
             "what an endpoint says is read otherwise the second time");
  const Origin origin = Origin::parse(text);
  static_cast<void>(origin.may_take(text));
  static_cast<void>(without_origin(text, {"clew_stage"}));

  std::size_t refusals = 0;
  StartBarrier barrier(
      "drive", {{"command", true, "control", false}},
      {[] {}, [&](const std::string&) { ++refusals; }, [&](const std::string&) { ++refusals; }});
  barrier.demand_seals(RunKey("the secret of the run"));
  const RemoteEndpoint stranger{true, "command", "", std::string(text), kGuid, 0, true, true};
  barrier.on_matched(stranger);
  CLEW_CHECK(!barrier.accepts(&stranger), "a stranger is taken for a stage of the run");
  CLEW_CHECK(refusals == 1, "a stranger is not told of once");
  CLEW_CHECK(barrier.missing().size() == 1, "a stranger takes the place of a stage");
}

Seeds identities() {
  const RunKey key("the secret of the run");
  const UserData control{std::string(idl_fingerprint()), "control"};
  return {control.to_text(), key.sealed(control, kOwnGuid).to_text(),
          UserData{"00000000000000000000000000000000", ""}.to_text(),
          control.to_text() + Origin{"4711-3", 2, {"5f2a-20", "5f2a-21"}}.to_text(),
          "enclave=/;clew_stage=control;clew_stage=sense;clew_seal=;;=;clew_idl"};
}

}  // namespace

std::vector<Target> wire_targets() {
  return {{"sample", read_sample, samples},
          {"ros_sample", read_ros_sample, ros_samples},
          {"identity", read_identity, identities}};
}

}  // namespace clew::fuzz
