// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::bench {

/// Hands over a line of a unit of work; false if nobody wants more.
using Emit = std::function<bool(const std::string& line)>;
/// Does a unit of work in a worker process, line by line.
using Work = std::function<core::Result<void>(std::size_t unit, const Emit& emit)>;

struct PoolOptions {
  std::size_t workers = 1;
  /// Called in this process for each line, as it comes; an error ends the work.
  std::function<core::Result<void>(const std::string& line)> on_line;
};

/// How the work ended, if not in an error: by a signal, or 0.
struct PoolEnd {
  int interrupted_by = 0;
};

/// Does units of work in forked worker processes: whatever a unit does, to signals, memory or the
/// process itself, it does not do to the others or to this process. Each worker gets the next unit
/// when it is done with one. When this function returns, or this process dies, no worker is left.
/// The error of a unit, and a worker that dies, end the work. Not for a process with threads.
core::Result<PoolEnd> run_in_workers(const std::vector<std::size_t>& units, const Work& work,
                                     const PoolOptions& options);

}  // namespace clew::bench
