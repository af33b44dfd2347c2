// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "core/hash128.hpp"
#include "domain/incident.hpp"
#include "domain/intervention.hpp"
#include "run/run_statistics.hpp"
#include "wire/codec.hpp"
#include "wire/sample.hpp"

namespace clew::bridge {

/// A component's state before it steps `tick`, on its way to a black box.
struct SpooledState {
  std::string_view stage;
  std::uint64_t tick = 0;
  std::string_view state;  ///< runtime::Node::save
};

/// Keeps account of the samples that somebody writes: chained hashes, counts, and the samples
/// themselves if they are to be recorded.
class SampleAccount {
 public:
  SampleAccount(bool hash, bool spool) : hash_(hash), spool_(spool) {}

  /// `cdr` is the message's serialised form; it is not needed with neither hash nor spool.
  template <typename Message>
  void add(const Message& message, std::string_view cdr) {
    statistics_.add(message);
    add_bytes(domain::topic_of<Message>(), message.stamp, cdr);
  }
  bool wants_bytes() const { return hash_ || spool_; }
  /// Keeps the samples themselves from now on.
  void spool() { spool_ = true; }

  const RunStatistics& statistics() const { return statistics_; }
  /// The chains of the topics written, by name; empty without hash.
  std::map<std::string, core::Hash128> chains() const;

  /// The account so far, without what waits in the spool.
  template <typename Visitor>
  friend void visit_fields(Visitor& visit, SampleAccount& account) {
    visit(account.statistics_, account.chains_, account.written_);
  }

  /// Puts a component's state among the samples.
  void spool_state(const SpooledState& state);
  std::size_t spooled_bytes() const { return spooled_.size(); }
  /// What was spooled since the last call, for for_each_spooled.
  std::string take_spooled();

 private:
  void add_bytes(domain::Topic topic, const domain::TickStamp& stamp, std::string_view cdr);

  bool hash_;
  bool spool_;
  RunStatistics statistics_;
  std::array<core::HashChain, domain::kTopicCount> chains_;
  std::array<bool, domain::kTopicCount> written_{};
  std::string spooled_;
};

/// Who takes what is in a spool.
struct SpoolVisitor {
  std::function<void(const SampleView&)> on_sample;
  std::function<void(const SpooledState&)> on_state;
  std::function<void(const domain::Intervention&)> on_intervention = nullptr;
  std::function<void(const domain::Incident&)> on_incident = nullptr;
};

/// An intervention, or an incident, as an entry of a spool.
std::string spooled(const domain::Intervention& intervention);
std::string spooled(const domain::Incident& incident);

/// Calls `visitor` for each entry of a spool, in order; false if it is not one.
bool for_each_spooled(std::string_view spool, const SpoolVisitor& visitor);

}  // namespace clew::bridge
