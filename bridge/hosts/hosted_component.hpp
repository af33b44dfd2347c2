// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hosts/host_frames.hpp"
#include "hosts/tls_line.hpp"
#include "line/domain_lock.hpp"
#include "line/link.hpp"
#include "supervisor/child_process.hpp"
#include "supervisor/group_guard.hpp"
#include "vendors/memory_file.hpp"

namespace clew::bridge {

class HostedComponent;

/// What a host is to the components on it.
struct HostSurroundings {
  std::string program;               ///< the clew command
  std::string version;               ///< of it
  std::vector<std::string> allowed;  ///< programs and plug-ins that a run may name
  /// Ends others of the same run and stage; whether none is there any more.
  std::function<bool(const HostedComponent&)> clear_place;
  /// Keeps other runs of this host off a domain.
  std::function<core::Result<std::shared_ptr<DomainLock>>(int)> lock;
  /// The files in which the stages of a run keep their inputs: Assignment::input_histories.
  std::function<std::map<std::string, std::string>(const std::string&,
                                                   const std::vector<std::string>&)>
      input_files;
};

/// A connection of a relay, and the component that it wants to be started, if it proves who it is
/// and this host agrees. The component does not outlive the connection: it is told that its run is
/// gone, and has a moment to end.
class HostedComponent {
 public:
  using Time = std::chrono::steady_clock::time_point;

  HostedComponent(int socket, SSL_CTX& context, HostSurroundings& host, Time now);
  ~HostedComponent();
  HostedComponent(const HostedComponent&) = delete;
  HostedComponent& operator=(const HostedComponent&) = delete;

  void add_descriptors(std::vector<pollfd>& descriptors) const;
  void turn(Time now);

  /// Whether nothing is left of it.
  bool over() const;
  /// Whether it has not said yet what it wants.
  bool is_newcomer() const { return !order_ && !line_.is_closed(); }
  /// Whose component it is: runs of other computers may have the same number.
  std::string run() const;
  const std::string& stage() const;
  bool is_running() const { return child_ && child_->running(); }
  /// Closes the connection, so that the component ends in order.
  void leave(const std::string& why) { line_.close(why); }
  /// At once.
  void end(const std::string& why);

 private:
  void handle(Frame frame);
  void take_order(const Frame& frame);
  std::string fault_of_order() const;
  void refuse(const std::string& why);
  void start(Time now);
  void assign(const Frame& frame);
  void pass_on(Time now);
  void watch_child(Time now);
  void watch_connection(Time now);
  void tend_connection(Time now);
  void beat(Time now);
  /// `sense for desk (10.0.0.1:40312)`.
  std::string who() const;

  TlsLine line_;  ///< to the relay
  HostSurroundings& host_;
  std::string peer_address_;
  bool same_host_;
  Time connected_at_;
  std::optional<StartComponent> order_;
  std::shared_ptr<DomainLock> lock_;
  std::optional<ChildProcess> child_;
  std::optional<GroupGuard> guard_;  ///< ends it if this host is stopped
  std::unique_ptr<Link> link_;       ///< to the component
  std::vector<std::unique_ptr<MemoryFile>> files_;
  bool reads_ = true;  ///< what the relay sends: not while the component takes nothing
  bool realtime_ = false;
  bool assigned_ = false;
  bool told_ = false;  ///< the relay knows that the component has ended
  std::optional<Time> link_closed_at_;
  std::optional<Time> lost_at_;  ///< the relay
  Time beat_at_{};
};

}  // namespace clew::bridge
