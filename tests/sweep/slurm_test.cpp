// SPDX-License-Identifier: Apache-2.0
#include "sweep/slurm.hpp"

#include <gtest/gtest.h>

namespace clew::sweep {
namespace {

TEST(Slurm, NamesTasksByRanges) {
  EXPECT_EQ(array_text({1, 2, 3, 5}), "1-3,5");
  EXPECT_EQ(array_text({4}), "4");
  EXPECT_EQ(array_text({1, 3, 4, 8, 9, 10}), "1,3-4,8-10");
}

TEST(Slurm, TellsTasksThatWaitFromThoseThatRun) {
  const auto tasks = read_tasks("6|PD\n7|PD\n  3|R\n1|CG\n12|S\n");

  ASSERT_TRUE(tasks.ok());
  // A completing one has ended.
  EXPECT_EQ(*tasks, (std::map<std::size_t, TaskState>{{3, TaskState::kRunning},
                                                      {6, TaskState::kWaiting},
                                                      {7, TaskState::kWaiting},
                                                      {12, TaskState::kWaiting}}));
  EXPECT_TRUE(read_tasks("")->empty());
}

TEST(Slurm, RefusesTasksThatAreNone) {
  const auto tasks = read_tasks("N/A|R\n");

  ASSERT_FALSE(tasks.ok());
  EXPECT_EQ(tasks.error().text(), "squeue: found 'N/A'; expected a number in what it printed");
}

TEST(Slurm, CountsTheCoresThatAreUpInTheDefaultPartition) {
  EXPECT_EQ(*read_cores("all*|2/10/4/16\nsmall|0/8/0/8\n"), 12u);
  EXPECT_EQ(*read_cores("small|1/7/0/8\n"), 8u);
  EXPECT_EQ(*read_cores("a|0/4/0/4\nb|0/2/0/2\n"), 6u);
  EXPECT_EQ(*read_cores(""), 0u);
  EXPECT_FALSE(read_cores("all*|many\n").ok());
}

}  // namespace
}  // namespace clew::sweep
