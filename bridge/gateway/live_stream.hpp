// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "domain/intervention.hpp"
#include "recording/run_description.hpp"

namespace clew::bridge {

/// One who is sent what a stream has.
class StreamFollower {
 public:
  virtual ~StreamFollower() = default;
  /// The run is described now.
  virtual void begin() = 0;
  /// Sends what is due.
  virtual void pass_on() = 0;
  /// The run has ended.
  virtual void end() = 0;
  /// Whether all that is due is on its way.
  virtual bool idle() const = 0;
};

/// A run under way, as its viewers get it: each is sent what is there when it comes, then the
/// newest tick sixty times a second, or all ticks if it asks for them. A viewer that does not keep
/// up misses ticks, never holds up anybody, and is told how many it missed.
class LiveStream {
 public:
  /// A whole tick, as a spool has it.
  struct Tick {
    std::uint64_t number = 0;
    const std::string* records = nullptr;
  };

  explicit LiveStream(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  LiveStream(const LiveStream&) = delete;
  LiveStream& operator=(const LiveStream&) = delete;

  void describe(const RunDescription& description, const std::string& name);
  /// Takes what components wrote; false if it is no spool.
  bool add(std::string_view spool);
  void end(const std::string& how);
  /// Lets each follower send what is due: sixty times a second.
  void pass_on();

  /// Nothing before it is described.
  const std::optional<RunDescription>& description() const { return description_; }
  const std::string& name() const { return name_; }
  /// How the run ended; empty while it has not.
  const std::string& ended() const { return ended_; }
  /// The first whole tick from this one on; none if it is not there yet.
  std::optional<Tick> tick_from(std::uint64_t number) const;
  std::optional<Tick> newest() const;
  /// What was changed in the run while it went on, as it came.
  const std::vector<domain::Intervention>& interventions() const { return interventions_; }

  bool has_followers() const { return !followers_.empty(); }
  /// Whether every follower is.
  bool idle() const;
  void follow(StreamFollower& follower) { followers_.insert(&follower); }
  void leave(StreamFollower& follower) { followers_.erase(&follower); }

 private:
  struct HeldTick {
    std::string records;
    std::size_t samples = 0;
  };

  bool complete(const HeldTick& tick) const { return tick.samples >= topics_; }
  void forget_oldest();

  const std::size_t most_bytes_;
  std::string name_;
  std::optional<RunDescription> description_;
  std::string ended_;
  std::size_t topics_ = 0;
  std::map<domain::Topic, std::uint64_t> next_of_;
  std::map<std::uint64_t, HeldTick> ticks_;
  std::vector<domain::Intervention> interventions_;
  std::size_t held_bytes_ = 0;
  std::optional<std::uint64_t> newest_complete_;
  std::set<StreamFollower*> followers_;
};

}  // namespace clew::bridge
