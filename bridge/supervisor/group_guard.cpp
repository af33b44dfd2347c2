// SPDX-License-Identifier: Apache-2.0
#include "supervisor/group_guard.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <utility>

#include "core/process_end.hpp"

namespace clew::bridge {
namespace {

// Runs in the child, without exec: only calls that are safe there. It must hold nothing of its
// parent's that others wait for to be closed.
[[noreturn]] void stand_guard(int pipe, int group) {
  ::dup2(pipe, STDIN_FILENO);
  ::close_range(STDIN_FILENO + 1, UINT_MAX, 0);
  // Out of reach of a Ctrl-C, which the parent answers by ending in order.
  ::setpgid(0, 0);
  char byte = 0;
  while (::read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
  }
  ::kill(-group, SIGKILL);
  core::end_at_once(0);
}

}  // namespace

std::optional<GroupGuard> GroupGuard::start(int group) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const int guard = ::fork();
  if (guard == 0) {
    ::close(ends[1]);
    stand_guard(ends[0], group);
  }
  ::close(ends[0]);
  if (guard < 0) {
    ::close(ends[1]);
    return std::nullopt;
  }
  return GroupGuard(guard, ends[1]);
}

GroupGuard::GroupGuard(GroupGuard&& other) noexcept
    : process_id_(std::exchange(other.process_id_, 0)), pipe_(other.pipe_) {}

GroupGuard& GroupGuard::operator=(GroupGuard&& other) noexcept {
  std::swap(process_id_, other.process_id_);
  std::swap(pipe_, other.pipe_);
  return *this;
}

GroupGuard::~GroupGuard() {
  if (process_id_ == 0) return;
  ::kill(process_id_, SIGKILL);
  ::waitpid(process_id_, nullptr, 0);
  ::close(pipe_);
}

}  // namespace clew::bridge
