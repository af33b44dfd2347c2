// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>

namespace clew::bridge {

/// Ends a group of processes when the process that made the guard ends, however that comes about:
/// the kernel tells a child of its parent's death, and nobody a grandchild. It is a process that
/// waits for the end of a pipe, or, with patience, until it has heard nothing for so long: then the
/// parent is stopped, and nobody watches over the group.
class GroupGuard {
 public:
  /// None where no process can be had.
  static std::optional<GroupGuard> start(
      int group, std::optional<std::chrono::milliseconds> patience = std::nullopt);
  /// The parent goes on. Nothing waits.
  void beat();

  GroupGuard(GroupGuard&& other) noexcept;
  GroupGuard& operator=(GroupGuard&& other) noexcept;
  /// Ends the guard, not the group.
  ~GroupGuard();

 private:
  GroupGuard(int process_id, int pipe) : process_id_(process_id), pipe_(pipe) {}

  int process_id_;  ///< 0: moved from
  int pipe_;
};

}  // namespace clew::bridge
