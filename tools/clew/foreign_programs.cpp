// SPDX-License-Identifier: Apache-2.0
#include "clew/foreign_programs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "robot/robots.hpp"

namespace clew::tools {

using core::Error;
using core::Result;

namespace {

/// A directory may be executed, too, which means something else.
bool is_executable(const std::string& path) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code) && ::access(path.c_str(), X_OK) == 0;
}

/// Where exec() would find it; empty if nowhere.
std::string place_of(const std::string& word) {
  if (word.find('/') != std::string::npos) return is_executable(word) ? word : "";
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string place = folder + '/' + word;
    if (is_executable(place)) return place;
  }
  return "";
}

/// Of a script, the program that its first line names; empty if it names none.
std::string interpreter_of(const std::string& place) {
  std::ifstream file(place, std::ios::binary);
  std::string mark(2, '\0');
  if (!file.read(mark.data(), 2) || mark != "#!") return "";
  std::string line;
  std::getline(file, line);
  std::istringstream words(line);
  std::string interpreter;
  words >> interpreter;
  return interpreter;
}

/// Why exec() could not start it; empty if it can.
std::string why_not_started(const std::string& word) {
  const std::string place = place_of(word);
  if (place.empty()) {
    return fmt::format("there is no program '{}' ({})", word,
                       word.find('/') == std::string::npos ? "looked for in PATH"
                                                           : "a path from the working directory");
  }
  const std::string interpreter = interpreter_of(place);
  if (interpreter.empty() || is_executable(interpreter)) return "";
  return fmt::format("'{}' names in its first line '{}', which is no program", word, interpreter);
}

}  // namespace

Result<void> check_programs(const runtime::Graph& graph, const std::vector<std::string>& external) {
  for (const auto& stage : graph.stages) {
    if (stage.deployment.exec.empty()) continue;
    const bool is_external =
        std::find(external.begin(), external.end(), stage.info->name) != external.end();
    if (is_external) continue;
    const std::string why = why_not_started(stage.deployment.exec.front());
    if (!why.empty()) {
      return stage.place.error(fmt::format("exec of {}: {}", stage.info->name, why));
    }
  }
  return {};
}

Result<void> check_programs_are_named(const runtime::Graph& graph,
                                      const std::vector<std::string>& named,
                                      const std::string& component) {
  for (const auto& stage : graph.stages) {
    if (stage.deployment.exec.empty()) continue;
    if (!component.empty() && stage.info->name != component) continue;
    const std::string program = fmt::format("{}", fmt::join(stage.deployment.exec, " "));
    if (std::find(named.begin(), named.end(), program) != named.end()) continue;
    return Error{
        fmt::format("the recording names '{}' as the program of {}; it is run only if you name "
                    "it, too: --exec '{}'",
                    program, stage.info->name, program),
        "--exec"};
  }
  return {};
}

// What the shell still has to work out is left to it.
Result<void> check_prefix(const std::string& command) {
  std::istringstream words(command);
  std::string word;
  words >> word;
  if (word.find_first_of("\"'\\$`~(){};&|<>*?[") != std::string::npos) return {};
  const std::string why = why_not_started(word);
  if (why.empty()) return {};
  return Error{why, "--prefix"};
}

Result<void> check_pace(const runtime::Graph& graph, bridge::Pace pace) {
  if (robot::has_robot(graph) && pace != bridge::Pace::kRealtime) {
    return Error{"a robot of ROS 2 takes part; allowed: realtime", "--pace"};
  }
  const auto* robot = graph.writer_of(runtime::Topic::kState);
  if (pace != bridge::Pace::kScaled || !robot->deployment.is_on_the_wire()) return {};
  return Error{fmt::format("{} has exec, and keeps its own pace; allowed: lockstep, realtime",
                           robot->info->name),
               "--pace"};
}

}  // namespace clew::tools
