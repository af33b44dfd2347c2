// SPDX-License-Identifier: Apache-2.0
#include "run/program_start.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <string>

namespace clew::bridge {
namespace {

std::string text_of(int file) {
  char buffer[256];
  const ssize_t size = ::pread(file, buffer, sizeof buffer, 0);
  return {buffer, static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

class ProgramStart : public testing::Test {
 protected:
  ~ProgramStart() override {
    ::close(out_);
    ::close(err_);
  }

  int out_ = ::memfd_create("out", MFD_CLOEXEC);
  int err_ = ::memfd_create("err", MFD_CLOEXEC);
  pid_t process_ = 0;
};

TEST_F(ProgramStart, GivesItNoInputAndTakesItsOutput) {
  ASSERT_EQ(
      start_program({"sh", "-c", "cat; echo one; echo two >&2; exit 3"}, out_, err_, process_), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(process_, &status, 0), process_);

  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(text_of(out_), "one\n");
  EXPECT_EQ(text_of(err_), "two\n");
}

TEST_F(ProgramStart, MakesAGroupSoThatAllOfItCanBeEnded) {
  ASSERT_EQ(start_program({"sh", "-c", "sleep 600"}, out_, err_, process_), 0);
  EXPECT_EQ(::getpgid(process_), process_);
  EXPECT_EQ(::kill(-process_, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(process_, &status, 0), process_);

  EXPECT_TRUE(WIFSIGNALED(status));
}

TEST_F(ProgramStart, SaysWhyItCannot) {
  EXPECT_EQ(start_program({"/no/such/program"}, out_, err_, process_), ENOENT);
}

}  // namespace
}  // namespace clew::bridge
