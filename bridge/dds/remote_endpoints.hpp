// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "dds/participant.hpp"

namespace clew::bridge {

/// The participant property in which both vendors tell their process id; Cyclone DDS came first.
inline constexpr const char* kProcessIdProperty = "__Pid";

/// The endpoints of other participants, by the vendor's key, beside the types of this one's own.
/// Neither vendor says a word of two types on a topic, so they are compared here: once for every
/// pair that comes to be known. The listener is called without the lock.
template <typename Key>
class RemoteEndpoints {
 public:
  explicit RemoteEndpoints(DiscoveryListener& listener) : listener_(listener) {}

  /// From now on, or no longer, this participant has an endpoint on `topic` with `type`.
  void add_local(const std::string& topic, const std::string& type) {
    std::vector<std::shared_ptr<const RemoteEndpoint>> inconsistent;
    {
      const std::lock_guard lock(mutex_);
      local_types_.emplace(topic, type);
      for (const auto& [key, remote] : remotes_) {
        if (remote->topic == topic && remote->type != type) inconsistent.push_back(remote);
      }
    }
    for (const auto& remote : inconsistent) listener_.on_inconsistent_type(*remote);
  }
  void remove_local(const std::string& topic, const std::string& type) {
    const std::lock_guard lock(mutex_);
    const auto [first, last] = local_types_.equal_range(topic);
    for (auto it = first; it != last; ++it) {
      if (it->second != type) continue;
      local_types_.erase(it);
      return;
    }
  }

  void add(const Key& key, const std::shared_ptr<const RemoteEndpoint>& remote) {
    bool is_inconsistent = false;
    listener_.on_discovered(*remote);
    {
      const std::lock_guard lock(mutex_);
      const bool is_new = remotes_.insert_or_assign(key, remote).second;
      const auto [first, last] = local_types_.equal_range(remote->topic);
      for (auto it = first; it != last; ++it) {
        if (is_new && it->second != remote->type) is_inconsistent = true;
      }
    }
    if (is_inconsistent) listener_.on_inconsistent_type(*remote);
  }
  void remove(const Key& key) {
    std::shared_ptr<const RemoteEndpoint> gone;
    {
      const std::lock_guard lock(mutex_);
      const auto known = remotes_.find(key);
      if (known == remotes_.end()) return;
      gone = std::move(known->second);
      remotes_.erase(known);
    }
    listener_.on_lost(*gone);
  }
  /// Null if it is unknown.
  std::shared_ptr<const RemoteEndpoint> find(const Key& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = remotes_.find(key);
    return found != remotes_.end() ? found->second : nullptr;
  }

  DiscoveryListener& listener() const { return listener_; }

 private:
  DiscoveryListener& listener_;
  mutable std::mutex mutex_;
  std::multimap<std::string, std::string> local_types_;  ///< by topic
  std::map<Key, std::shared_ptr<const RemoteEndpoint>> remotes_;
};

}  // namespace clew::bridge
