// SPDX-License-Identifier: Apache-2.0
#include "clew/resumed_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "clew/foreign_programs.hpp"
#include "clew/plugin_options.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using bridge::mcap::OutputFile;
using core::Error;
using core::Result;

constexpr char kTemporary[] = ".tmp~";

Result<void> check_nothing_is_decided_anew(const RunOptions& options) {
  const auto& overrides = options.overrides;
  const std::pair<bool, const char*> decided[] = {{!options.graph.empty(), "a graph"},
                                                  {overrides.world.has_value(), "--world"},
                                                  {overrides.robot.has_value(), "--robot"},
                                                  {!overrides.with.empty(), "--with"},
                                                  {!overrides.set.empty(), "--set"},
                                                  {overrides.seed.has_value(), "--seed"},
                                                  {overrides.max_ticks.has_value(), "--max-ticks"},
                                                  {!options.at.empty(), "--at"},
                                                  {!options.compression.empty(), "--compression"}};
  for (const auto& [given, name] : decided) {
    if (!given) continue;
    return Error{fmt::format("goes on with what is recorded: leave out {}", name), "--resume"};
  }
  if (options.pace == "realtime") {
    return Error{"a run in real time cannot be continued", "--resume"};
  }
  if (options.force && options.record.empty()) {
    return Error{"--force needs --record here", "--resume"};
  }
  return {};
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// The file that is there: the one that is named, or what a recorder left for it.
std::string existing(const std::string& path) {
  return !is_file(path) && is_file(path + kTemporary) ? path + kTemporary : path;
}

/// The name that a recording gets when it is whole.
std::string final_name(const std::string& file) {
  const std::size_t end = std::string(kTemporary).size();
  const bool temporary = file.size() > end && file.compare(file.size() - end, end, kTemporary) == 0;
  return temporary ? file.substr(0, file.size() - end) : file;
}

/// Puts the file where a recorder goes on with it: under the temporary name of what it becomes.
Result<void> take_over(const std::string& file, const std::string& becomes, bool copy) {
  const std::string temporary = becomes + kTemporary;
  if (file == temporary && is_file(becomes)) {
    return Error{"exists; it would be overwritten: move one of the two away", becomes};
  }
  if (file == temporary) return {};
  if (!copy && is_file(temporary)) {
    return Error{"exists, too: which one is to be resumed?", temporary};
  }
  std::error_code error;
  if (copy) {
    std::filesystem::copy_file(file, temporary, std::filesystem::copy_options::overwrite_existing,
                               error);
  } else {
    std::filesystem::rename(file, temporary, error);
  }
  if (error) return Error{"cannot be written: " + error.message(), temporary};
  return {};
}

}  // namespace

Result<ResumedRun> resume_run(const RunOptions& options) {
  CLEW_RETURN_IF_ERROR(check_nothing_is_decided_anew(options));
  const std::string file = existing(options.resume);
  const auto recording = bridge::RunRecording::open(file);
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(load_plugins_for(*recording, options.plugins));
  auto plan = bridge::recorded_plan(*recording, stages::all());
  if (!plan.ok()) return plan.error();
  auto resumption = bridge::resume(*recording, *plan);
  if (!resumption.ok()) return resumption.error();
  CLEW_RETURN_IF_ERROR(check_programs_are_named(plan->graph, options.exec));
  if (resumption->has_ended && recording->complete()) {
    return Error{fmt::format("is complete: the run ended at tick {}, nothing is left to resume",
                             resumption->processes.next_tick - 1),
                 file};
  }
  const std::string becomes = options.record.empty() ? final_name(file) : options.record;
  bridge::RecordingOrder order{becomes, bridge::describe_run(*plan), 0.0, options.force};
  // What it says of itself stays, whatever of it this version would say otherwise.
  order.description.versions = recording->description().versions;
  order.description.bundle = recording->description().bundle;
  order.description.planned = recording->description().planned;
  order.description.compression = recording->description().compression;
  order.description.split = recording->description().split;
  if (order.description.split.any() && !options.record.empty()) {
    return Error{"is split, and is gone on with where it is: leave out --record", file};
  }
  if (const std::string there = recording->unread_piece(); !there.empty()) {
    return Error{"exists, and files before it lack, which would be written anew: move it away",
                 there};
  }
  return ResumedRun{std::move(plan).value(), std::move(order), std::move(resumption).value(), file};
}

Result<void> claim_resumed(const RunOptions& options, const std::string& file,
                           const std::string& becomes) {
  const bool copy = !options.record.empty();
  if (copy) CLEW_RETURN_IF_ERROR(OutputFile::reserve(becomes, options.force));
  return take_over(file, becomes, copy);
}

}  // namespace clew::tools
