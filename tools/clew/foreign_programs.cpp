// SPDX-License-Identifier: Apache-2.0
#include "clew/foreign_programs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace clew::tools {

using core::Error;
using core::Result;

namespace {

/// A directory may be executed, too, which means something else.
bool is_executable(const std::string& path) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code) && ::access(path.c_str(), X_OK) == 0;
}

bool is_program(const std::string& word) {
  if (word.find('/') != std::string::npos) return is_executable(word);
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (is_executable(folder + '/' + word)) return true;
  }
  return false;
}

}  // namespace

Result<void> check_programs(const runtime::Graph& graph, const std::vector<std::string>& external) {
  for (const auto& stage : graph.stages) {
    if (stage.deployment.exec.empty()) continue;
    const bool is_external =
        std::find(external.begin(), external.end(), stage.info->name) != external.end();
    const std::string& program = stage.deployment.exec.front();
    if (is_external || is_program(program)) continue;
    return stage.place.error(
        fmt::format("exec of {}: there is no program '{}' ({})", stage.info->name, program,
                    program.find('/') == std::string::npos ? "looked for in PATH"
                                                           : "a path from the working directory"));
  }
  return {};
}

Result<void> check_pace(const runtime::Graph& graph, bridge::Pace pace) {
  const auto* robot = graph.writer_of(runtime::Topic::kState);
  if (pace != bridge::Pace::kScaled || !robot->deployment.is_on_the_wire()) return {};
  return Error{fmt::format("{} has exec, and keeps its own pace; allowed: lockstep, realtime",
                           robot->info->name),
               "--pace", 0, 0};
}

}  // namespace clew::tools
