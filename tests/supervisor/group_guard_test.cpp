// SPDX-License-Identifier: Apache-2.0
#include "supervisor/group_guard.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "core/process_end.hpp"
#include "sleeping_process.hpp"

namespace clew::bridge {
namespace {

/// Lets a process make a guard of the group and end without a word.
void leave_guarded(int group) {
  const int parent = ::fork();
  if (parent == 0) {
    errno = EINTR;  // as an interrupted call leaves it: the guard's process inherits it
    const auto guard = GroupGuard::start(group);
    core::end_at_once(guard ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(parent, &status, 0), parent);
  ASSERT_EQ(status, 0);
}

bool ends_within_s(ChildProcess& process, int seconds) {
  for (int i = 0; i < 100 * seconds && !process.reap(); ++i) ::poll(nullptr, 0, 10);
  return !process.running();
}

TEST(GroupGuard, EndsTheGroupWhenItsParentHasEnded) {
  auto started = start_sleeping({});
  ASSERT_TRUE(started.ok()) << started.error().text();
  ChildProcess sleeping = std::move(started).value();

  leave_guarded(sleeping.process_id());

  EXPECT_TRUE(ends_within_s(sleeping, 20));
  EXPECT_TRUE(sleeping.was_killed());
  if (sleeping.running()) end_now(sleeping);
}

TEST(GroupGuard, EndsTheGroupWhenItsParentSaysNothing) {
  auto started = start_sleeping({});
  ASSERT_TRUE(started.ok()) << started.error().text();
  ChildProcess sleeping = std::move(started).value();

  const auto guard = GroupGuard::start(sleeping.process_id(), std::chrono::milliseconds(20));

  ASSERT_TRUE(guard.has_value());
  EXPECT_TRUE(ends_within_s(sleeping, 20));
  if (sleeping.running()) end_now(sleeping);
}

}  // namespace
}  // namespace clew::bridge
