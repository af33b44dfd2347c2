// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dds/participant.hpp"
#include "line/frames.hpp"
#include "line/run_key.hpp"

namespace clew::bridge {

/// Watches discovery for one process: which expected endpoints are matched, who may be listened to,
/// and what can never match. Safe from any thread.
class StartBarrier : public DiscoveryListener {
 public:
  /// `on_change` is called, without locks, when the set of missing endpoints changes; `on_refused`
  /// with a sentence for each endpoint that is turned away; `on_fatal` for what makes a start
  /// impossible; `on_reader`, if there is one, with a sentence for each reader of somebody else's:
  /// it cannot be turned away, and nobody waits for it.
  struct Handlers {
    std::function<void()> on_change;
    std::function<void(std::string)> on_refused;
    std::function<void(std::string)> on_fatal;
    std::function<void(std::string)> on_reader = nullptr;
  };

  StartBarrier(std::string own_name, std::vector<ExpectedEndpoint> expected, Handlers handlers);

  /// An endpoint that says of which stage it is, needs the seal of this key; before there is a
  /// participant.
  void demand_seals(RunKey key) { key_ = std::move(key); }
  /// Expects more endpoints; before those of this process that they will match are created.
  void expect(const std::vector<ExpectedEndpoint>& more);

  /// The expected endpoints that are not matched, a sentence each.
  std::vector<std::string> missing() const;

  /// Waits until the participants with these names are known, at most until `deadline`. Whether
  /// they are.
  bool wait_for_participants(const std::vector<std::string>& names,
                             std::chrono::steady_clock::time_point deadline) const;

  /// Whether samples of this writer may enter: it is the expected one of its topic, built from the
  /// same IDL.
  bool accepts(const RemoteEndpoint* writer) const;
  /// Changes whenever an answer of accepts() may have changed.
  std::uint64_t version() const { return version_.load(); }

  void on_participants(const std::set<std::string>& names) override;
  void on_matched(const RemoteEndpoint& remote) override;
  void on_unmatched(const RemoteEndpoint& remote) override;
  void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                           const std::string& policy) override;
  void on_inconsistent_type(const RemoteEndpoint& remote) override;

 private:
  /// Why an endpoint is no part of this run; empty if it is.
  std::string objection(const RemoteEndpoint& remote) const;
  /// Whether a reader is one that this process writes for.
  bool is_expected_reader(const RemoteEndpoint& remote) const;
  /// Whether an endpoint of a component that is not clew's, or of anybody, is not matched yet.
  bool misses_third_party(const std::string& topic, bool is_writer) const;

  const std::string own_name_;
  const Handlers handlers_;
  RunKey key_;
  std::atomic<std::uint64_t> version_{0};
  mutable std::mutex mutex_;
  std::vector<ExpectedEndpoint> expected_;
  std::map<std::string, RemoteEndpoint> matched_;  // accepted ones, by guid
  std::set<std::string> participants_;
  mutable std::condition_variable participants_changed_;
};

}  // namespace clew::bridge
