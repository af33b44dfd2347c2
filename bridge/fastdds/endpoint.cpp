// SPDX-License-Identifier: Apache-2.0
#include "fastdds/endpoint.hpp"

#include "dds/qos_policy_names.hpp"

namespace clew::bridge {

FastEndpoint::FastEndpoint(FastDiscovery& discovery, EndpointSpec spec, bool is_writer)
    : discovery_(discovery), spec_(std::move(spec)), is_writer_(is_writer) {
  discovery_.add_local(spec_.topic, spec_.type);
}

FastEndpoint::~FastEndpoint() { discovery_.remove_local(spec_.topic, spec_.type); }

void FastEndpoint::on_match(const Guid& guid, int change) {
  if (change > 0) add(guid);
  if (change < 0) remove(guid);
}

void FastEndpoint::on_incompatible_qos(std::uint32_t policy_id) {
  discovery_.listener().on_incompatible_qos(spec_.topic, is_writer_,
                                            std::string(qos_policy_name(policy_id)));
}

std::shared_ptr<const RemoteEndpoint> FastEndpoint::find(const Guid& guid) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = matches_.find(guid);
    if (found != matches_.end()) return found->second;
  }
  return add(guid);
}

std::shared_ptr<const RemoteEndpoint> FastEndpoint::add(const Guid& guid) {
  std::shared_ptr<const RemoteEndpoint> remote = discovery_.find(guid);
  if (remote == nullptr) return nullptr;
  bool is_new = false;
  {
    const std::lock_guard lock(mutex_);
    is_new = matches_.emplace(guid, remote).second;
  }
  if (is_new) discovery_.listener().on_matched(*remote);
  return remote;
}

void FastEndpoint::remove(const Guid& guid) {
  std::shared_ptr<const RemoteEndpoint> remote;
  {
    const std::lock_guard lock(mutex_);
    const auto found = matches_.find(guid);
    if (found == matches_.end()) return;
    remote = found->second;
    matches_.erase(found);
  }
  discovery_.listener().on_unmatched(*remote);
}

}  // namespace clew::bridge
