// SPDX-License-Identifier: Apache-2.0
#include "fastdds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <mutex>

#include "dds/participant.hpp"
#include "fastdds/endpoint.hpp"
#include "fastdds/qos.hpp"
#include "fastdds/raw_type.hpp"

namespace clew::bridge {
namespace {

using namespace eprosima::fastdds::dds;  // NOLINT(google-build-using-namespace): a dozen names
using eprosima::fastrtps::rtps::iHandle2GUID;
using eprosima::fastrtps::types::ReturnCode_t;

core::Error fast_error(const std::string& what) { return {"Fast DDS: " + what + " failed", {}}; }

class FastWriter : public SampleWriter, private DataWriterListener {
 public:
  FastWriter(FastDiscovery& discovery, const EndpointSpec& spec)
      : endpoint_(discovery, spec, true) {}
  ~FastWriter() override {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    const std::chrono::duration<long double> linger = kLinger;
    writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(linger.count()));
    publisher_->delete_datawriter(writer_);
  }

  core::Result<void> open(Publisher* publisher, Topic* topic) {
    publisher_ = publisher;
    writer_ = publisher->create_datawriter(topic, fastdds_writer_qos(endpoint_.spec()), this);
    if (writer_ == nullptr) return fast_error("creating a writer of " + endpoint_.spec().topic);
    return {};
  }

  WriteStatus write(std::string_view cdr) override {
    const ReturnCode_t code =
        writer_->write(&cdr, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown);
    if (code == ReturnCode_t::RETCODE_OK) return WriteStatus::kTaken;
    return code == ReturnCode_t::RETCODE_TIMEOUT ? WriteStatus::kWouldBlock : WriteStatus::kFailed;
  }

  bool acknowledged() const override {
    return writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(0, 0)) ==
           ReturnCode_t::RETCODE_OK;
  }
  std::string guid() const override { return fastdds_guid(writer_->guid()); }

 private:
  void on_publication_matched(DataWriter*, const PublicationMatchedStatus& status) override {
    endpoint_.on_match(iHandle2GUID(status.last_subscription_handle), status.current_count_change);
  }
  void on_offered_incompatible_qos(DataWriter*,
                                   const OfferedIncompatibleQosStatus& status) override {
    endpoint_.on_incompatible_qos(status.last_policy_id);
  }

  FastEndpoint endpoint_;
  Publisher* publisher_ = nullptr;
  DataWriter* writer_ = nullptr;
};

class FastReader : public SampleReader, private DataReaderListener {
 public:
  FastReader(FastDiscovery& discovery, const EndpointSpec& spec, SampleListener& listener)
      : listener_(listener), endpoint_(discovery, spec, false) {}
  ~FastReader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    subscriber_->delete_datareader(reader_);
  }

  core::Result<void> open(Subscriber* subscriber, Topic* topic) {
    subscriber_ = subscriber;
    reader_ = subscriber->create_datareader(topic, fastdds_reader_qos(endpoint_.spec()), this);
    if (reader_ == nullptr) return fast_error("creating a reader of " + endpoint_.spec().topic);
    return {};
  }
  std::string guid() const override { return fastdds_guid(reader_->guid()); }

 private:
  void on_data_available(DataReader* reader) override {
    const std::lock_guard lock(mutex_);
    SampleInfo info;
    while (reader->take_next_sample(&bytes_, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      const auto writer = endpoint_.find(info.sample_identity.writer_guid());
      listener_.on_sample(bytes_, writer.get());
    }
  }
  void on_subscription_matched(DataReader*, const SubscriptionMatchedStatus& status) override {
    endpoint_.on_match(iHandle2GUID(status.last_publication_handle), status.current_count_change);
  }
  void on_requested_incompatible_qos(DataReader*,
                                     const RequestedIncompatibleQosStatus& status) override {
    endpoint_.on_incompatible_qos(status.last_policy_id);
  }

  SampleListener& listener_;
  FastEndpoint endpoint_;
  std::mutex mutex_;
  std::string bytes_;
  Subscriber* subscriber_ = nullptr;
  DataReader* reader_ = nullptr;
};

class FastParticipant : public Participant {
 public:
  explicit FastParticipant(DiscoveryListener& listener) : discovery_(listener) {}
  ~FastParticipant() override {
    if (participant_ == nullptr) return;
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  core::Result<void> open(const ParticipantConfig& config) {
    prepare_fastdds_process();
    // The listener is for discovery only; endpoints have their own.
    participant_ = DomainParticipantFactory::get_instance()->create_participant(
        static_cast<DomainId_t>(config.domain), fastdds_participant_qos(config), &discovery_,
        StatusMask::none());
    if (participant_ == nullptr) {
      return fast_error("creating participant " + config.name + " in domain " +
                        std::to_string(config.domain));
    }
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    if (publisher_ == nullptr || subscriber_ == nullptr) return fast_error("creating a publisher");
    return {};
  }

  std::string guid() const override { return fastdds_guid(participant_->guid()); }

  core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) override {
    const core::Result<Topic*> topic = find_topic(spec);
    if (!topic.ok()) return topic.error();
    auto writer = std::make_unique<FastWriter>(discovery_, spec);
    CLEW_RETURN_IF_ERROR(writer->open(publisher_, *topic));
    return std::unique_ptr<SampleWriter>(std::move(writer));
  }

  core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                            SampleListener& listener) override {
    const core::Result<Topic*> topic = find_topic(spec);
    if (!topic.ok()) return topic.error();
    auto reader = std::make_unique<FastReader>(discovery_, spec, listener);
    CLEW_RETURN_IF_ERROR(reader->open(subscriber_, *topic));
    return std::unique_ptr<SampleReader>(std::move(reader));
  }

 private:
  /// A participant has one topic of a name, which lasts as long as the participant.
  core::Result<Topic*> find_topic(const EndpointSpec& spec) {
    const std::lock_guard lock(mutex_);
    const auto found = topics_.find(spec.topic);
    if (found != topics_.end()) {
      if (found->second->get_type_name() == spec.type) return found->second;
      return fast_error("giving topic " + spec.topic + " a second type, " + spec.type + ",");
    }
    if (participant_->find_type(spec.type).empty() &&
        participant_->register_type(TypeSupport(new FastRawType(spec.type))) !=
            ReturnCode_t::RETCODE_OK) {
      return fast_error("registering type " + spec.type);
    }
    Topic* topic = participant_->create_topic(spec.topic, spec.type, TOPIC_QOS_DEFAULT);
    if (topic == nullptr) return fast_error("creating topic " + spec.topic);
    topics_[spec.topic] = topic;
    return topic;
  }

  FastDiscovery discovery_;
  std::mutex mutex_;
  std::map<std::string, Topic*> topics_;
  DomainParticipant* participant_ = nullptr;
  Publisher* publisher_ = nullptr;
  Subscriber* subscriber_ = nullptr;
};

}  // namespace

core::Result<std::unique_ptr<Participant>> create_fastdds_participant(
    const ParticipantConfig& config, DiscoveryListener& discovery) {
  auto participant = std::make_unique<FastParticipant>(discovery);
  CLEW_RETURN_IF_ERROR(participant->open(config));
  return std::unique_ptr<Participant>(std::move(participant));
}

}  // namespace clew::bridge
