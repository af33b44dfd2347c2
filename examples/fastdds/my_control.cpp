// SPDX-License-Identifier: Apache-2.0
//
// A control component that knows nothing of Clew but its IDL: plain C++, Fast DDS, code generated
// by fastddsgen. It takes the place of `control` in a graph with recover:
//
//     control: {exec: [./my_control]}
//
// For every tick it reads one odometry, one scan and one guidance, and writes one command with the
// same stamp: turn toward the target, step as far as the cones show free. A motion that recover
// asks for goes before its own. What the run sets in FASTRTPS_DEFAULT_PROFILES_FILE is the default
// of every entity, so that nothing but the fingerprint has to be said here.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <string>

#include "CommandPubSubTypes.h"
#include "GuidancePubSubTypes.h"
#include "OdometryPubSubTypes.h"
#include "ScanPubSubTypes.h"
#include "clew/idl_fingerprint.h"

namespace fast = eprosima::fastdds::dds;
namespace msg = clew::msg;

namespace {

constexpr double kStep_m = 0.1;
constexpr double kMaxTurn_rad = 0.16;
constexpr double kMargin_m = 0.02;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "my_control: %s\n", what.c_str());
  std::exit(1);
}

template <typename Qos>
void carry_fingerprint(Qos& qos) {
  const std::string text = CLEW_IDL_USER_DATA;
  qos.user_data().setValue({text.begin(), text.end()});
}

fast::Topic* create_topic(fast::DomainParticipant& participant, const fast::TypeSupport& type,
                          const std::string& name) {
  type.register_type(&participant);
  fast::Topic* topic =
      participant.create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) fail("cannot create the topic " + name);
  return topic;
}

/// A topic's reader and its newest sample.
template <typename Message>
class Input {
 public:
  Input(fast::DomainParticipant& participant, fast::Subscriber& subscriber,
        const fast::TypeSupport& type, const std::string& name) {
    fast::DataReaderQos qos = subscriber.get_default_datareader_qos();
    carry_fingerprint(qos);
    reader_ = subscriber.create_datareader(create_topic(participant, type, name), qos);
    if (reader_ == nullptr) fail("cannot create a reader of " + name);
  }

  const Message& message() const { return message_; }
  std::uint64_t tick() const { return message_.stamp().tick(); }

  /// Waits for the next sample; those of a topic come in order, one a tick.
  void take_next() {
    fast::SampleInfo info;
    while (reader_->take_next_sample(&message_, &info) != ReturnCode_t::RETCODE_OK ||
           !info.valid_data) {
      reader_->wait_for_unread_message({1, 0});
    }
  }
  /// A component that was started anew finds the last samples of each topic, which need not begin
  /// with the same tick: older ones are passed over.
  void take_until(std::uint64_t wanted) {
    while (tick() < wanted) take_next();
  }

 private:
  fast::DataReader* reader_ = nullptr;
  Message message_;
};

msg::TickMotion decide(const msg::Odometry& odometry, const msg::Scan& scan,
                       const msg::Guidance& guidance) {
  if (guidance.has_override()) return guidance.override_motion();
  const msg::Pose2& pose = odometry.pose_odom_robot();
  const double bearing_rad =
      std::atan2(guidance.target_y_m() - pose.y_m(), guidance.target_x_m() - pose.x_m());
  const double turn_rad = std::clamp(std::remainder(bearing_rad - pose.heading_rad(), 2.0 * M_PI),
                                     -kMaxTurn_rad, kMaxTurn_rad);
  double clear_m = scan.range_max_m();
  for (std::size_t i = 0; i < scan.ranges_m().size(); ++i) {
    const double beam_rad =
        scan.bearing_first_rad() + static_cast<double>(i) * scan.bearing_step_rad();
    if (std::fabs(beam_rad - turn_rad) > scan.beam_width_rad() * 1.5) continue;
    clear_m = std::min(clear_m, scan.ranges_m()[i]);
  }
  msg::TickMotion motion;
  motion.kind(msg::COMMAND_TURN_AND_STEP);
  motion.turn_rad(turn_rad);
  motion.step_m(std::clamp(clear_m - kMargin_m, 0.0, kStep_m));
  return motion;
}

}  // namespace

int main() {
  const char* domain = std::getenv("CLEW_DOMAIN_ID");
  if (domain == nullptr) fail("CLEW_DOMAIN_ID is not set; 'clew run' sets it");
  fast::DomainParticipant* participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<fast::DomainId_t>(std::atoi(domain)), fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) fail("cannot create a participant");
  fast::Subscriber* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  fast::Publisher* publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  Input<msg::Odometry> odometry(*participant, *subscriber,
                                fast::TypeSupport(new msg::OdometryPubSubType), "odometry");
  Input<msg::Scan> scan(*participant, *subscriber, fast::TypeSupport(new msg::ScanPubSubType),
                        "scan");
  Input<msg::Guidance> guidance(*participant, *subscriber,
                                fast::TypeSupport(new msg::GuidancePubSubType), "guidance");
  fast::DataWriterQos qos = publisher->get_default_datawriter_qos();
  carry_fingerprint(qos);
  fast::DataWriter* writer = publisher->create_datawriter(
      create_topic(*participant, fast::TypeSupport(new msg::CommandPubSubType), "command"), qos);
  if (writer == nullptr) fail("cannot create the writer of command");
  while (true) {
    odometry.take_next();
    scan.take_next();
    guidance.take_next();
    const std::uint64_t tick = std::max({odometry.tick(), scan.tick(), guidance.tick()});
    odometry.take_until(tick);
    scan.take_until(tick);
    guidance.take_until(tick);
    msg::Command command;
    command.stamp(odometry.message().stamp());
    command.motion(decide(odometry.message(), scan.message(), guidance.message()));
    if (!writer->write(&command)) fail("cannot write command");
  }
}
