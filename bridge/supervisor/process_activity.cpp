// SPDX-License-Identifier: Apache-2.0
#include "supervisor/process_activity.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace clew::bridge {
namespace {

/// More than any program has, below a process: one that starts others without end is not followed.
constexpr int kMostGenerations = 8;

/// A line of proc(5) behind the program's name, which is in brackets and may hold anything.
std::optional<std::istringstream> stat_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  const std::size_t end = text.rfind(')');
  if (end == std::string::npos) return std::nullopt;
  return std::istringstream(text.substr(end + 1));
}

std::optional<char> state_of(const std::filesystem::path& path) {
  auto fields = stat_of(path);
  char state = '?';
  if (!fields || !(*fields >> state)) return std::nullopt;
  return state;
}

double processor_time_s(std::istringstream& fields) {
  constexpr int kBefore = 11;  // the state, and what is between it and the times
  std::string skipped;
  for (int i = 0; i < kBefore; ++i) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

bool add(std::int64_t process_id, int generation, ProcessActivity& activity) {
  const std::filesystem::path place = "/proc/" + std::to_string(process_id);
  auto fields = stat_of(place / "stat");
  if (!fields) return false;
  activity.processor_s += processor_time_s(*fields);
  // It may end at any time.
  std::error_code gone;
  auto thread = std::filesystem::directory_iterator(place / "task", gone);
  for (; !gone && thread != end(thread); thread.increment(gone)) {
    const auto state = state_of(thread->path() / "stat");
    if (state == 'R' || state == 'D') activity.runnable = true;
    if (generation == 0 && (state == 'T' || state == 't')) activity.stopped = true;
    if (generation == kMostGenerations) continue;
    std::ifstream children(thread->path() / "children");
    for (std::int64_t child = 0; children >> child;) add(child, generation + 1, activity);
  }
  return true;
}

}  // namespace

std::optional<ProcessActivity> activity_of(std::int64_t process_id) {
  ProcessActivity activity;
  if (!add(process_id, 0, activity)) return std::nullopt;
  return activity;
}

}  // namespace clew::bridge
