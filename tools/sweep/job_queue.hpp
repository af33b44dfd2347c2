// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::sweep {

/// An array of tasks: one script, run once with each number.
struct ArrayOrder {
  std::string name;
  std::string script;  ///< path
  std::string log;     ///< path, with `%a` for a task's number
  std::vector<std::size_t> tasks;
  std::size_t cores = 1;  ///< of a task
};

enum class TaskState { kWaiting, kRunning };

/// The queue of a cluster.
class JobQueue {
 public:
  JobQueue() = default;
  virtual ~JobQueue() = default;
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// What it is called, for messages: `Slurm`.
  virtual std::string name() const = 0;
  /// Cores that the queue may give, for all tasks together.
  virtual core::Result<std::size_t> cores() = 0;
  /// The job's id.
  virtual core::Result<std::string> submit(const ArrayOrder& order) = 0;
  /// The tasks of a job that have not ended; none for a job that is not known (any more).
  virtual core::Result<std::map<std::size_t, TaskState>> tasks(const std::string& job) = 0;
  virtual core::Result<void> cancel(const std::string& job) = 0;
};

}  // namespace clew::sweep
