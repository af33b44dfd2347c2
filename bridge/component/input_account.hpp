// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "component/start_barrier.hpp"
#include "core/hash128.hpp"
#include "dds/participant.hpp"
#include "line/frames.hpp"
#include "run/sample_account.hpp"
#include "runtime/input_buffer.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {

/// Keeps account of topics whose writers keep none: reads them, tick by tick, and hashes, counts
/// and spools the canonical form of what came. Samples come on the vendor's threads; all else may
/// be asked from any thread.
class InputAccount {
 public:
  using OnTick = std::function<void(std::uint64_t tick, const runtime::TopicSet& present,
                                    const domain::Messages& messages)>;

  /// Says of whom it is in messages, and of which topics; `scan` is the arrangement of beams that
  /// scans must have.
  InputAccount(std::string name, const runtime::TopicSet& topics, const Assignment& assignment,
               const domain::ScanLayout& scan);
  ~InputAccount();
  InputAccount(const InputAccount&) = delete;
  InputAccount& operator=(const InputAccount&) = delete;

  /// Goes on from a checkpoint instead of tick 0; before open().
  core::Result<void> restore(const Checkpoint& checkpoint);
  /// Begins at `tick` instead of 0; before open().
  void begin_at(std::uint64_t tick) { buffer_.restart_at(tick); }
  /// Shows each tick that is taken; before open(). It is called with the account locked.
  void on_tick(OnTick on_tick) { on_tick_ = std::move(on_tick); }
  /// Creates the readers. `barrier` and `participant` must outlive the account.
  core::Result<void> open(Participant& participant, const StartBarrier& barrier);

  Progress progress() const;
  /// Ticks below this one have come of each of `topics`, or later ones have.
  std::uint64_t ticks_of(const runtime::TopicSet& topics) const;
  /// The chains, if every tick up to `last_tick` is accounted for; else none yet.
  std::optional<Finished> finished(std::uint64_t last_tick) const;
  /// Keeps the samples themselves from now on.
  void spool();
  /// What was spooled since the last call, for for_each_spooled.
  std::string take_spooled();
  /// Lines for the log since the last call.
  std::vector<std::string> take_notices();
  /// Why the run cannot go on, if it cannot.
  std::optional<std::string> fatal() const;

 private:
  template <typename Message>
  std::unique_ptr<SampleListener> listener(const StartBarrier& barrier);
  template <typename Message>
  void deliver(Message& message);
  void refuse(domain::Topic topic, const core::Error& error);
  void take_tick();
  /// Tells of a sample that its writer has counted wrongly, or has written before and otherwise.
  template <typename Message>
  void check_count(const Message& message);

  const std::string name_;
  const runtime::TopicSet topics_;
  const domain::ScanLayout scan_;
  const std::string user_data_;
  const int history_depth_;
  const bool lockstep_;

  mutable std::mutex mutex_;
  runtime::InputBuffer buffer_;
  domain::Messages messages_;
  Codecs codecs_;
  SampleAccount account_;
  std::array<std::uint64_t, domain::kTopicCount> ends_{};  ///< behind the newest sample, by topic
  std::array<bool, domain::kTopicCount> miscounts_{};      ///< it was told that they do
  /// Of the last ticks of each topic, as many as a history holds: tick and content.
  std::array<std::map<std::uint64_t, core::Hash128>, domain::kTopicCount> seen_;
  OnTick on_tick_;
  std::uint64_t refused_samples_ = 0;
  std::vector<std::string> notices_;
  std::optional<std::string> fatal_;
  std::vector<std::unique_ptr<SampleListener>> listeners_;
  std::vector<std::unique_ptr<SampleReader>> readers_;  // closed before the listeners go
};

}  // namespace clew::bridge
