// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "component/input_history.hpp"
#include "core/result.hpp"
#include "hosts/host_list.hpp"
#include "hosts/hosted_component.hpp"
#include "run/end_signals.hpp"

namespace clew::bridge {

/// What `clew host` was asked for.
struct HostOrder {
  TcpAddress listen;
  std::string identity;  ///< a directory
  std::string program;   ///< the clew command
  std::string version;
  std::vector<std::string> allowed;
};

/// Starts components of runs that are elsewhere, and nothing else.
class HostService {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static core::Result<std::unique_ptr<HostService>> open(const HostOrder& order);
  ~HostService();

  /// Who it is and where it listens.
  std::string name() const { return name_; }
  TcpAddress address() const;

  /// Until a signal asks for an end. `signals` were made before the service.
  void run(EndSignals& signals);

 private:
  HostService(HostOrder order, TlsContextPtr context, std::string name, int listening);

  void accept(Time now);
  void note_refusal(int reason);
  void send_surplus_away();
  void forget(Time now);
  bool clear_place(const HostedComponent& newcomer);
  core::Result<std::shared_ptr<DomainLock>> lock(int domain);
  std::map<std::string, std::string> input_files(const std::string& run,
                                                 const std::vector<std::string>& stages);
  /// What a stage of a run was given of late, for its next process.
  struct RunMemory {
    std::map<std::string, InputHistory> inputs;
    Time used_at{};
  };

  TlsContextPtr context_;
  std::string name_;
  int listening_;
  bool accepts_ = true;  ///< who came last could be taken
  HostSurroundings surroundings_;
  std::map<int, std::weak_ptr<DomainLock>> locks_;
  std::map<std::string, RunMemory> memory_;
  std::deque<std::unique_ptr<HostedComponent>> components_;  ///< the oldest first
};

}  // namespace clew::bridge
