// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/discovery.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <set>

#include "dds/remote_endpoints.hpp"
#include "dds/rtps_ports.hpp"

namespace clew::bridge {
namespace {

/// As many as there can be in a domain.
using ParticipantSamples = std::array<void*, kMaxParticipantIndex + 1>;

std::string hex(const dds_guid_t& guid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : guid.v) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string user_data_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

bool is_reliable(const dds_qos_t* qos) {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  return dds_qget_reliability(qos, &kind, nullptr) && kind == DDS_RELIABILITY_RELIABLE;
}

bool is_transient_local(const dds_qos_t* qos) {
  dds_durability_kind_t kind = DDS_DURABILITY_VOLATILE;
  return dds_qget_durability(qos, &kind) && kind != DDS_DURABILITY_VOLATILE;
}

}  // namespace

std::string cyclone_guid(dds_entity_t entity) {
  dds_guid_t guid{};
  dds_get_guid(entity, &guid);
  return hex(guid);
}

CycloneDiscovery::CycloneDiscovery(dds_entity_t participant, DiscoveryListener& listener)
    : participant_(participant), remotes_(listener) {
  dds_get_guid(participant_, &participant_guid_);
}

core::Result<void> CycloneDiscovery::start() {
  const auto create = [&](dds_entity_t topic, dds_on_data_available_fn on_data,
                          CycloneEntity& reader) -> core::Result<void> {
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, on_data);
    const dds_entity_t handle = dds_create_reader(participant_, topic, nullptr, listener);
    dds_delete_listener(listener);
    if (handle < 0) return cyclone_error("creating a reader of what was discovered", handle);
    reader = CycloneEntity(handle);
    return {};
  };
  CLEW_RETURN_IF_ERROR(
      create(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, &on_participants, participants_reader_));
  CLEW_RETURN_IF_ERROR(
      create(DDS_BUILTIN_TOPIC_DCPSPUBLICATION, &on_endpoints<true>, writers_reader_));
  return create(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, &on_endpoints<false>, readers_reader_);
}

std::shared_ptr<const RemoteEndpoint> CycloneDiscovery::describe(
    const dds_builtintopic_endpoint_t& endpoint, bool is_writer) const {
  if (std::memcmp(endpoint.participant_key.v, participant_guid_.v, sizeof participant_guid_.v) ==
      0) {
    return nullptr;
  }
  RemoteEndpoint remote;
  remote.is_writer = is_writer;
  remote.topic = endpoint.topic_name;
  remote.type = endpoint.type_name;
  remote.user_data = user_data_of(endpoint.qos);
  remote.guid = hex(endpoint.key);
  remote.process_id = process_id(endpoint.participant_instance_handle);
  remote.reliable = is_reliable(endpoint.qos);
  remote.transient_local = is_transient_local(endpoint.qos);
  return std::make_shared<const RemoteEndpoint>(std::move(remote));
}

void CycloneDiscovery::on_participants(dds_entity_t reader, void* self) {
  static_cast<CycloneDiscovery*>(self)->report_participants(reader);
}

// Reads them all, since process_id() reads some of them, too, and may be first.
void CycloneDiscovery::report_participants(dds_entity_t reader) const {
  ParticipantSamples samples{};
  std::array<dds_sample_info_t, std::tuple_size_v<ParticipantSamples>> infos{};
  const dds_return_t count =
      dds_read_mask(reader, samples.data(), infos.data(), samples.size(),
                    static_cast<std::uint32_t>(samples.size()),
                    DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
  if (count <= 0) return;
  std::set<std::string> names;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const auto& found = *static_cast<const dds_builtintopic_participant_t*>(samples[i]);
    char* name = nullptr;
    if (infos[i].valid_data && dds_qget_entity_name(found.qos, &name) && name != nullptr) {
      names.insert(name);
      dds_free(name);
    }
  }
  dds_return_loan(reader, samples.data(), count);
  listener().on_participants(names);
}

template <bool is_writer>
void CycloneDiscovery::on_endpoints(dds_entity_t reader, void* self) {
  static_cast<CycloneDiscovery*>(self)->take_endpoints(reader, is_writer);
}

void CycloneDiscovery::take_endpoints(dds_entity_t reader, bool is_writer) {
  std::array<void*, 16> samples{};
  std::array<dds_sample_info_t, 16> infos{};
  dds_return_t count = 0;
  while ((count = dds_take(reader, samples.data(), infos.data(), samples.size(),
                           static_cast<std::uint32_t>(samples.size()))) > 0) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (infos[i].valid_data && infos[i].instance_state == DDS_IST_ALIVE) {
        const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
        const auto remote = describe(endpoint, is_writer);
        if (remote != nullptr) remotes_.add(infos[i].instance_handle, remote);
      } else {
        remotes_.remove(infos[i].instance_handle);
      }
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

int CycloneDiscovery::process_id(dds_instance_handle_t participant) const {
  // Cyclone fills as many pointers as it has ever lent of this reader, however many are asked for.
  ParticipantSamples samples{};
  dds_sample_info_t info{};
  int id = 0;
  if (dds_read_instance(participants_reader_.handle(), samples.data(), &info, samples.size(), 1,
                        participant) <= 0) {
    return id;
  }
  const auto& found = *static_cast<const dds_builtintopic_participant_t*>(samples.front());
  char* value = nullptr;
  if (info.valid_data && dds_qget_prop(found.qos, kProcessIdProperty, &value)) {
    id = std::atoi(value);
    dds_free(value);
  }
  dds_return_loan(participants_reader_.handle(), samples.data(), 1);
  return id;
}

}  // namespace clew::bridge
