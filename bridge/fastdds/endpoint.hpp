// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "dds/participant.hpp"
#include "fastdds/discovery.hpp"

namespace clew::bridge {

/// What a writer and a reader of Fast DDS share: their topic's name and who matches. No lock is
/// held while a listener or Fast DDS is called, since Fast DDS calls with locks of its own.
class FastEndpoint {
 public:
  using Guid = FastDiscovery::Guid;

  FastEndpoint(FastDiscovery& discovery, EndpointSpec spec, bool is_writer);
  ~FastEndpoint();
  FastEndpoint(const FastEndpoint&) = delete;
  FastEndpoint& operator=(const FastEndpoint&) = delete;

  const EndpointSpec& spec() const { return spec_; }

  /// To be called when Fast DDS says that the number of matches changed by `change`, the last one
  /// being `guid`.
  void on_match(const Guid& guid, int change);
  void on_incompatible_qos(std::uint32_t policy_id);

  /// The matched endpoint with this GUID, which is reported now if it was not before: a sample may
  /// come a moment before the match. Null if discovery does not know it.
  std::shared_ptr<const RemoteEndpoint> find(const Guid& guid);

 private:
  std::shared_ptr<const RemoteEndpoint> add(const Guid& guid);
  void remove(const Guid& guid);

  FastDiscovery& discovery_;
  const EndpointSpec spec_;
  const bool is_writer_;
  std::mutex mutex_;
  std::map<Guid, std::shared_ptr<const RemoteEndpoint>> matches_;
};

}  // namespace clew::bridge
