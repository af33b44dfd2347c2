// SPDX-License-Identifier: Apache-2.0
/// As cyclone_listener.c, but a node on Fast DDS: plain Fast DDS, nothing of Clew. The participant
/// is configured as rmw_fastrtps does with ROS_LOCALHOST_ONLY=1 (Humble). Types are bytes to it.
///     fastdds_listener DOMAIN
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <poll.h>

#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<unsigned char>;

/// A type that is a name.
class RawType : public TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 512;
    m_isGetKeyDefined = false;
  }
  bool serialize(void*, SerializedPayload_t*) override { return false; }
  bool deserialize(SerializedPayload_t* payload, void* bytes) override {
    static_cast<Bytes*>(bytes)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 0U; };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* bytes) override { delete static_cast<Bytes*>(bytes); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

struct TopicToRead {
  const char* name;
  const char* type;
  bool reliable;
  bool transient_local;
};

// As ros2 topic echo, RViz, tf2 and rmw_dds_common subscribe.
constexpr TopicToRead kTopics[] = {
    {"rt/clock", "rosgraph_msgs::msg::dds_::Clock_", false, false},
    {"rt/r1/scan", "sensor_msgs::msg::dds_::LaserScan_", false, false},
    {"rt/r1/odom", "nav_msgs::msg::dds_::Odometry_", true, false},
    {"rt/tf", "tf2_msgs::msg::dds_::TFMessage_", true, false},
    {"rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", true, true},
    {"rt/r1/chart", "nav_msgs::msg::dds_::OccupancyGrid_", true, true},
    {"rt/r1/map_seen", "nav_msgs::msg::dds_::OccupancyGrid_", true, true},
    {"rt/r1/plan", "nav_msgs::msg::dds_::Path_", true, false},
    {"rt/r1/goal_pose", "geometry_msgs::msg::dds_::PoseStamped_", true, true},
    {"rt/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_", true, false},
    {"rt/rosout", "rcl_interfaces::msg::dds_::Log_", true, true},
    {"rt/r1/markers", "visualization_msgs::msg::dds_::MarkerArray_", true, true},
    {"ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", true, true}};

std::mutex output;

template <typename Range>
void print_hexadecimal(const Range& bytes) {
  for (const auto byte : bytes) std::printf("%02x", static_cast<unsigned>(byte));
}

class Discovery : public DomainParticipantListener {
  void on_publisher_discovery(DomainParticipant*,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override {
    if (found.status != eprosima::fastrtps::rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
    const auto& writer = found.info;
    const auto& data = writer.m_qos.m_userData.data_vec();
    const std::lock_guard<std::mutex> lock(output);
    std::printf("endpoint %s %s ", writer.topicName().c_str(), writer.typeName().c_str());
    print_hexadecimal(writer.guid().guidPrefix.value);
    print_hexadecimal(writer.guid().entityId.value);
    std::printf(
        " %s %s %s\n",
        writer.m_qos.m_reliability.kind == RELIABLE_RELIABILITY_QOS ? "reliable" : "best_effort",
        writer.m_qos.m_durability.kind == TRANSIENT_LOCAL_DURABILITY_QOS ? "transient_local"
                                                                         : "volatile",
        std::string(data.begin(), data.end()).c_str());
  }
};

DomainParticipantQos localhost_only() {
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

DataReaderQos reader_qos(const TopicToRead& topic) {
  DataReaderQos qos;
  qos.reliability().kind = topic.reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      topic.transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.history().kind = KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1000;
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

void print_samples(DataReader& reader, const char* topic) {
  Bytes bytes;
  SampleInfo info;
  while (reader.take_next_sample(&bytes, &info) ==
         eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;
    const std::lock_guard<std::mutex> lock(output);
    std::printf("sample %s ", topic);
    print_hexadecimal(bytes);
    std::printf("\n");
  }
}

int listen(DomainParticipant& participant) {
  Subscriber* subscriber = participant.create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  std::vector<DataReader*> readers;
  for (const TopicToRead& topic : kTopics) {
    if (participant.find_type(topic.type).empty()) {
      participant.register_type(TypeSupport(new RawType(topic.type)));
    }
    Topic* handle = participant.create_topic(topic.name, topic.type, TOPIC_QOS_DEFAULT);
    readers.push_back(subscriber->create_datareader(handle, reader_qos(topic)));
    if (readers.back() == nullptr) return 1;
  }
  std::printf("ready\n");
  pollfd input{0, POLLIN, 0};
  while (::poll(&input, 1, 5) == 0) {
    for (std::size_t i = 0; i < readers.size(); ++i) print_samples(*readers[i], kTopics[i].name);
    const std::lock_guard<std::mutex> lock(output);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fastdds_listener DOMAIN\n");
    return 2;
  }
  Log::SetVerbosity(Log::Kind::Error);
  auto* factory = DomainParticipantFactory::get_instance();
  Discovery discovery;
  DomainParticipant* participant =
      factory->create_participant(static_cast<DomainId_t>(std::atoi(argv[1])), localhost_only(),
                                  &discovery, StatusMask::none());
  if (participant == nullptr) return 1;
  const int status = listen(*participant);
  participant->delete_contained_entities();
  factory->delete_participant(participant);
  return status;
}
