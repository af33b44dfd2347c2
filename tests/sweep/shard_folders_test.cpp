// SPDX-License-Identifier: Apache-2.0
#include "sweep/shard_folders.hpp"

#include <gtest/gtest.h>

#include "scratch_sweep.hpp"

namespace clew::sweep {
namespace {

using recording_test::read_bytes;
using recording_test::write_bytes;
using sweep_test::ScratchSweep;

ShardFolders open(const ScratchSweep& sweep, std::size_t count) {
  auto folders = ShardFolders::open(sweep.directory(), sweep.plan, sweep.order, count);
  EXPECT_TRUE(folders.ok()) << folders.error().text();
  return std::move(folders).value();
}

TEST(ShardFolders, CountTheRunsOfEachShard) {
  const ScratchSweep sweep;
  ShardFolders folders = open(sweep, 4);
  std::size_t runs = 0;
  for (std::size_t number = 1; number <= 4; ++number) runs += folders.runs(number);
  EXPECT_EQ(runs, sweep.plan.runs());
  EXPECT_EQ(folders.done(2), 0u);

  sweep.run_more(2, 4, 3);
  EXPECT_EQ(folders.done(2), 3u);
  EXPECT_FALSE(folders.is_whole(2));
  sweep.run_more(2, 4, 100);
  EXPECT_TRUE(folders.is_whole(2));
  EXPECT_EQ(folders.done(2), folders.runs(2));
  // Begun again.
  write_bytes(sweep.shard(2) + "/results.jsonl", "{}\n{}\n");
  EXPECT_EQ(folders.done(2), 1u);
}

TEST(ShardFolders, AreTakenUpAgain) {
  const ScratchSweep sweep;
  EXPECT_EQ(*ShardFolders::count_in(sweep.directory()), 0u);
  ASSERT_TRUE(open(sweep, 4).note_job("17").ok());

  EXPECT_EQ(*ShardFolders::count_in(sweep.directory()), 4u);
  EXPECT_EQ(open(sweep, 4).job(), "17");
}

TEST(ShardFolders, RefuseAnotherBenchAndAnotherNumberOfShards) {
  ScratchSweep sweep;
  open(sweep, 4);

  const auto other = ShardFolders::open(sweep.directory(), sweep.plan, sweep.order, 5);
  ASSERT_FALSE(other.ok());
  EXPECT_NE(other.error().text().find("made with 'shards' 4, now it is 5"), std::string::npos);
  sweep.plan.configuration["seeds"] = "7";
  const auto foreign = ShardFolders::open(sweep.directory(), sweep.plan, sweep.order, 4);
  ASSERT_FALSE(foreign.ok());
  EXPECT_NE(foreign.error().text().find("'seeds' is new"), std::string::npos);
  write_bytes(sweep.directory() + "/shards/sweep.jsonl", "{}\n");
  EXPECT_FALSE(ShardFolders::count_in(sweep.directory()).ok());
}

TEST(ShardFolders, QuoteTheWordsOfAScript) {
  ScratchSweep sweep;
  sweep.order.suite = "it's $HOME";
  const ShardFolders folders = open(sweep, 4);

  ASSERT_TRUE(folders.write_script("/opt/my clew", sweep.order, 2).ok());

  const std::string script = read_bytes(folders.script());
  EXPECT_NE(script.find("exec '/opt/my clew' bench 'it'\\''s $HOME' --shard "
                        "\"$SLURM_ARRAY_TASK_ID/4\" --jobs 2 --out "),
            std::string::npos)
      << script;
}

TEST(ShardFolders, KnowTheLastWordsOfALog) {
  const ScratchSweep sweep;
  const ShardFolders folders = open(sweep, 4);
  EXPECT_EQ(folders.last_words(3), "");

  write_bytes(sweep.shard(3) + ".log", "one\ntwo\n\n");

  EXPECT_EQ(folders.last_words(3), "two");
}

}  // namespace
}  // namespace clew::sweep
