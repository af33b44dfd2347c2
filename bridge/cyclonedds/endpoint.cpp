// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/endpoint.hpp"

#include <algorithm>
#include <vector>

#include "dds/qos_policy_names.hpp"

namespace clew::bridge {

CycloneEndpoint::CycloneEndpoint(CycloneDiscovery& discovery, EndpointSpec spec, bool is_writer)
    : discovery_(discovery), spec_(std::move(spec)), is_writer_(is_writer) {}

CycloneEndpoint::~CycloneEndpoint() { detach(); }

core::Result<void> CycloneEndpoint::create_topic(dds_entity_t participant) {
  ddsi_sertype* type = make_raw_type(spec_.type);
  const dds_entity_t handle =
      dds_create_topic_sertype(participant, spec_.topic.c_str(), &type, nullptr, nullptr, nullptr);
  if (handle < 0) {
    ddsi_sertype_unref(type);
    return cyclone_error("creating topic " + spec_.topic, handle);
  }
  topic_ = CycloneEntity(handle);
  type_ = type;
  return {};
}

CycloneQos CycloneEndpoint::qos() const {
  CycloneQos qos = make_cyclone_qos();
  // A write that would have to wait for acknowledgements fails at once.
  dds_qset_reliability(
      qos.get(), spec_.qos.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), spec_.qos.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL
                                                           : DDS_DURABILITY_VOLATILE);
  // KEEP_LAST drops what is not acknowledged when it is full. Unless that is wanted, the writer
  // drops nothing before it is acknowledged, and what it keeps for late readers is bounded by the
  // durability service.
  if (spec_.qos.keep_last) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, spec_.history_depth);
  } else {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  }
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, spec_.history_depth,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &xcdr1);
  dds_qset_userdata(qos.get(), spec_.user_data.data(), spec_.user_data.size());
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

core::Result<void> CycloneEndpoint::attach(dds_entity_t created, dds_listener_t* listener) {
  if (created < 0) {
    return cyclone_error(
        std::string("creating a ") + (is_writer_ ? "writer" : "reader") + " of " + spec_.topic,
        created);
  }
  entity_ = CycloneEntity(created);
  if (is_writer_) {
    dds_lset_publication_matched_arg(listener, on_writer_matched, this, false);
    dds_lset_offered_incompatible_qos_arg(listener, on_writer_incompatible, this, false);
  } else {
    dds_lset_subscription_matched_arg(listener, on_reader_matched, this, false);
    dds_lset_requested_incompatible_qos_arg(listener, on_reader_incompatible, this, false);
  }
  const dds_return_t code = dds_set_listener(handle(), listener);
  if (code < 0) return cyclone_error("listening to " + spec_.topic, code);
  discovery_.add_local(spec_.topic, spec_.type);
  report_earlier_incompatible();
  compare_matches();
  return {};
}

void CycloneEndpoint::detach() {
  if (handle() == 0) return;
  discovery_.remove_local(spec_.topic, spec_.type);
  dds_set_listener(handle(), nullptr);
  entity_.reset();
}

std::shared_ptr<const RemoteEndpoint> CycloneEndpoint::find(dds_instance_handle_t handle) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = matches_.find(handle);
    if (found != matches_.end()) return found->second;
  }
  // A sample may come before the thread of discovery has told of its writer.
  compare_matches();
  const std::lock_guard lock(mutex_);
  const auto found = matches_.find(handle);
  return found != matches_.end() ? found->second : nullptr;
}

void CycloneEndpoint::on_writer_matched(dds_entity_t, dds_publication_matched_status_t,
                                        void* self) {
  static_cast<CycloneEndpoint*>(self)->compare_matches();
}

void CycloneEndpoint::on_reader_matched(dds_entity_t, dds_subscription_matched_status_t,
                                        void* self) {
  static_cast<CycloneEndpoint*>(self)->compare_matches();
}

void CycloneEndpoint::on_writer_incompatible(dds_entity_t,
                                             dds_offered_incompatible_qos_status_t status,
                                             void* self) {
  static_cast<CycloneEndpoint*>(self)->report_incompatible(status.last_policy_id);
}

void CycloneEndpoint::on_reader_incompatible(dds_entity_t,
                                             dds_requested_incompatible_qos_status_t status,
                                             void* self) {
  static_cast<CycloneEndpoint*>(self)->report_incompatible(status.last_policy_id);
}

/// Reports what has changed since the last call. A status tells of one change only, and changes
/// from before the listener was set are told by none.
void CycloneEndpoint::compare_matches() {
  const std::lock_guard lock(mutex_);
  const std::vector<dds_instance_handle_t> now = matched_handles();
  for (auto it = matches_.begin(); it != matches_.end();) {
    if (std::find(now.begin(), now.end(), it->first) != now.end()) {
      ++it;
      continue;
    }
    if (it->second != nullptr) discovery_.listener().on_unmatched(*it->second);
    it = matches_.erase(it);
  }
  for (const dds_instance_handle_t handle : now) {
    if (matches_.count(handle) > 0) continue;
    const std::shared_ptr<const RemoteEndpoint> remote = describe(handle);
    matches_[handle] = remote;
    if (remote != nullptr) discovery_.listener().on_matched(*remote);
  }
}

std::vector<dds_instance_handle_t> CycloneEndpoint::matched_handles() const {
  std::vector<dds_instance_handle_t> handles(16);
  while (true) {
    const dds_return_t count =
        is_writer_ ? dds_get_matched_subscriptions(handle(), handles.data(), handles.size())
                   : dds_get_matched_publications(handle(), handles.data(), handles.size());
    if (count < 0) return {};
    const bool fits = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (fits) return handles;
  }
}

std::shared_ptr<const RemoteEndpoint> CycloneEndpoint::describe(
    dds_instance_handle_t matched) const {
  dds_builtintopic_endpoint_t* endpoint = is_writer_
                                              ? dds_get_matched_subscription_data(handle(), matched)
                                              : dds_get_matched_publication_data(handle(), matched);
  if (endpoint == nullptr) return nullptr;
  auto remote = discovery_.describe(*endpoint, !is_writer_);
  dds_builtintopic_free_endpoint(endpoint);
  return remote;
}

void CycloneEndpoint::report_incompatible(std::uint32_t policy_id) {
  discovery_.listener().on_incompatible_qos(spec_.topic, is_writer_,
                                            std::string(qos_policy_name(policy_id)));
}

void CycloneEndpoint::report_earlier_incompatible() {
  if (is_writer_) {
    dds_offered_incompatible_qos_status_t status{};
    dds_get_offered_incompatible_qos_status(handle(), &status);
    if (status.total_count_change > 0) report_incompatible(status.last_policy_id);
  } else {
    dds_requested_incompatible_qos_status_t status{};
    dds_get_requested_incompatible_qos_status(handle(), &status);
    if (status.total_count_change > 0) report_incompatible(status.last_policy_id);
  }
}

}  // namespace clew::bridge
