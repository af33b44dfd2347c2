// SPDX-License-Identifier: Apache-2.0
#include "clew/replay_publish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "clew/exit_status.hpp"
#include "clew/foreign_programs.hpp"
#include "clew/json_line.hpp"
#include "clew/own_program.hpp"
#include "clew/playback_console.hpp"
#include "clew/replay_output.hpp"
#include "dds/participant.hpp"
#include "replay/live_checks.hpp"
#include "runtime/middleware.hpp"

namespace clew::tools {
namespace {

using bridge::LiveReplayOptions;
using bridge::LiveReplayReport;
using core::Error;
using core::Result;
using nlohmann::ordered_json;

Result<void> read_prefix(const ReplayOptions& options, LiveReplayOptions& live) {
  if (options.prefix.empty()) return {};
  const std::size_t equals = options.prefix.find('=');
  if (equals == std::string::npos || equals + 1 == options.prefix.size()) {
    return Error{"expected STAGE='command', found '" + options.prefix + "'", "--prefix"};
  }
  if (options.prefix.substr(0, equals) != options.component) {
    return Error{"is of '" + options.prefix.substr(0, equals) + "', and --component is '" +
                     options.component + "'",
                 "--prefix"};
  }
  live.prefix = options.prefix.substr(equals + 1);
  CLEW_RETURN_IF_ERROR(check_prefix(live.prefix));
  live.starts_component = true;
  return {};
}

Result<void> read_names(const ReplayOptions& options, const bridge::RunRecording& recording,
                        LiveReplayOptions& live) {
  std::set<std::string> taken;
  for (const std::string& text : options.remap) {
    const std::size_t sign = text.find(":=");
    const std::string name = sign == std::string::npos ? "" : text.substr(sign + 2);
    const bool is_name =
        !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char letter) {
          return std::isalnum(letter) != 0 || letter == '_' || letter == '/';
        });
    if (!is_name) {
      return Error{
          "expected TOPIC:=NAME with a name of letters, digits, _ and /, found '" + text + "'",
          "--remap"};
    }
    const auto topic = bridge::recorded_topic(recording, text.substr(0, sign));
    if (!topic.ok()) return topic.error();
    live.names[*topic] = name;
  }
  for (const domain::Topic topic : domain::kAllTopics) {
    const std::string name = bridge::published_name(topic, live.names);
    if (taken.insert(name).second) continue;
    return Error{"two topics would be called '" + name + "'", "--remap"};
  }
  return {};
}

Result<LiveReplayOptions> read_options(const ReplayOptions& options,
                                       const bridge::RunRecording& recording) {
  LiveReplayOptions live;
  for (const std::string& name : options.publish) {
    const auto topic = bridge::recorded_topic(recording, name);
    if (!topic.ok()) return topic.error();
    live.topics.set(static_cast<std::size_t>(*topic));
  }
  if (!runtime::is_middleware(options.middleware)) {
    return Error{runtime::unknown_middleware(options.middleware), "--middleware"};
  }
  if (options.start && options.component.empty()) {
    return Error{"--start needs --component"};
  }
  live.component = options.component;
  live.starts_component = options.start;
  CLEW_RETURN_IF_ERROR(read_prefix(options, live));
  live.readers = options.readers;
  if (options.first_tick) live.range.first_tick = *options.first_tick;
  if (options.last_tick) live.range.last_tick = *options.last_tick;
  live.range.rate = options.rate;
  live.paused = options.start_paused;
  live.loops = options.loop;
  CLEW_RETURN_IF_ERROR(read_names(options, recording, live));
  live.wait_s = options.wait_s;
  live.program = own_program();
  live.middleware = options.middleware;
  live.domain = options.domain;
  return live;
}

std::string report_json(const LiveReplayReport& report) {
  ordered_json json = {{"component", nullptr},
                       {"ticks", report.ticks},
                       {"identical", nullptr},
                       {"first_difference", nullptr},
                       {"ticks_per_s", report.ticks_per_s}};
  if (report.component) {
    json = replay_json(*report.component);
    json["ticks_per_s"] = report.ticks_per_s;
  }
  json["published_ticks"] = report.ticks;
  ordered_json samples = ordered_json::object();
  for (const auto& [topic, count] : report.samples) {
    samples[std::string(domain::topic_name(topic))] = count;
  }
  json["published"] = std::move(samples);
  json["domain"] = report.domain;
  json["why"] = report.stopped;
  return json_line(json);
}

void print(const LiveReplayReport& report) {
  std::string topics;
  for (const auto& [topic, count] : report.samples) {
    topics += fmt::format("{}{}", topics.empty() ? "" : ", ", domain::topic_name(topic));
  }
  fmt::print("published {} ticks of {}, {:.0f} ticks/s\n", report.ticks, topics,
             report.ticks_per_s);
  if (report.component) {
    bridge::ReplayReport component = *report.component;
    component.ticks_per_s = report.ticks_per_s;
    print_replay(component);
  }
}

int status_of(const LiveReplayReport& report) {
  if (report.interrupted_by != 0) return kExitInterrupted;
  const bool identical = !report.component || report.component->identical();
  return report.stopped.empty() && identical ? kExitGood : kExitFailed;
}

}  // namespace

int replay_publish(const ReplayOptions& options, const bridge::RunRecording& recording,
                   const runtime::RunPlan& recorded, const runtime::RunPlan& plan) {
  const auto live = read_options(options, recording);
  if (!live.ok()) return complain(live.error());
  if (live->starts_component) {
    const auto named = check_programs_are_named(plan.graph, options.exec, options.component);
    if (!named.ok()) return complain(named.error());
  }
  PlaybackTerminal console(options.commands       ? PlaybackTerminal::Input::kCommands
                           : live->prefix.empty() ? PlaybackTerminal::Input::kKeys
                                                  : PlaybackTerminal::Input::kNone);
  const auto report = bridge::replay_live(recording, recorded, plan, *live, console);
  console.clear();
  if (!report.ok()) return complain(report.error());
  if (!report->stopped.empty()) console.log(report->stopped);
  if (options.json) {
    fmt::print("{}\n", report_json(*report));
  } else {
    print(*report);
  }
  return status_of(*report);
}

}  // namespace clew::tools
