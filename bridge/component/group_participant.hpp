// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "dds/participant.hpp"
#include "line/frames.hpp"

namespace clew::bridge {

/// The participant of a process with several stages. What one of them writes and another reads
/// stays in the process; all else goes over DDS. A stage cannot tell the difference: what stays is
/// bytes, too, and its endpoints match as they would on the wire.
///
/// A thread of its own delivers, since a stage writes in the middle of its step, and what it writes
/// may come back to it around the loop of the graph. What waits for that thread is bounded as what
/// waits on the wire is: by the lead of the stage that starts ticks.
///
/// A reader must not be destroyed from on_sample of a listener: its destructor waits for the end of
/// the delivery under way, which would wait for itself.
class GroupParticipant : public Participant {
 public:
  /// `stages` are those of the process, `expected` the endpoints that theirs shall match, those of
  /// each other as well. `discovery` must outlive the participant.
  GroupParticipant(std::unique_ptr<Participant> wire, const std::vector<std::string>& stages,
                   const std::vector<ExpectedEndpoint>& expected, DiscoveryListener& discovery);
  ~GroupParticipant() override;
  GroupParticipant(const GroupParticipant&) = delete;
  GroupParticipant& operator=(const GroupParticipant&) = delete;

  std::string guid() const override { return wire_->guid(); }
  core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) override;
  core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                            SampleListener& listener) override;
  /// Begins to deliver: once every stage has its endpoints. Until then, what is written waits.
  void start();

 private:
  class Writer;
  class Reader;
  using Listeners = std::vector<SampleListener*>;
  /// A topic that is written and read here.
  struct Channel {
    RemoteEndpoint writer;  ///< as readers see it
    /// Another one after each change, since a delivery goes on with the one that it began with. The
    /// pointer is guarded by mutex_.
    std::shared_ptr<const Listeners> listeners = std::make_shared<const Listeners>();
  };
  struct Sample {
    Channel* channel = nullptr;
    std::string cdr;
  };

  /// What stands for the GUID of an endpoint that is not on the wire.
  std::string inner_guid(const char* what, const EndpointSpec& spec) const;
  void push(Channel& channel, std::string_view cdr);
  void deliver();
  /// Returns when nothing is delivered to the listener any more, however much waits for others.
  /// Not to be called from on_sample.
  void remove(Channel& channel, const SampleListener& listener);

  std::unique_ptr<Participant> wire_;
  DiscoveryListener& discovery_;
  std::set<std::string> to_wire_;  ///< topics that are written here and read elsewhere
  std::map<std::string, Channel> channels_;
  std::mutex mutex_;  ///< of what follows; held for moments only
  std::condition_variable news_;
  std::condition_variable delivered_;  ///< a sample was delivered
  std::deque<Sample> waiting_;
  std::uint64_t begun_deliveries_ = 0;
  std::uint64_t ended_deliveries_ = 0;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace clew::bridge
