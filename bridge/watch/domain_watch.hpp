// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "dds/participant.hpp"
#include "line/wake_up.hpp"

namespace clew::bridge {

/// The domain of the run that `run` is: a domain's number, or the name of a run. Refused: a number
/// that is none of ours, a name that no run has, and a composed run, which is on no domain.
core::Result<int> domain_of_run(const std::string& run);

/// What others have on a DDS domain, whoever they are, and samples of theirs as bytes. It reads
/// best effort and keeps nothing for long, so no writer ever waits for it.
class DomainWatch : private DiscoveryListener {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static core::Result<std::unique_ptr<DomainWatch>> join(int domain);
  ~DomainWatch() override;

  int domain() const { return domain_; }
  /// Waits until nothing new was heard of for a while, `most` at most.
  void settle(std::chrono::nanoseconds most) const;
  /// The endpoints of all others that are known by now, by topic, type and GUID.
  std::vector<RemoteEndpoint> endpoints() const;

  /// Reads a topic from now on. Its samples carry the number of the call, from 0.
  core::Result<void> read(const std::string& topic, const std::string& type);

  struct Arrival {
    std::size_t reader = 0;
    Time at;
    std::string cdr;  ///< with its four bytes of encapsulation
  };
  /// Waits until something has come, the descriptor can be read, or the time is over.
  void wait(int descriptor, std::chrono::nanoseconds most) const;
  /// What has come since the last call, in order.
  std::vector<Arrival> take();
  /// Samples that came faster than they were taken, and were dropped.
  std::uint64_t dropped() const;
  /// The policy because of which a topic that is read and a writer do not match; empty if all do.
  std::string incompatible_policy() const;

 private:
  /// The reader's side of one topic.
  class Reader : public SampleListener {
   public:
    Reader(DomainWatch& watch, std::size_t number) : watch_(watch), number_(number) {}
    void on_sample(std::string_view cdr, const RemoteEndpoint*) override {
      watch_.keep(number_, cdr);
    }

    std::unique_ptr<SampleReader> endpoint;

   private:
    DomainWatch& watch_;
    std::size_t number_;
  };

  explicit DomainWatch(int domain) : domain_(domain) {}
  void keep(std::size_t reader, std::string_view cdr);
  void on_participants(const std::set<std::string>&) override {}
  void on_matched(const RemoteEndpoint&) override {}
  void on_unmatched(const RemoteEndpoint&) override {}
  void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                           const std::string& policy) override;
  void on_inconsistent_type(const RemoteEndpoint&) override {}
  void on_discovered(const RemoteEndpoint& remote) override;
  void on_lost(const RemoteEndpoint& remote) override;

  int domain_;
  WakeUp changed_;
  mutable std::mutex mutex_;
  std::map<std::string, RemoteEndpoint> endpoints_;  ///< by GUID
  std::uint64_t news_ = 0;                           ///< endpoints that came or went
  std::string incompatible_policy_;
  std::vector<Arrival> arrivals_;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
  std::unique_ptr<Participant> participant_;
  std::vector<std::unique_ptr<Reader>> readers_;  ///< closed first
};

}  // namespace clew::bridge
