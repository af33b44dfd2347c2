// SPDX-License-Identifier: Apache-2.0
#include "bench/worker_pool.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <numeric>
#include <set>

namespace clew::bench {
namespace {

std::vector<std::size_t> units(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

struct Collected {
  std::multiset<std::string> lines;
  PoolOptions options;

  explicit Collected(std::size_t workers) {
    options.workers = workers;
    options.on_line = [this](const std::string& line) -> core::Result<void> {
      lines.insert(line);
      return {};
    };
  }
};

TEST(WorkerPool, DoesEveryUnitOnceHoweverManyWorkers) {
  const Work work = [](std::size_t unit, const Emit& emit) -> core::Result<void> {
    // Lines longer than a pipe's buffer arrive whole as well.
    emit(std::to_string(unit) + std::string(unit * 20'000, 'x'));
    emit("second of " + std::to_string(unit));
    return {};
  };
  Collected one(1);
  const auto end = run_in_workers(units(20), work, one.options);
  ASSERT_TRUE(end.ok()) << end.error().text();
  ASSERT_EQ(one.lines.size(), 40u);

  for (const std::size_t workers : {2u, 5u, 40u}) {
    Collected many(workers);
    ASSERT_TRUE(run_in_workers(units(20), work, many.options).ok());
    EXPECT_EQ(many.lines, one.lines) << workers;
  }
}

TEST(WorkerPool, WithoutUnitsThereIsNothingToDo) {
  Collected none(3);
  const Work work = [](std::size_t, const Emit&) -> core::Result<void> { return {}; };

  EXPECT_TRUE(run_in_workers({}, work, none.options).ok());
  EXPECT_TRUE(none.lines.empty());
}

TEST(WorkerPool, PassesOnTheErrorOfAUnit) {
  Collected some(2);
  const Work work = [](std::size_t unit, const Emit&) -> core::Result<void> {
    if (unit == 3) return core::Error{"unit 3 is bad", "file.yaml", 7, 0};
    return {};
  };

  const auto end = run_in_workers(units(5), work, some.options);

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().text(), "file.yaml:7: unit 3 is bad");
}

TEST(WorkerPool, TellsOfAWorkerThatDied) {
  Collected some(2);
  const Work work = [](std::size_t unit, const Emit&) -> core::Result<void> {
    if (unit == 1) ::raise(SIGKILL);
    return {};
  };

  const auto end = run_in_workers(units(5), work, some.options);

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().text(), "a worker process died");
}

TEST(WorkerPool, EndsOnASignal) {
  Collected some(2);
  some.options.on_line = [](const std::string&) -> core::Result<void> {
    ::raise(SIGTERM);
    return {};
  };
  const Work work = [](std::size_t, const Emit& emit) -> core::Result<void> {
    while (emit("again")) {
    }
    return {};
  };

  const auto end = run_in_workers(units(2), work, some.options);

  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end->interrupted_by, SIGTERM);
}

}  // namespace
}  // namespace clew::bench
