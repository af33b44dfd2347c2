// SPDX-License-Identifier: Apache-2.0
#include "core/process_end.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace clew::core {
namespace {

void ends_the_test() { ::_exit(9); }

TEST(ProcessEnd, OfAChildRunsNothingOfItsParentsExit) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::atexit(ends_the_test);
    end_at_once(3);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);

  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST(ProcessEndDeathTest, OfAMistakeIsAnAbort) {
  EXPECT_EXIT(abort_process(), testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace clew::core
