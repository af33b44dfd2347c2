// SPDX-License-Identifier: Apache-2.0
/// The simulated robot as a node on Fast DDS: plain Fast DDS, nothing of Clew, the participant
/// configured as rmw_fastrtps does with ROS_LOCALHOST_ONLY=1 (Humble). Types are bytes to it, which
/// it writes and reads itself. It takes geometry_msgs/TwistStamped, and drops commands that look
/// older than half a second by its own clock, as the controllers of ros2_control do.
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <string>
#include <vector>

#include "simulated_robot.h"

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<unsigned char>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kOldCommand_s = 0.5;

/// XCDR1, little-endian, with its header.
class Cdr {
 public:
  Cdr() : bytes_{0, 1, 0, 0} {}

  template <typename Number>
  Cdr& add(Number value) {
    while ((bytes_.size() - 4) % sizeof value != 0) bytes_.push_back(0);
    const auto* begin = reinterpret_cast<const unsigned char*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof value);
    return *this;
  }
  Cdr& add(const char* text) {
    const std::size_t size = std::strlen(text) + 1;
    add(static_cast<std::uint32_t>(size));
    bytes_.insert(bytes_.end(), text, text + size);
    return *this;
  }
  Cdr& header(const robot_message& message, const char* frame) {
    return add(message.sec).add(message.nanosec).add(frame);
  }
  Cdr& zeros(int count) {
    for (int i = 0; i < count; ++i) add(0.0);
    return *this;
  }
  Bytes& bytes() { return bytes_; }

 private:
  Bytes bytes_;
};

/// A type that is a name.
class RawType : public TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 8192;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* bytes) override {
    static_cast<Bytes*>(bytes)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* bytes) override { delete static_cast<Bytes*>(bytes); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

class Node {
 public:
  Node(int domain, const std::string& name_space) {
    auto* factory = DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(static_cast<DomainId_t>(domain), localhost_only());
    const std::string prefix = "rt/" + name_space + (name_space.empty() ? "" : "/");
    scan_ = writer(prefix + "scan", "sensor_msgs::msg::dds_::LaserScan_", false, false);
    odometry_ = writer(prefix + "odom", "nav_msgs::msg::dds_::Odometry_", true, false);
    mount_ = writer("rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", true, true);
    DataReaderQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 10;
    command_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT)
                   ->create_datareader(
                       topic(prefix + "cmd_vel", "geometry_msgs::msg::dds_::TwistStamped_"), qos);
  }
  ~Node() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  void publish_scan(const robot_message& message) {
    Cdr cdr;
    cdr.header(message, message.laser_frame);
    cdr.add(static_cast<float>(-kPi)).add(static_cast<float>(kPi - 2.0 * kPi / kBeams));
    cdr.add(static_cast<float>(2.0 * kPi / kBeams)).add(0.0F).add(0.05F).add(0.01F);
    cdr.add(static_cast<float>(RANGE_MAX_M)).add(std::uint32_t{kBeams});
    for (const float range : message.ranges) cdr.add(range);
    cdr.add(std::uint32_t{0});
    scan_->write(&cdr.bytes());
  }
  void publish_odometry(const robot_message& message) {
    clock_ = message.sec + 1e-9 * message.nanosec;
    Cdr cdr;
    cdr.header(message, message.odom_frame).add(message.base_frame);
    cdr.add(message.x).add(message.y).zeros(3);
    cdr.add(std::sin(message.heading / 2.0)).add(std::cos(message.heading / 2.0)).zeros(36);
    cdr.add(message.v).zeros(4).add(message.w).zeros(36);
    odometry_->write(&cdr.bytes());
  }
  void publish_mount(const robot_message& message) {
    Cdr cdr;
    cdr.add(std::uint32_t{1}).header(message, message.base_frame).add(message.laser_frame);
    cdr.add(LASER_AHEAD_M).zeros(5).add(1.0);
    mount_->write(&cdr.bytes());
  }
  bool take_command(double* v, double* w) {
    Bytes bytes;
    SampleInfo info;
    while (command_->take_next_sample(&bytes, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data && read_command(bytes, v, w)) return true;
    }
    return false;
  }

 private:
  static DomainParticipantQos localhost_only() {
    DomainParticipantQos qos;
    qos.name("/");
    const std::string enclave = "enclave=/;";
    qos.user_data().data_vec({enclave.begin(), enclave.end()});
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(
        std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>());
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().user_transports.push_back(udp);
    return qos;
  }

  Topic* topic(const std::string& name, const std::string& type) {
    participant_->register_type(TypeSupport(new RawType(type)));
    return participant_->create_topic(name, type, TOPIC_QOS_DEFAULT);
  }
  DataWriter* writer(const std::string& name, const std::string& type, bool reliable,
                     bool transient_local) {
    DataWriterQos qos;
    qos.reliability().kind = reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind =
        transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().depth = 5;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return participant_->create_publisher(PUBLISHER_QOS_DEFAULT)
        ->create_datawriter(topic(name, type), qos);
  }
  /// Header, then six doubles.
  bool read_command(const Bytes& bytes, double* v, double* w) const {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
    std::uint32_t frame_size = 0;
    if (bytes.size() < 16) return false;
    std::memcpy(&sec, &bytes[4], 4);
    std::memcpy(&nanosec, &bytes[8], 4);
    std::memcpy(&frame_size, &bytes[12], 4);
    const std::size_t twist = 4 + (12 + frame_size + 7) / 8 * 8;
    if (bytes.size() < twist + 48) return false;
    if (std::fabs(sec + 1e-9 * nanosec - clock_) > kOldCommand_s) {
      std::fprintf(stderr, "fastdds_robot: a command that looks old is dropped\n");
      return false;
    }
    std::memcpy(v, &bytes[twist], 8);
    std::memcpy(w, &bytes[twist + 40], 8);
    return true;
  }

  DomainParticipant* participant_ = nullptr;
  DataWriter* scan_ = nullptr;
  DataWriter* odometry_ = nullptr;
  DataWriter* mount_ = nullptr;
  DataReader* command_ = nullptr;
  double clock_ = 0.0;
};

Node& node_of(void* self) { return *static_cast<Node*>(self); }

}  // namespace

int main(int argc, char** argv) {
  int domain = 0;
  const char* name_space = nullptr;
  const int wrong = robot_arguments(argc, argv, &domain, &name_space);
  if (wrong != 0) return wrong;
  Log::SetVerbosity(Log::Kind::Error);
  Node node(domain, name_space);
  const robot_wire wire = {
      &node, [](void* self, const robot_message* message) { node_of(self).publish_scan(*message); },
      [](void* self, const robot_message* message) { node_of(self).publish_odometry(*message); },
      [](void* self, const robot_message* message) { node_of(self).publish_mount(*message); },
      [](void* self, double* v, double* w) { return node_of(self).take_command(v, w) ? 1 : 0; }};
  return robot_main(argc, argv, &wire);
}
