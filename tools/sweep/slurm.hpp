// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sweep/job_queue.hpp"

namespace clew::sweep {

/// Slurm by its commands: sbatch, squeue, scancel and sinfo. What they take from the environment
/// (SBATCH_ACCOUNT, SBATCH_TIMELIMIT, SBATCH_MEM_PER_CPU, ...) they take here, too.
class Slurm : public JobQueue {
 public:
  /// An empty partition is the cluster's default.
  explicit Slurm(std::string partition) : partition_(std::move(partition)) {}

  std::string name() const override { return "Slurm"; }
  core::Result<std::size_t> cores() override;
  core::Result<std::string> submit(const ArrayOrder& order) override;
  core::Result<std::map<std::size_t, TaskState>> tasks(const std::string& job) override;
  core::Result<void> cancel(const std::string& job) override;

 private:
  std::string partition_;
};

/// `1-3,5` of 1, 2, 3, 5: numbers in ascending order as sbatch takes them.
std::string array_text(const std::vector<std::size_t>& tasks);

/// Reads what `squeue --noheader --array --format=%K|%t` prints.
core::Result<std::map<std::size_t, TaskState>> read_tasks(const std::string& text);

/// Reads what `sinfo --noheader --format=%P|%C` prints: a partition a line, the default one with a
/// star, its cores as allocated/idle/other/total. Those of the default partition, if there is one,
/// else of all. Cores that are down do not count.
core::Result<std::size_t> read_cores(const std::string& text);

}  // namespace clew::sweep
