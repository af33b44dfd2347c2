// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/bench.hpp"
#include "bench/shards.hpp"
#include "sweep/shard_folders.hpp"

namespace clew::sweep {

using core::Error;
using core::Result;

namespace {

constexpr double kWait_s = 1.0;        // between two looks at the files
constexpr double kShortWait_s = 0.25;  // when all runs are there and the tasks are about to end
constexpr int kLooksApart = 5;         // looks at the files for one at the queue: queues are shared
constexpr int kMostFailures = 60;      // of the queue to answer, in a row
constexpr int kMostAttempts = 3;       // to get a shard on

class Sweep {
 public:
  Sweep(const bench::BenchPlan& plan, const bench::BenchOrder& order, const SweepOptions& options,
        JobQueue& queue, ShardFolders folders)
      : plan_(plan),
        order_(order),
        options_(options),
        queue_(queue),
        folders_(std::move(folders)),
        attempts_(folders_.count()) {}

  Result<SweepEnd> run() {
    progress_.total = plan_.runs();
    progress_.found = count();
    CLEW_RETURN_IF_ERROR(folders_.write_script(options_.program, order_, options_.cores));
    CLEW_RETURN_IF_ERROR(take_up());
    while (true) {
      const std::vector<std::size_t> open = open_shards();
      if (job_.empty() && open.empty()) return finish();
      if (job_.empty()) CLEW_RETURN_IF_ERROR(submit(open));
      if (!options_.wait(open.empty() ? kShortWait_s : kWait_s)) return cancel();
      if (open.empty() || ++waits_ % kLooksApart == 0) CLEW_RETURN_IF_ERROR(look());
      progress_.done = count();
      options_.progress(progress_);
    }
  }

 private:
  /// How often a shard was submitted without a new run.
  struct Attempts {
    std::size_t done = 0;
    int count = 0;
  };

  std::size_t count() {
    std::size_t done = 0;
    for (std::size_t number = 1; number <= folders_.count(); ++number) {
      done += folders_.done(number);
    }
    return done;
  }

  std::vector<std::size_t> open_shards() {
    std::vector<std::size_t> open;
    for (std::size_t number = 1; number <= folders_.count(); ++number) {
      if (!folders_.is_whole(number)) open.push_back(number);
    }
    return open;
  }

  /// Goes on with the array that a command before this one has left in the queue.
  Result<void> take_up() {
    const std::string job = folders_.job();
    if (job.empty()) return {};
    const auto tasks = queue_.tasks(job);
    if (!tasks.ok()) return tasks.error();
    if (tasks->empty()) return {};
    job_ = job;
    note(*tasks);
    options_.say(fmt::format("array {} is still in the queue: going on with it", job));
    return {};
  }

  Result<void> submit(const std::vector<std::size_t>& open) {
    for (const std::size_t number : open) {
      Attempts& attempts = attempts_[number - 1];
      const std::size_t done = folders_.done(number);
      attempts.count = done > attempts.done ? 1 : attempts.count + 1;
      attempts.done = done;
      if (attempts.count > kMostAttempts) return gave_up(number);
    }
    const bool is_again = submissions_++ > 0;
    const auto job =
        queue_.submit({"clew-" + std::filesystem::path(plan_.suite).stem().string(),
                       folders_.script(), folders_.log_pattern(), open, options_.cores});
    if (!job.ok()) return job.error();
    job_ = *job;
    progress_.waiting = open.size();
    progress_.running = 0;
    options_.say(fmt::format("{} array {}: {} of {} shards{}", queue_.name(), job_, open.size(),
                             folders_.count(),
                             is_again ? ", which ended before they were whole; they go on from "
                                        "where they were"
                                      : ""));
    return folders_.note_job(job_);
  }

  Error gave_up(std::size_t number) const {
    const std::string words = folders_.last_words(number);
    return {
        fmt::format("shard {}/{} ended {} times without another run; its log {}", number,
                    folders_.count(), kMostAttempts, words.empty() ? "is empty" : "ends: " + words),
        folders_.shard(number) + ".log"};
  }

  /// Looks what is still in the queue. It may not answer for a while.
  Result<void> look() {
    const auto tasks = queue_.tasks(job_);
    if (tasks.ok()) {
      failures_ = 0;
      note(*tasks);
      if (tasks->empty()) job_.clear();
      return {};
    }
    if (++failures_ < kMostFailures) return {};
    return Error{fmt::format("{}; array {} goes on without this command, and the same command "
                             "goes on with it",
                             tasks.error().message, job_),
                 tasks.error().file};
  }

  void note(const std::map<std::size_t, TaskState>& tasks) {
    progress_.running =
        static_cast<std::size_t>(std::count_if(tasks.begin(), tasks.end(), [](const auto& task) {
          return task.second == TaskState::kRunning;
        }));
    progress_.waiting = tasks.size() - progress_.running;
  }

  /// The id stays noted: tasks take some time to end, and a sweep that goes on waits for that.
  Result<SweepEnd> cancel() {
    const auto cancelled = queue_.cancel(job_);
    if (!cancelled.ok()) return cancelled.error();
    options_.say(
        fmt::format("array {} is cancelled; the same command goes on from where it was", job_));
    return SweepEnd{true, {}};
  }

  Result<SweepEnd> finish() {
    SweepEnd end;
    for (std::size_t number = 1; number <= folders_.count(); ++number) {
      // A task may have been ended after its last run and before it had put them in order.
      CLEW_RETURN_IF_ERROR(bench::put_in_order(plan_, folders_.shard(number)));
      end.directories.push_back(folders_.shard(number));
    }
    return end;
  }

  const bench::BenchPlan& plan_;
  const bench::BenchOrder& order_;
  const SweepOptions& options_;
  JobQueue& queue_;
  ShardFolders folders_;
  std::vector<Attempts> attempts_;
  SweepProgress progress_;
  std::string job_;  ///< in the queue; empty: none
  int submissions_ = 0;
  int waits_ = 0;
  int failures_ = 0;
};

}  // namespace

std::size_t default_shards(const bench::BenchPlan& plan, std::size_t cores,
                           std::size_t cores_of_task) {
  const std::size_t wanted = 2 * std::max<std::size_t>(1, cores / cores_of_task);
  return std::min({wanted, bench::kMostShards, plan.runs()});
}

Result<SweepEnd> run_sweep(const bench::BenchPlan& plan, const bench::BenchOrder& order,
                           const SweepOptions& options, JobQueue& queue) {
  if (options.restart) {
    std::error_code failed;
    std::filesystem::remove_all(std::filesystem::path(options.directory) / "shards", failed);
    if (failed) return Error{"cannot be removed: " + failed.message(), options.directory};
  }
  // None is without a run.
  std::size_t count = std::min(options.shards, plan.runs());
  if (count == 0) {
    const auto begun_with = ShardFolders::count_in(options.directory);
    if (!begun_with.ok()) return begun_with.error();
    count = *begun_with;
  }
  if (count == 0) {
    const auto cores = queue.cores();
    if (!cores.ok()) return cores.error();
    count = default_shards(plan, *cores, options.cores);
  }
  auto folders = ShardFolders::open(options.directory, plan, order, count);
  if (!folders.ok()) return folders.error();
  return Sweep(plan, order, options, queue, std::move(folders).value()).run();
}

}  // namespace clew::sweep
