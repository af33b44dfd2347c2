// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/participant.hpp"

#include <array>
#include <atomic>

#include "cyclonedds/configuration.hpp"
#include "cyclonedds/endpoint.hpp"
#include "cyclonedds/loopback_sockets.hpp"
#include "cyclonedds/refusal_log.hpp"

namespace clew::bridge {
namespace {

class CycloneWriter : public SampleWriter {
 public:
  CycloneWriter(CycloneDiscovery& discovery, const EndpointSpec& spec)
      : endpoint_(discovery, spec, true) {}

  core::Result<void> open(dds_entity_t participant) {
    CLEW_RETURN_IF_ERROR(endpoint_.create_topic(participant));
    const CycloneQos qos = endpoint_.qos();
    dds_listener_t* listener = dds_create_listener(this);
    core::Result<void> result = endpoint_.attach(
        dds_create_writer(participant, endpoint_.topic(), qos.get(), nullptr), listener);
    dds_delete_listener(listener);
    return result;
  }

  WriteStatus write(std::string_view cdr) override {
    const dds_return_t code =
        dds_writecdr(endpoint_.handle(), make_raw_sample(endpoint_.type(), cdr));
    if (code == DDS_RETCODE_OK) return WriteStatus::kTaken;
    return code == DDS_RETCODE_TIMEOUT ? WriteStatus::kWouldBlock : WriteStatus::kFailed;
  }

  bool acknowledged() const override {
    return dds_wait_for_acks(endpoint_.handle(), 0) == DDS_RETCODE_OK;
  }
  std::string guid() const override { return cyclone_guid(endpoint_.handle()); }

 private:
  CycloneEndpoint endpoint_;
};

class CycloneReader : public SampleReader {
 public:
  CycloneReader(CycloneDiscovery& discovery, const EndpointSpec& spec, SampleListener& listener)
      : listener_(listener), endpoint_(discovery, spec, false) {}
  ~CycloneReader() override { endpoint_.detach(); }
  std::string guid() const override { return cyclone_guid(endpoint_.handle()); }

  core::Result<void> open(dds_entity_t participant) {
    CLEW_RETURN_IF_ERROR(endpoint_.create_topic(participant));
    const CycloneQos qos = endpoint_.qos();
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, on_data_available);
    core::Result<void> result = endpoint_.attach(
        dds_create_reader(participant, endpoint_.topic(), qos.get(), nullptr), listener);
    dds_delete_listener(listener);
    // Samples that came before the listener was set make no call.
    if (result.ok()) deliver();
    return result;
  }

 private:
  static void on_data_available(dds_entity_t, void* self) {
    static_cast<CycloneReader*>(self)->deliver();
  }

  void deliver() {
    const std::lock_guard lock(mutex_);
    std::array<ddsi_serdata*, 8> samples{};
    std::array<dds_sample_info_t, 8> infos{};
    dds_return_t count = 0;
    while ((count = dds_takecdr(endpoint_.handle(), samples.data(),
                                static_cast<std::uint32_t>(samples.size()), infos.data(),
                                DDS_ANY_STATE)) > 0) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        // Without valid data it is no sample of ours: not even its type can be trusted.
        if (infos[i].valid_data) {
          const auto writer = endpoint_.find(infos[i].publication_handle);
          listener_.on_sample(raw_bytes(samples[i]), writer.get());
        }
        ddsi_serdata_unref(samples[i]);
      }
    }
  }

  SampleListener& listener_;
  std::mutex mutex_;  ///< the thread that opens the reader may meet the vendor's
  CycloneEndpoint endpoint_;
};

class CycloneParticipant : public Participant {
 public:
  explicit CycloneParticipant(DiscoveryListener& listener) : listener_(listener) {}

  core::Result<void> open(const ParticipantConfig& config) {
    if (config.security) quieten_refusals();
    // A domain of Cyclone's own for each participant, so that two in one process have a network
    // between them like all others; on the wire it is config.domain.
    static std::atomic<dds_domainid_t> next_domain{0};
    const dds_domainid_t domain = next_domain++;
    const dds_entity_t domain_handle =
        dds_create_domain(domain, cyclonedds_configuration(config).c_str());
    if (domain_handle < 0) return cyclone_error("opening domain", domain_handle);
    domain_ = CycloneEntity(domain_handle);
    const CycloneQos qos = make_cyclone_qos();
    dds_qset_entity_name(qos.get(), config.name.c_str());
    dds_qset_userdata(qos.get(), config.user_data.data(), config.user_data.size());
    const dds_entity_t handle = dds_create_participant(domain, qos.get(), nullptr);
    if (handle < 0) return cyclone_error("creating participant " + config.name, handle);
    participant_ = CycloneEntity(handle);
    if (!config.on_network && !config.hosts) confine_to_loopback(config.domain);
    discovery_ = std::make_unique<CycloneDiscovery>(handle, listener_);
    return discovery_->start();
  }

  std::string guid() const override { return cyclone_guid(participant_.handle()); }

  core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) override {
    auto writer = std::make_unique<CycloneWriter>(*discovery_, spec);
    CLEW_RETURN_IF_ERROR(writer->open(participant_.handle()));
    return std::unique_ptr<SampleWriter>(std::move(writer));
  }

  core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                            SampleListener& listener) override {
    auto reader = std::make_unique<CycloneReader>(*discovery_, spec, listener);
    CLEW_RETURN_IF_ERROR(reader->open(participant_.handle()));
    return std::unique_ptr<SampleReader>(std::move(reader));
  }

 private:
  DiscoveryListener& listener_;
  CycloneEntity domain_;
  CycloneEntity participant_;
  std::unique_ptr<CycloneDiscovery> discovery_;
};

}  // namespace

core::Result<std::unique_ptr<Participant>> create_cyclonedds_participant(
    const ParticipantConfig& config, DiscoveryListener& discovery) {
  auto participant = std::make_unique<CycloneParticipant>(discovery);
  CLEW_RETURN_IF_ERROR(participant->open(config));
  return std::unique_ptr<Participant>(std::move(participant));
}

}  // namespace clew::bridge
