// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "domain/incident.hpp"
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
  /// Whether it waits for nothing more.
  virtual bool idle() const = 0;
  /// Rises while something is passed on to it.
  virtual std::uint64_t progress() const = 0;
};

/// A run under way, as its viewers get it: each is sent what is there when it comes, then the
/// newest tick sixty times a second, or all ticks if it asks for them. A viewer that does not keep
/// up misses ticks, never holds up anybody, and is told how many it missed. A quarter of what may
/// be held is for states.
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

  /// `stages`: how many hand over states at a checkpoint; 0: that is not known.
  void describe(const RunDescription& description, const std::string& name, std::size_t stages = 0);
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
  /// What befell it, as it came.
  const std::vector<domain::Incident>& incidents() const { return incidents_; }

  /// From where on what components are can be computed: the first tick of the run, or a checkpoint
  /// of which all states are held.
  struct Start {
    std::uint64_t tick = 0;
    std::map<std::string, std::string> states;  ///< by stage; none at tick 0
  };
  /// The newest start that is no later than `tick`, and from which on all ticks up to it are held;
  /// none if there is none. No behaviour is on its way in at it: what was put in before is in the
  /// states, and what is put in later is fed from there on.
  std::optional<Start> start_before(std::uint64_t tick) const;

  bool has_followers() const { return !followers_.empty(); }
  /// Rises while something is passed on.
  std::uint64_t progress() const;
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
  /// Whether a behaviour that was put in by `last` was fed before the checkpoint at `tick`, and
  /// took over no sooner than that.
  bool is_changing(std::uint64_t tick, std::uint64_t last) const;
  /// The first tick from which on all up to `last` are held; none if that is not.
  std::optional<std::uint64_t> unbroken_until(std::uint64_t last) const;
  void forget_oldest();
  void forget_states();

  const std::size_t most_bytes_;
  std::string name_;
  std::optional<RunDescription> description_;
  std::string ended_;
  std::size_t topics_ = 0;
  std::size_t stages_ = 0;
  std::map<domain::Topic, std::uint64_t> next_of_;
  std::map<std::uint64_t, HeldTick> ticks_;
  std::vector<domain::Intervention> interventions_;
  std::vector<domain::Incident> incidents_;
  std::map<std::uint64_t, std::map<std::string, std::string>> states_;  ///< by tick and stage
  std::size_t state_bytes_ = 0;
  std::size_t held_bytes_ = 0;
  std::optional<std::uint64_t> newest_complete_;
  std::set<StreamFollower*> followers_;
};

}  // namespace clew::bridge
