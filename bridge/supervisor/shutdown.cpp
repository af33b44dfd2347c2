// SPDX-License-Identifier: Apache-2.0
#include "supervisor/shutdown.hpp"

#include <poll.h>

#include <csignal>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

// Whether every process has ended in time.
bool ended_by(std::vector<Member>& members, std::chrono::steady_clock::time_point deadline) {
  while (true) {
    bool running = false;
    for (Member& member : members) {
      if (!member.child) continue;
      member.child->reap();
      running = running || member.child->running();
    }
    if (!running) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
    ::poll(nullptr, 0, 1);
  }
}

}  // namespace

void end_processes(std::vector<Member>& members, bool orderly) {
  for (Member& member : members) {
    member.link.reset();
    if (member.child && (member.third_party || !orderly)) member.child->signal(SIGTERM);
  }
  if (ended_by(members, std::chrono::steady_clock::now() + kEndGrace)) return;
  for (Member& member : members) {
    if (member.child) member.child->signal(SIGKILL);
  }
  ended_by(members, std::chrono::steady_clock::now() + kEndGrace);
}

}  // namespace clew::bridge
