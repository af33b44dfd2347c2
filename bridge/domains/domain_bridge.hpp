// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "domains/bridge_file.hpp"
#include "domains/inbox.hpp"
#include "domains/outlet.hpp"

namespace clew::domains {

/// A domain as the bridge knows it.
struct Place {
  std::string name;  ///< in the file
  int domain = 0;
  bool on_network = false;
  std::string id;  ///< for origins: no other domain has it, of this host or of another one
};

/// What a bridge needs of the world around it.
struct Surroundings {
  /// A participant on the domain of a place, number `index` in the file.
  std::function<core::Result<std::unique_ptr<bridge::Participant>>(
      std::size_t index, const bridge::ParticipantConfig&, bridge::DiscoveryListener&)>
      join;
  /// Says a sentence to people.
  std::function<void(const std::string&)> tell;
};

/// Passes samples of topics from domain to domain, as bytes, whatever their type.
///
/// Reading and writing are participants of their own, so that what this bridge writes comes back to
/// it like anybody's, with an origin, and is refused like anybody's.
///
/// A writer is made for each writer's QoS, type and origin that is found on the other side, before
/// its first sample, and closed when the last such writer is gone. Each sample is read by one
/// reader, that of its writer's QoS. All happens on the thread that calls step().
class DomainBridge {
 public:
  /// `places` are the file's domains, in their order.
  static core::Result<std::unique_ptr<DomainBridge>> create(BridgeFile file,
                                                            std::vector<Place> places,
                                                            Surroundings surroundings);
  ~DomainBridge();

  /// Passes on what has come; waits for nobody.
  void step();
  /// Whether something waits for a slow reader.
  bool waits() const;
  /// Waits until something has come, the descriptor can be read, or the time is over.
  void wait(int descriptor, std::chrono::nanoseconds most) const { inbox_.wait(descriptor, most); }

  const std::deque<Passage>& passages() const { return passages_; }
  const std::vector<Place>& places() const { return places_; }
  /// Samples that came faster than they were passed on, and were dropped before anything else.
  std::uint64_t overrun() const { return inbox_.dropped(); }
  /// Samples of writers that are unknown or left out, which are refused.
  std::uint64_t unknown() const { return unknown_; }

 private:
  /// How a writer's samples are read.
  struct Manner {
    bool reliable = false;
    bool transient_local = false;
    bool operator<(const Manner& other) const {
      return std::tie(reliable, transient_local) < std::tie(other.reliable, other.transient_local);
    }
  };
  class Ear;
  class Intake;

  /// What becomes of a writer's samples by one rule, on one other side.
  struct Route {
    const TopicRule* rule = nullptr;
    Passage* passage = nullptr;
    Outlet* outlet = nullptr;   ///< none: they are refused
    std::optional<Time> due{};  ///< not before, by the rate
  };
  struct Source {
    std::string type;
    Manner manner;
    std::vector<Route> routes;
  };
  using SourceKey = std::pair<std::size_t, std::string>;  ///< domain, GUID
  /// Passage, type, manner, USER_DATA.
  using OutletKey = std::tuple<Passage*, std::string, Manner, std::string>;
  using IntakeKey = std::tuple<std::size_t, std::string, std::string, Manner>;

  DomainBridge(BridgeFile file, std::vector<Place> places, Surroundings surroundings);
  core::Result<void> open();
  void take(const WriterFound& found);
  void take(const WriterLost& lost);
  void take(const SampleCame& sample);
  void take(const Notice& notice) { surroundings_.tell(notice.text); }

  void add_route(const TopicRule& rule, const std::string& as, std::size_t to,
                 const WriterFound& found, Source& source);
  /// Why samples of a writer must not go there; empty if they may.
  std::string refusal(const TopicRule& rule, std::size_t to, const WriterFound& found) const;
  Passage& passage_of(const TopicRule& rule, const std::string& topic, const std::string& as,
                      std::size_t to);
  Outlet* outlet_of(const Route& route, const WriterFound& found, const Source& source);
  void listen(const WriterFound& found, const Source& source);
  void pass(const SampleCame& sample, const Source& source, Route& route);

  const BridgeFile file_;
  const std::vector<Place> places_;
  const Surroundings surroundings_;
  Inbox inbox_;
  std::uint64_t unknown_ = 0;
  std::deque<Passage> passages_;  ///< in place, since others point to them
  std::vector<std::unique_ptr<Ear>> ears_;
  std::vector<std::unique_ptr<bridge::Participant>> readers_side_;
  std::vector<std::unique_ptr<bridge::Participant>> writers_side_;
  std::map<OutletKey, Outlet> outlets_;
  std::map<IntakeKey, std::unique_ptr<Intake>> intakes_;  ///< closed before the rest
  std::map<SourceKey, Source> sources_;
};

}  // namespace clew::domains
