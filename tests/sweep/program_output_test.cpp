// SPDX-License-Identifier: Apache-2.0
#include "sweep/program_output.hpp"

#include <gtest/gtest.h>

namespace clew::sweep {
namespace {

TEST(ProgramOutput, HasWhatAProgramWritesAndItsStatus) {
  const auto output = run_program({"sh", "-c", "echo out; echo err >&2; exit 7"});

  ASSERT_TRUE(output.ok()) << output.error().text();
  EXPECT_EQ(output->out, "out\n");
  EXPECT_EQ(output->err, "err\n");
  EXPECT_EQ(output->status, 7);
}

TEST(ProgramOutput, TellsASignal) {
  const auto output = run_program({"sh", "-c", "kill -KILL $$"});

  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output->status, 128 + 9);
}

TEST(ProgramOutput, TakesMoreThanAPipeHolds) {
  const auto output = run_program({"sh", "-c", "head -c 300000 /dev/zero; echo"});

  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output->out.size(), 300001u);
}

TEST(ProgramOutput, RefusesAProgramThatIsNotThere) {
  const auto output = run_program({"no-such-program"});

  ASSERT_FALSE(output.ok());
  EXPECT_EQ(output.error().text(), "no-such-program: cannot be started: No such file or directory");
}

}  // namespace
}  // namespace clew::sweep
