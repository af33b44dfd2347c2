// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/foreign_programs.hpp"
#include "clew/own_program.hpp"
#include "clew/resumed_run.hpp"
#include "clew/run_arguments.hpp"
#include "clew/run_options.hpp"
#include "clew/run_output.hpp"
#include "clew/watched_run.hpp"
#include "core/nearest_name.hpp"
#include "recorder/recorder_process.hpp"
#include "recorder/recording_sink.hpp"
#include "run/composed_run.hpp"
#include "run/end_signals.hpp"
#include "runtime/middleware.hpp"
#include "stages/all.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/process_run.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

const std::vector<std::string> kCompressions = {"none", "zstd", "lz4"};
const std::vector<std::string> kRecordOn = {"trap"};
constexpr double kRecordLast_s = 30.0;
const std::vector<std::string> kOnRecordError = {"stop", "continue"};

struct Speed {
  bridge::Pace pace = bridge::Pace::kLockstep;
  double factor = 1.0;
};

Result<Speed> read_pace(const std::string& text) {
  if (text == "lockstep") return Speed{};
  if (text == "realtime") return Speed{bridge::Pace::kRealtime, 1.0};
  double factor = 0.0;
  char unit = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf%c%c", &factor, &unit, &rest) == 2 && unit == 'x' &&
      std::isfinite(factor) && factor >= 0.001 && factor <= 1000.0) {
    return Speed{bridge::Pace::kScaled, factor};
  }
  return Error{"found '" + text + "'; allowed: lockstep, realtime, or a factor of simulated time " +
                   "from 0.001x to 1000x",
               "--pace", 0, 0};
}

Result<void> check_stage(const runtime::Graph& graph, const std::string& stage,
                         const char* option) {
  if (graph.find(stage) != nullptr) return {};
  std::vector<std::string> known;
  for (const auto& candidate : graph.stages) known.push_back(candidate.info->name);
  return Error{core::unknown_name("stage of this graph", stage, known), option, 0, 0};
}

Error given_twice(const char* option, const std::string& what) {
  return {"is given twice" + (what.empty() ? "" : " for " + what) + "; once is allowed", option, 0,
          0};
}

Result<void> read_middleware(const RunOptions& options, const runtime::Graph& graph,
                             bridge::ProcessLayout& layout) {
  std::set<std::string> given;
  for (const std::string& text : options.middleware) {
    const std::size_t equals = text.find('=');
    const std::string vendor = equals == std::string::npos ? text : text.substr(equals + 1);
    if (!runtime::is_middleware(vendor)) {
      return Error{runtime::unknown_middleware(vendor), "--middleware", 0, 0};
    }
    const std::string stage = equals == std::string::npos ? "" : text.substr(0, equals);
    if (!given.insert(stage).second) return given_twice("--middleware", stage);
    if (equals == std::string::npos) {
      // The command line outranks the graph.
      layout.middleware = vendor;
      for (const auto& each : graph.stages) {
        layout.stage_middleware.emplace(each.info->name, vendor);
      }
    } else {
      CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--middleware"));
      layout.stage_middleware[stage] = vendor;
    }
  }
  return {};
}

Result<bridge::ProcessLayout> read_layout(const RunOptions& options, const runtime::Graph& graph,
                                          const Speed& speed) {
  bridge::ProcessLayout layout;
  layout.program = own_program();
  layout.domain = options.domain;
  layout.pace = speed.pace;
  layout.pace_factor = speed.factor;
  layout.realtime_priority = options.realtime_priority.value_or(0);
  layout.hash = !options.no_hash;
  layout.on_record_error = options.on_record_error == "stop" ? bridge::OnRecordError::kStop
                                                             : bridge::OnRecordError::kContinue;
  CLEW_RETURN_IF_ERROR(read_middleware(options, graph, layout));
  for (const std::string& stage : options.external) {
    CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--external"));
    if (!layout.external.insert(stage).second) return given_twice("--external", stage);
  }
  for (const std::string& text : options.prefix) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
      return Error{"expected STAGE='command', found '" + text + "'", "--prefix", 0, 0};
    }
    const std::string stage = text.substr(0, equals);
    CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--prefix"));
    const bool first = layout.prefix.emplace(stage, text.substr(equals + 1)).second;
    if (!first) return given_twice("--prefix", stage);
  }
  return layout;
}

// One vendor's name, or each stage with its own.
std::string middleware_text(const runtime::Graph& graph, const bridge::ProcessLayout& layout) {
  std::set<std::string> vendors;
  std::string each;
  for (const auto& stage : graph.stages) {
    const std::string vendor = bridge::middleware_of(stage, layout);
    vendors.insert(vendor);
    each += (each.empty() ? "" : ",") + stage.info->name + '=' + vendor;
  }
  return vendors.size() == 1 ? *vendors.begin() : each;
}

Result<void> check_black_box(const RunOptions& options) {
  const bool wanted = !options.record_on.empty();
  if (wanted && options.record_on != kRecordOn.front()) {
    return Error{core::unknown_name("occasion", options.record_on, kRecordOn), "--record-on", 0, 0};
  }
  if (wanted && options.record.empty()) {
    return Error{"needs --record FILE", "--record-on", 0, 0};
  }
  if (!options.resume.empty() && wanted) {
    return Error{"a resumed run is recorded as before", "--record-on", 0, 0};
  }
  if (options.record_last_s && !wanted) {
    return Error{"needs --record-on trap", "--record-last", 0, 0};
  }
  return {};
}

Result<void> check_options(const RunOptions& options) {
  CLEW_RETURN_IF_ERROR(check_black_box(options));
  if (options.layout != "processes" && options.layout != "composed") {
    return Error{core::unknown_name("layout", options.layout, {"processes", "composed"}),
                 "--layout", 0, 0};
  }
  const auto known = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!options.compression.empty() && !known(kCompressions, options.compression)) {
    return Error{core::unknown_name("compression", options.compression, kCompressions),
                 "--compression", 0, 0};
  }
  if (!known(kOnRecordError, options.on_record_error)) {
    return Error{core::unknown_name("choice", options.on_record_error, kOnRecordError),
                 "--on-record-error", 0, 0};
  }
  const bool composed = options.layout == "composed";
  if (composed && (!options.external.empty() || !options.prefix.empty() || options.domain ||
                   options.realtime_priority || !options.middleware.empty())) {
    return Error{
        "--external, --prefix, --domain, --realtime-priority and --middleware need --layout "
        "processes",
        {},
        0,
        0};
  }
  return {};
}

/// A run and where it begins: with a graph, or with what was recorded of it.
struct Job {
  runtime::RunPlan plan;
  std::optional<bridge::RecordingOrder> recording;
  std::optional<bridge::Resumption> resumption;
  std::string resumed_from;  ///< the recording that is gone on with
};

Result<Job> new_job(const RunOptions& options) {
  if (options.graph.empty()) return Error{"which graph? see 'clew list graphs'", {}, 0, 0};
  auto plan = runtime::prepare_run(options.graph, options.overrides,
                                   runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return plan.error();
  Job job{std::move(plan).value(), std::nullopt, std::nullopt, {}};
  if (options.record.empty()) return job;
  const double keep_last_s =
      options.record_on.empty() ? 0.0 : options.record_last_s.value_or(kRecordLast_s);
  job.recording = {options.record, bridge::describe_run(job.plan), keep_last_s};
  const std::string compression = options.compression == "none" ? "" : options.compression;
  job.recording->description.compression = *bridge::mcap::compression_from_name(compression);
  return job;
}

Result<Job> resumed_job(const RunOptions& options) {
  auto resumed = resume_run(options);
  if (!resumed.ok()) return resumed.error();
  return Job{std::move(resumed->plan), std::move(resumed->recording),
             std::move(resumed->resumption), std::move(resumed->file)};
}

/// Takes the recording's name, when nothing that was asked for can be wrong any more: a command
/// that is refused leaves no file in the way of the right one.
Result<void> claim_recording(const RunOptions& options, const Job& job) {
  if (job.resumption) return claim_resumed(options, job.resumed_from, job.recording->path);
  if (job.recording) return bridge::mcap::OutputFile::reserve(options.record, options.force);
  return {};
}

/// A composed run is one process with its recorder: it dies with it. So is one that has ended, and
/// whose recording only lacks its end.
Result<bridge::RunReport> run_composed(Job& job, const bridge::ProcessLayout& layout,
                                       bridge::LiveFeed* feed) {
  std::unique_ptr<bridge::RunSink> sink;
  if (job.recording) {
    auto opened = bridge::open_sink(*job.recording);
    if (!opened.ok()) return opened.error();
    sink = std::move(opened).value();
  }
  const bridge::ComposedLayout composed{layout.pace, layout.pace_factor, layout.hash,
                                        layout.on_record_error};
  const auto display = terminal_display(job.plan);
  std::optional<bridge::FedSink> fed;
  if (feed != nullptr) fed.emplace(sink.get(), *feed);
  bridge::SampleSink* const all = fed ? &*fed : static_cast<bridge::SampleSink*>(sink.get());
  auto report = job.resumption ? bridge::run_composed(job.plan, std::move(job.resumption->composed),
                                                      composed, all, display)
                               : bridge::run_composed(job.plan, composed, all, display);
  if (sink && report.ok()) report->recording = sink->close({report->aborted, false});
  return report;
}

bridge::WatchSamples watch_of(bridge::LiveFeed* feed) {
  if (feed == nullptr) return nullptr;
  return [feed](std::string_view spool) { feed->add(spool); };
}

Result<bridge::RunReport> run_job(Job& job, const bridge::ProcessLayout& layout, bool composed,
                                  bridge::LiveFeed* feed) {
  const bool has_ended = job.resumption && job.resumption->has_ended;
  auto report = composed || has_ended
                    ? run_composed(job, layout, feed)
                    : bridge::run_processes(
                          job.plan, layout, job.recording, terminal_display(job.plan),
                          job.resumption ? job.resumption->processes : bridge::ProcessStart{},
                          watch_of(feed));
  // What was only reserved is in nobody's way.
  const bool nothing = report.ok() && report->recording && report->recording->nothing;
  if ((!report.ok() || nothing) && job.recording && !job.resumption) {
    bridge::mcap::OutputFile::discard(job.recording->path);
  }
  return report;
}

/// A recording that failed or lacks samples ends the run badly, unless the user said otherwise.
void judge_recording(const bridge::ProcessLayout& layout, bridge::RunReport& report) {
  if (!report.recording) return;
  const std::string what = bridge::complaint(*report.recording);
  if (what.empty() || report.aborted == what || report.interrupted_by != 0) return;
  if (layout.on_record_error == bridge::OnRecordError::kStop && report.aborted.empty()) {
    report.aborted = what;
  } else {
    std::fprintf(stderr, "clew: %s\n", what.c_str());
  }
}

int run_command(const RunOptions& options) {
  // From here on a signal ends the run with a report, also one that comes before the first tick.
  bridge::EndSignals signals;
  if (const auto checked = check_options(options); !checked.ok()) return complain(checked.error());
  const auto speed = read_pace(options.pace);
  if (!speed.ok()) return complain(speed.error());
  auto job = options.resume.empty() ? new_job(options) : resumed_job(options);
  if (!job.ok()) return complain(job.error());
  const auto layout = read_layout(options, job->plan.graph, *speed);
  if (!layout.ok()) return complain(layout.error());
  const auto paced = check_pace(job->plan.graph, speed->pace);
  if (!paced.ok()) return complain(paced.error());
  const auto programs = check_programs(job->plan.graph, options.external);
  if (!programs.ok()) return complain(programs.error());
  const auto feed = start_view(options, job->plan);
  if (!feed.ok()) return complain(feed.error());
  const auto claimed = claim_recording(options, *job);
  if (!claimed.ok()) return complain(claimed.error());

  const bool composed = options.layout == "composed";
  auto report = run_job(*job, *layout, composed, feed->get());
  clear_display();
  if (!report.ok()) return complain(report.error());
  judge_recording(*layout, *report);
  if (!report->aborted.empty()) std::fprintf(stderr, "clew: %s\n", report->aborted.c_str());
  const bool wrote = job->recording && !(report->recording && report->recording->nothing);
  if (job->recording && !wrote) {
    std::fputs("clew: nothing happened that the black box writes for: no recording\n", stderr);
  }
  const RunFacts facts{options.layout,
                       composed ? "inprocess" : middleware_text(job->plan.graph, *layout),
                       wrote ? job->recording->path : ""};
  if (!options.json) {
    for (const std::string& note : notes_on(*report, job->plan)) {
      std::fprintf(stderr, "clew: %s\n", note.c_str());
    }
  }
  fmt::print("{}\n", options.json ? report_json(*report, job->plan, facts)
                                  : report_line(*report, job->plan));
  if (*feed) end_view(**feed, *report, signals);
  return exit_status(*report);
}

}  // namespace

void add_run(CLI::App& main, int& status) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* app = main.add_subcommand("run", "Run a graph with a simulated robot");
  app->add_option("graph", options->graph, "a name or a path; see 'clew list graphs'");
  add_overrides(*app, options->overrides);
  add_run_arguments(*app, *options);
  app->callback([options, &status] { status = run_command(*options); });
}

}  // namespace clew::tools
