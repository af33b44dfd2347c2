// SPDX-License-Identifier: Apache-2.0
#include "bench/merge.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../recording/scratch_directory.hpp"
#include "bench/run_order.hpp"

namespace clew::bench {
namespace {

using recording_test::read_bytes;
using recording_test::ScratchDirectory;
using recording_test::write_bytes;

/// Two variants in five worlds with three seeds, in shards that say of each run which it is.
class MergeOfShards : public testing::Test {
 protected:
  MergeOfShards() {
    plan_.suite = "test";
    plan_.seeds = {1, 2, 3};
    for (const char* world : {"a", "b", "c", "d", "e"}) plan_.worlds.push_back({"f", world, {}});
    plan_.variants = {{"g", {}, {}}, {"h", {}, {}}};
    plan_.configuration = {{"suite", "test"}, {"max_ticks", "100"}};
    std::filesystem::create_directory(whole());
  }

  std::string whole() const { return scratch_.file("whole"); }
  std::string shard(std::size_t number) const { return scratch_.file(std::to_string(number)); }
  std::string results(std::size_t number) const { return shard(number) + "/results.jsonl"; }

  static std::string line_of(const RunKey& key) {
    return fmt::format(R"({{"graph":"{}","variant":"{}","world":"{}","seed":{}}})", key.graph,
                       key.variant, key.world, key.seed) +
           '\n';
  }

  /// The lines of the runs of which `is_wanted` holds, in order.
  template <typename Condition>
  std::string lines(const Condition& is_wanted) const {
    const RunOrder order(plan_);
    std::string text;
    for (std::size_t index = 0; index < order.size(); ++index) {
      if (is_wanted(index)) text += line_of(order.key_of(index));
    }
    return text;
  }

  std::string lines_of_shard(std::size_t number, std::size_t count) const {
    const Shards dealt(plan_, count);
    const RunOrder order(plan_);
    return lines([&](std::size_t index) {
      const auto [world, run] = order.in_world(index);
      return dealt.of(world, run) == number;
    });
  }

  /// A directory named for its number, whatever it says it is.
  void write_shard(std::size_t number, std::size_t count, Configuration changes = {}) const {
    ResultsHeader header{{"test", {}, {}, {}, {}, {}}, plan_.configuration};
    header.configuration[kShardKey] = Shard{number, count}.text();
    for (const auto& [key, value] : changes) header.configuration[key] = value;
    std::filesystem::create_directory(shard(number));
    const std::string text = lines_of_shard(number, count);
    write_bytes(results(number), header.text() + '\n' + text);
    write_bytes(shard(number) + "/timing.jsonl", text);
  }

  std::vector<std::string> write_shards(std::size_t count) const {
    std::vector<std::string> directories;
    for (std::size_t number = 1; number <= count; ++number) {
      write_shard(number, count);
      directories.insert(directories.begin(), shard(number));
    }
    return directories;
  }

  core::Result<void> merge(const std::vector<std::string>& directories) const {
    const auto shards = read_shards(directories);
    if (!shards.ok()) return shards.error();
    return merge_lines(plan_, {shards->front().header.order, plan_.configuration}, *shards,
                       whole());
  }

  void expect_refused(const std::vector<std::string>& directories, const std::string& text) const {
    const auto merged = merge(directories);
    ASSERT_FALSE(merged.ok());
    EXPECT_NE(merged.error().text().find(text), std::string::npos) << merged.error().text();
    EXPECT_TRUE(std::filesystem::is_empty(whole()));
  }

  BenchPlan plan_;
  ScratchDirectory scratch_;
};

TEST_F(MergeOfShards, IsTheWholeInOrder) {
  const std::string all = lines([](std::size_t) { return true; });
  for (const std::size_t count : {1u, 2u, 3u, 7u, 40u}) {
    const auto merged = merge(write_shards(count));

    ASSERT_TRUE(merged.ok()) << merged.error().text();
    const std::string text = read_bytes(whole() + "/results.jsonl");
    EXPECT_EQ(text.substr(text.find('\n') + 1), all);
    EXPECT_EQ(text.find("shard"), std::string::npos);
    EXPECT_EQ(read_bytes(whole() + "/timing.jsonl"), all);
    for (std::size_t number = 1; number <= count; ++number) {
      std::filesystem::remove_all(shard(number));
    }
  }
}

TEST_F(MergeOfShards, DoesWithoutTiming) {
  const auto directories = write_shards(2);
  write_bytes(shard(2) + "/timing.jsonl", "torn");

  ASSERT_TRUE(merge(directories).ok());

  EXPECT_EQ(read_bytes(whole() + "/timing.jsonl"), lines_of_shard(1, 2));
}

TEST_F(MergeOfShards, RefusesWhatIsNoShard) {
  auto directories = write_shards(2);
  expect_refused({shard(1), scratch_.file("none")}, "none/results.jsonl: cannot be read: No such");
  write_bytes(results(2), "");
  expect_refused(directories, "2/results.jsonl:1: is no file of results");
  write_bytes(results(2), ResultsHeader{{}, plan_.configuration}.text() + '\n');
  expect_refused(directories, "is no shard: it was made without --shard");
  write_shard(2, 2, {{kShardKey, "3/2"}});
  expect_refused(directories, "2/results.jsonl:1: found '3/2'; expected I/N");
}

TEST_F(MergeOfShards, RefusesShardsOfDifferentBenches) {
  const auto directories = write_shards(3);
  write_shard(2, 4);
  expect_refused(directories, "2: is shard 2/4, but " + shard(3) + " is shard 3/3");
  write_shard(2, 3, {{"max_ticks", "200"}});
  expect_refused(directories, "is a shard of another bench than " + shard(3) +
                                  ": it was made with 'max_ticks' 100, now it is 200, there");
}

TEST_F(MergeOfShards, RefusesMissingAndRepeatedShards) {
  auto directories = write_shards(5);
  expect_refused({directories[0], directories[2]}, "2 of 5 shards are there; missing: 1 2 4");
  directories.push_back(shard(4));
  expect_refused(directories, "4: is shard 4/5, and so is " + shard(4));
}

TEST_F(MergeOfShards, RefusesAShardThatIsNotWhole) {
  const auto directories = write_shards(2);
  const std::string text = read_bytes(results(2));
  // Its last run is not there.
  write_bytes(results(2), text.substr(0, text.rfind("{")));

  expect_refused(directories, "shard 2/2 is not whole: h in e, seed 3 is missing; go on with it");
}

TEST_F(MergeOfShards, RefusesRunsThatAreOutOfPlace) {
  const auto directories = write_shards(2);
  const std::string text = read_bytes(results(1));
  const std::size_t first = text.find('\n') + 1;
  const std::string head = text.substr(0, first);
  const std::string rest = text.substr(first);
  const std::string line = rest.substr(0, rest.find('\n') + 1);

  write_bytes(results(1), head + line + rest);
  expect_refused(directories, "1/results.jsonl:3: found g in a, seed 1, expected g in");
  write_bytes(results(1), head + line_of({"g", "", "z", 1}) + rest);
  expect_refused(directories, "1/results.jsonl:2: g in z, seed 1 is no run of this bench");
  const std::string other = lines_of_shard(2, 2);
  write_bytes(results(1), head + other.substr(0, other.find('\n') + 1) + rest);
  expect_refused(directories, "is a run of shard 2/2, this is shard 1/2");
  write_bytes(results(1), text + line);
  expect_refused(directories, "there is more than the runs of shard 1/2");
  write_bytes(results(1), head + "{}\n" + rest);
  expect_refused(directories, "1/results.jsonl:2: is no line of results");
}

}  // namespace
}  // namespace clew::bench
