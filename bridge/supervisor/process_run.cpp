// SPDX-License-Identifier: Apache-2.0
#include "supervisor/process_run.hpp"

#include <poll.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "line/acceptor.hpp"
#include "line/domain_lock.hpp"
#include "log/log.hpp"
#include "run/end_signals.hpp"
#include "run/limits.hpp"
#include "supervisor/run_participants.hpp"
#include "supervisor/supervisor.hpp"
#include "supervisor/watchers.hpp"
#include "vendors/loopback.hpp"
#include "vendors/network_addresses.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// Where processes come in.
struct Doors {
  Acceptor acceptor;
  Watchers watchers;
};

/// Until a line, a newcomer or a signal has something to say, or something may be due.
void wait_for_something(const Supervisor& supervisor, const Doors& doors,
                        const EndSignals& signals) {
  std::vector<pollfd> descriptors = supervisor.descriptors();
  doors.watchers.add_descriptors(descriptors);
  descriptors.push_back({signals.descriptor(), POLLIN, 0});
  for (const int socket : doors.acceptor.sockets()) descriptors.push_back({socket, POLLIN, 0});
  ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kPollPeriod.count()));
}

void take_arrivals(Supervisor& supervisor, Doors& doors) {
  const auto now = Clock::now();
  for (auto& [link, hello] : doors.acceptor.arrivals(now)) {
    if (hello.stage == kWatcherName) {
      doors.watchers.welcome(std::move(link), hello, supervisor.description());
    } else {
      supervisor.welcome(std::move(link), hello, now);
    }
  }
  for (const std::string& who : doors.acceptor.take_refusals()) supervisor.note_refused(who);
  doors.watchers.turn();
}

/// The identities that the layout asks for, or else the graph; null if neither does.
core::Result<RunSecurity::Shared> security_of(const runtime::Graph& graph,
                                              const ProcessLayout& layout) {
  auto directory = layout.security ? layout.security : graph.security;
  // What leaves the host is protected, asked for or not.
  if (!directory && layout.hosts) directory.emplace();
  if (!directory) return RunSecurity::Shared();
  const auto participants = run_participants(graph, layout);
  return directory->empty() ? RunSecurity::mint(participants)
                            : RunSecurity::read(*directory, participants);
}

}  // namespace

core::Result<RunReport> run_processes(const runtime::RunPlan& plan, const ProcessLayout& layout,
                                      const std::optional<RecordingOrder>& recording,
                                      const ProgressDisplay& display, const ProcessStart& start,
                                      RunControl* control) {
  CLEW_RETURN_IF_ERROR(check_loopback());
  if (layout.hosts) {
    if (const auto own = network_of(layout.hosts->addresses); !own.ok()) return own.error();
  }
  const auto lock = DomainLock::take(layout.domain);
  if (!lock.ok()) return lock.error();
  std::optional<RunName> name;
  std::vector<int> listening = {lock->socket()};
  if (!layout.name.empty()) {
    auto taken = RunName::take(layout.name);
    if (!taken.ok()) return taken.error();
    name.emplace(std::move(taken).value());
    listening.push_back(name->socket());
  }
  if (control != nullptr) {
    control->set_called(name ? layout.name : std::to_string(lock->domain()));
  }
  const auto security = security_of(plan.graph, layout);
  if (!security.ok()) return security.error();
  Doors doors{Acceptor(listening), {}};
  EndSignals signals;  // before any thread of a vendor's
  const auto say = [&doors](logs::Level level, const std::string& line) {
    logs::tell(level, line);
    doors.watchers.tell(line);
  };
  Supervisor supervisor(plan, layout, lock->domain(), recording, start,
                        {say, display, ChildProcess::start, activity_of, control, *security},
                        Clock::now());
  supervisor.start();
  while (!supervisor.over()) {
    wait_for_something(supervisor, doors, signals);
    if (const int number = signals.take()) supervisor.interrupt(number, Clock::now());
    take_arrivals(supervisor, doors);
    supervisor.turn(Clock::now());
  }
  supervisor.end_members();
  // The recorder may still die and come back. A second signal ends the patience with it.
  while (!supervisor.recording_ended() && signals.take() == 0) {
    wait_for_something(supervisor, doors, signals);
    take_arrivals(supervisor, doors);
    supervisor.turn_recording(Clock::now());
  }
  RunReport report = supervisor.finish(Clock::now());
  report.secured = *security != nullptr;
  return report;
}

}  // namespace clew::bridge
