// SPDX-License-Identifier: Apache-2.0
#include "supervisor/group_guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <utility>

#include "core/process_end.hpp"

namespace clew::bridge {
namespace {

/// Whether the parent is there, and has not been silent for so long; -1: it may be.
bool hears(int patience_ms) {
  pollfd pipe{STDIN_FILENO, POLLIN, 0};
  const int ready = ::poll(&pipe, 1, patience_ms);
  if (ready < 0) return errno == EINTR;
  char bytes[64];
  if (ready == 0) return false;
  const ssize_t got = ::read(STDIN_FILENO, bytes, sizeof bytes);
  // At the end of the pipe errno is that of an earlier call.
  return got > 0 || (got < 0 && errno == EINTR);
}

// Runs in the child, without exec: only calls that are safe there. It must hold nothing of its
// parent's that others wait for to be closed.
[[noreturn]] void stand_guard(int pipe, int group, int patience_ms) {
  ::dup2(pipe, STDIN_FILENO);
  ::close_range(STDIN_FILENO + 1, UINT_MAX, 0);
  // Out of reach of a Ctrl-C, which the parent answers by ending in order.
  ::setpgid(0, 0);
  while (hears(patience_ms)) {
  }
  ::kill(-group, SIGKILL);
  core::end_at_once(0);
}

}  // namespace

std::optional<GroupGuard> GroupGuard::start(int group,
                                            std::optional<std::chrono::milliseconds> patience) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  const int guard = ::fork();
  if (guard == 0) {
    ::close(ends[1]);
    stand_guard(ends[0], group, patience ? static_cast<int>(patience->count()) : -1);
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

void GroupGuard::beat() {
  const char beat = 0;
  // If the pipe is full, the guard has enough to read.
  if (::write(pipe_, &beat, 1) < 0) return;
}

GroupGuard::~GroupGuard() {
  if (process_id_ == 0) return;
  ::kill(process_id_, SIGKILL);
  ::waitpid(process_id_, nullptr, 0);
  ::close(pipe_);
}

}  // namespace clew::bridge
