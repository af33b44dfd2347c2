// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scratch_sweep.hpp"

namespace clew::sweep {
namespace {

using recording_test::write_bytes;
using sweep_test::ScratchSweep;

constexpr std::size_t kShards = 4;

/// A queue that works while the sweep waits, as a test tells it.
class FakeQueue : public JobQueue {
 public:
  explicit FakeQueue(const ScratchSweep& sweep) : sweep_(sweep) {}

  std::string name() const override { return "Fake"; }
  core::Result<std::size_t> cores() override { return std::size_t{2}; }
  core::Result<std::string> submit(const ArrayOrder& order) override {
    submitted.push_back(order.tasks);
    in_queue.clear();
    for (const std::size_t task : order.tasks) in_queue[task] = TaskState::kRunning;
    return std::to_string(submitted.size());
  }
  core::Result<std::map<std::size_t, TaskState>> tasks(const std::string& job) override {
    asked.push_back(job);
    if (failures > 0 && failures-- > 0) return core::Error{"does not answer", "fake"};
    return in_queue;
  }
  core::Result<void> cancel(const std::string& job) override {
    cancelled.push_back(job);
    return {};
  }

  /// All tasks do so many runs and end.
  void work(std::size_t runs) {
    for (const auto& [task, state] : in_queue) sweep_.run_more(task, kShards, runs);
    in_queue.clear();
  }

  std::vector<std::vector<std::size_t>> submitted;
  std::vector<std::string> asked;
  std::vector<std::string> cancelled;
  std::map<std::size_t, TaskState> in_queue;
  int failures = 0;

 private:
  const ScratchSweep& sweep_;
};

class SweepOfFourShards : public testing::Test {
 protected:
  /// Runs the sweep; `during` is called at each wait, and ends the sweep with false.
  core::Result<SweepEnd> run(const std::function<bool()>& during) {
    SweepOptions options;
    options.directory = sweep_.directory();
    options.program = "clew";
    options.shards = shards_;
    options.restart = restart_;
    options.wait = [&](double) { return during() && ++waits_ < 1000; };
    options.progress = [&](const SweepProgress& progress) { last_ = progress; };
    options.say = [&](const std::string& sentence) { said_.push_back(sentence); };
    return run_sweep(sweep_.plan, sweep_.order, options, queue_);
  }

  ScratchSweep sweep_;
  FakeQueue queue_{sweep_};
  std::size_t shards_ = kShards;
  bool restart_ = false;
  int waits_ = 0;
  SweepProgress last_;
  std::vector<std::string> said_;
};

TEST_F(SweepOfFourShards, EndsWithAllShardsInOrder) {
  const auto end = run([&] {
    queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_FALSE(end->is_cancelled);
  ASSERT_EQ(end->directories.size(), kShards);
  EXPECT_EQ(end->directories[1], sweep_.shard(2));
  EXPECT_EQ(queue_.submitted, (std::vector<std::vector<std::size_t>>{{1, 2, 3, 4}}));
  EXPECT_EQ(last_.done, sweep_.plan.runs());
  EXPECT_EQ(said_, (std::vector<std::string>{"Fake array 1: 4 of 4 shards"}));
  // A task runs world by world; the order is by graph first.
  const bench::RunOrder order(sweep_.plan);
  for (std::size_t number = 1; number <= kShards; ++number) {
    auto lines = bench::LineReader::open(sweep_.shard(number) + "/results.jsonl");
    ASSERT_TRUE(lines.ok());
    lines->next();
    std::vector<std::size_t> places;
    while (const std::string* line = lines->next()) {
      places.push_back(*order.index_of(*bench::read_run_key(*line)));
    }
    EXPECT_GT(places.size(), 3u);
    EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << number;
  }
}

TEST_F(SweepOfFourShards, SubmitsShardsAgainThatEndedEarly) {
  int round = 0;
  const auto end = run([&] {
    if (queue_.in_queue.empty()) return true;
    sweep_.run_more(3, kShards, 100);
    queue_.work(++round < 3 ? 2 : 100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(queue_.submitted,
            (std::vector<std::vector<std::size_t>>{{1, 2, 3, 4}, {1, 2, 4}, {1, 2, 4}}));
  EXPECT_EQ(said_.back(),
            "Fake array 3: 3 of 4 shards, which ended before they were whole; they go on from "
            "where they were");
}

TEST_F(SweepOfFourShards, GivesUpOnAShardThatDoesNotGetOn) {
  const auto end = run([&] {
    if (queue_.in_queue.empty()) return true;
    for (const std::size_t number : {1, 3, 4}) sweep_.run_more(number, kShards, 1);
    write_bytes(sweep_.shard(2) + ".log", "clew: no such suite\n");
    queue_.in_queue.clear();
    return true;
  });

  ASSERT_FALSE(end.ok());
  EXPECT_NE(end.error().text().find("2.log: shard 2/4 ended 3 times without another run; its log "
                                    "ends: clew: no such suite"),
            std::string::npos)
      << end.error().text();
  EXPECT_EQ(queue_.submitted.size(), 3u);
}

TEST_F(SweepOfFourShards, IsCancelledAndGoesOn) {
  const auto cancelled = run([&] {
    sweep_.run_more(1, kShards, 3);
    return false;
  });
  ASSERT_TRUE(cancelled.ok());
  EXPECT_TRUE(cancelled->is_cancelled);
  EXPECT_EQ(queue_.cancelled, (std::vector<std::string>{"1"}));
  EXPECT_EQ(said_.back(), "array 1 is cancelled; the same command goes on from where it was");

  queue_.in_queue.clear();
  const auto end = run([&] {
    queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(queue_.submitted.size(), 2u);
  EXPECT_EQ(last_.found, 3u);
}

TEST_F(SweepOfFourShards, TakesUpAnArrayThatIsStillInTheQueue) {
  ASSERT_TRUE(run([] { return false; }).ok());
  shards_ = 0;  // as many as it was begun with

  const auto end = run([&] {
    queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(queue_.submitted.size(), 1u);
  EXPECT_EQ(said_.back(), "array 1 is still in the queue: going on with it");
}

TEST_F(SweepOfFourShards, BearsAQueueThatDoesNotAnswerForAWhile) {
  const auto end = run([&] {
    if (waits_ == 0) queue_.failures = 40;
    if (queue_.failures == 0) queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(queue_.submitted.size(), 1u);
}

TEST_F(SweepOfFourShards, EndsWithAQueueThatDoesNotAnswerAnyMore) {
  const auto end = run([&] {
    queue_.failures = 1;
    return true;
  });

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().text(),
            "fake: does not answer; array 1 goes on without this command, and the same command "
            "goes on with it");
  EXPECT_TRUE(queue_.cancelled.empty());
}

TEST_F(SweepOfFourShards, DoesNotAskTheQueueAllTheTime) {
  const auto end = run([&] {
    if (waits_ == 99) queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok());
  // Every fifth second, and once more when all runs are there.
  EXPECT_LE(queue_.asked.size(), 21u);
}

TEST_F(SweepOfFourShards, HasTwoShardsACoreIfNotToldOtherwise) {
  shards_ = 0;
  const auto end = run([&] {
    queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(queue_.submitted.front().size(), 4u);
  EXPECT_EQ(default_shards(sweep_.plan, 8, 4), 4u);
  EXPECT_EQ(default_shards(sweep_.plan, 1, 4), 2u);
  EXPECT_EQ(default_shards(sweep_.plan, 1000, 1), sweep_.plan.runs());
}

TEST_F(SweepOfFourShards, BeginsAgainWhenAsked) {
  ASSERT_TRUE(run([&] {
                queue_.work(2);
                return false;
              }).ok());
  shards_ = 2;
  ASSERT_FALSE(run([] { return true; }).ok());
  shards_ = kShards;
  restart_ = true;
  const auto end = run([&] {
    queue_.work(100);
    return true;
  });

  ASSERT_TRUE(end.ok()) << end.error().text();
  EXPECT_EQ(last_.found, 0u);
}

}  // namespace
}  // namespace clew::sweep
