// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>

#include "clew/bridged_run.hpp"
#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/fleet_run.hpp"
#include "clew/foreign_programs.hpp"
#include "clew/plugin_options.hpp"
#include "clew/recording_options.hpp"
#include "clew/resumed_run.hpp"
#include "clew/run_arguments.hpp"
#include "clew/run_hosts.hpp"
#include "clew/run_layout.hpp"
#include "clew/run_options.hpp"
#include "clew/run_output.hpp"
#include "clew/watched_run.hpp"
#include "core/nearest_name.hpp"
#include "files/whole_file.hpp"
#include "log/log.hpp"
#include "recorder/recorder_process.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/piece_files.hpp"
#include "robot/robots.hpp"
#include "run/composed_run.hpp"
#include "run/end_signals.hpp"
#include "run/run_control.hpp"
#include "stages/all.hpp"
#include "supervisor/composed_control.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/process_run.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

constexpr double kRecordLast_s = 30.0;

Result<void> check_options(const RunOptions& options) {
  if (options.threads) {
    return Error{"needs a fleet: a graph runs in one thread, or in processes", "--threads"};
  }
  CLEW_RETURN_IF_ERROR(check_recording_options(options));
  if (!options.exec.empty() && options.resume.empty()) {
    return Error{"needs --resume: a graph names its programs itself", "--exec"};
  }
  if (!options.layout.empty() && options.layout != "processes" && options.layout != "composed") {
    return Error{core::unknown_name("layout", options.layout, {"processes", "composed"}),
                 "--layout"};
  }
  if (!options.pace.empty()) {
    if (const auto speed = read_pace(options.pace); !speed.ok()) return speed.error();
  }
  return {};
}

Result<void> check_ways(const RunOptions& options, bool composed) {
  if (composed &&
      (!options.external.empty() || !options.prefix.empty() || options.domain ||
       options.realtime_priority || !options.middleware.empty() || !options.secure.empty() ||
       !options.ros2.empty() || !options.hosts.empty() || !options.host.empty())) {
    return Error{
        "--hosts, --host, --external, --prefix, --domain, --realtime-priority, --middleware, "
        "--secure and --ros2 need --layout processes"};
  }
  if (!composed && !options.profile.empty()) {
    return Error{"--profile needs --layout composed"};
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

/// What is to be changed while it goes on, as the options have it.
Result<void> plan_changes(const RunOptions& options, Job& job, bridge::RunControl& control) {
  if (job.resumption) {
    control.take_over(job.resumption->interventions, job.resumption->plans,
                      job.resumption->processes.next_tick);
  }
  std::vector<domain::Intervention> planned;
  for (const std::string& text : options.at) {
    auto read = runtime::read_intervention(text, "--at");
    if (!read.ok()) return read.error();
    planned.push_back(std::move(read).value());
  }
  CLEW_RETURN_IF_ERROR(control.plan(std::move(planned)));
  if (job.resumption || !job.recording) return {};
  for (domain::Intervention change : control.interventions()) {
    job.recording->description.bundle.insert(change.files.begin(), change.files.end());
    change.files.clear();
    job.recording->description.planned.push_back(std::move(change));
  }
  return {};
}

Result<Job> new_job(const RunOptions& options) {
  if (options.graph.empty()) return Error{"which graph? see 'clew list graphs'"};
  CLEW_RETURN_IF_ERROR(load_plugins_of(options.plugins, options.graph));
  auto plan = runtime::prepare_run(options.graph, options.overrides,
                                   runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return plan.error();
  Job job{std::move(plan).value(), std::nullopt, std::nullopt, {}};
  if (options.record.empty()) return job;
  const double keep_last_s =
      options.record_on.empty() ? 0.0 : options.record_last_s.value_or(kRecordLast_s);
  job.recording = {options.record, bridge::describe_run(job.plan), keep_last_s, options.force};
  CLEW_RETURN_IF_ERROR(choose_recording(options, job.recording->description));
  return job;
}

Result<Job> resumed_job(const RunOptions& options) {
  auto resumed = resume_run(options);
  if (!resumed.ok()) return resumed.error();
  return Job{std::move(resumed->plan), std::move(resumed->recording),
             std::move(resumed->resumption), std::move(resumed->file)};
}

/// Takes the recording's name, when nothing that was asked for can be wrong any more: a command
/// that is refused leaves no file in the way of the right one. The file says at once which run it
/// is of, so that a run that dies can be gone on with. A disk that is full already is the user's
/// choice in every layout: the run is refused, or goes on without a recording.
Result<void> claim_recording(const RunOptions& options, Job& job) {
  if (job.resumption) return claim_resumed(options, job.resumed_from, job.recording->path);
  if (!job.recording) return {};
  CLEW_RETURN_IF_ERROR(bridge::mcap::OutputFile::reserve(options.record, options.force));
  const bool splits = job.recording->description.split.any();
  if (splits && !options.force) {
    const auto free = bridge::check_no_pieces(options.record);
    if (!free.ok()) bridge::mcap::OutputFile::discard(options.record);
    CLEW_RETURN_IF_ERROR(free);
  }
  if (job.recording->keep_last_s > 0.0) return {};
  const bool is_device = bridge::mcap::OutputFile::temporary_name(options.record) == options.record;
  if (is_device) return {};
  const auto described = bridge::RunRecorder::describe(options.record, job.recording->description);
  if (described.ok()) {
    // Not before: an older recording keeps all of its files if this one cannot begin.
    const auto removed = splits ? bridge::remove_pieces(options.record) : Result<void>();
    if (!removed.ok()) bridge::mcap::OutputFile::discard(options.record);
    return removed;
  }
  bridge::mcap::OutputFile::discard(options.record);
  if (options.on_record_error == "stop") return described.error();
  logs::warning("the run is not recorded: {}", described.error().text());
  job.recording.reset();
  return {};
}

/// All files that the run writes: what cannot be written is told before it runs, not after.
Result<void> claim_files(const RunOptions& options, Job& job) {
  if (!options.profile.empty()) CLEW_RETURN_IF_ERROR(files::write_file(options.profile, ""));
  return claim_recording(options, job);
}

/// Where a composed run begins, with all that is planned for it.
Result<bridge::ComposedStart> composed_start(Job& job, const bridge::RunControl& control,
                                             bool hash) {
  if (job.resumption) return std::move(job.resumption->composed);
  const auto started_at = std::chrono::steady_clock::now();
  auto nodes = runtime::make_successions(job.plan, control.interventions(), control.plans());
  if (!nodes.ok()) return nodes.error();
  return bridge::ComposedStart{
      std::move(nodes).value(), 0, {}, bridge::SampleAccount(hash, false), started_at};
}

/// A composed run is one process with its recorder: it dies with it. So is one that has ended, and
/// whose recording only lacks its end.
Result<bridge::RunReport> run_composed(Job& job, const bridge::ProcessLayout& layout,
                                       bridge::RunControl& control, bridge::RunProfile* profile) {
  std::optional<bridge::RunName> name;
  if (!layout.name.empty()) {
    auto taken = bridge::RunName::take(layout.name);
    if (!taken.ok()) return taken.error();
    name.emplace(std::move(taken).value());
  }
  std::unique_ptr<bridge::RunSink> sink;
  if (job.recording) {
    auto opened = bridge::open_sink(*job.recording);
    if (!opened.ok()) return opened.error();
    sink = std::move(opened).value();
  }
  const bridge::ComposedLayout composed{layout.pace, layout.pace_factor, layout.hash,
                                        layout.on_record_error, profile};
  const auto display = terminal_display(job.plan);
  bridge::ComposedControl orders(control, name ? &*name : nullptr);
  auto start = composed_start(job, control, layout.hash);
  if (!start.ok()) return start.error();
  std::optional<bridge::FedSink> fed;
  // Without a name nobody finds the run to ask for its page.
  if (name) fed.emplace(sink.get(), *control.page());
  bridge::SampleSink* const all = fed ? &*fed : static_cast<bridge::SampleSink*>(sink.get());
  auto report =
      bridge::run_composed(job.plan, std::move(start).value(), composed, all, display, &orders);
  if (report.ok() && report->statistics.truth) {
    report->goal_changed = control.goal_changed_by(report->statistics.truth->tick);
  }
  if (sink && report.ok()) {
    report->recording = sink->close({report->aborted, true, report->hash});
    if (report->recording->failure.empty() && !report->recording->nothing) {
      const auto named =
          bridge::mcap::OutputFile::give_name(job.recording->path, job.recording->overwrite);
      if (!named.ok()) report->recording->failure = named.error().text();
    }
  }
  return report;
}

Result<bridge::RunReport> run_job(Job& job, const bridge::ProcessLayout& layout, bool composed,
                                  bridge::RunControl& control, bridge::RunProfile* profile) {
  const bool has_ended = job.resumption && job.resumption->has_ended;
  auto report =
      composed || has_ended
          ? run_composed(job, layout, control, profile)
          : bridge::run_processes(
                job.plan, layout, job.recording, terminal_display(job.plan),
                job.resumption ? job.resumption->processes : bridge::ProcessStart{}, &control);
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
    logs::warning("{}", what);
  }
}

void print_result(const RunOptions& options, const bridge::RunReport& report,
                  const runtime::RunPlan& plan, const RunFacts& facts) {
  if (!options.json) {
    for (const std::string& note : notes_on(report, plan, facts)) {
      logs::info("{}", note);
    }
  }
  fmt::print("{}\n", options.json ? report_json(report, plan, facts) : report_line(report, plan));
}

/// Says where the time went, if anybody asked, and writes the trace of it to a file.
Result<void> tell_profile(const std::optional<bridge::RunProfile>& profile,
                          const std::string& file) {
  if (!profile) return {};
  std::fputs(profile->table().c_str(), stderr);
  return files::write_file(file, profile->trace());
}

/// How the run is laid out, if all that it needs is there.
Result<bridge::ProcessLayout> checked_layout(const RunOptions& options, const runtime::Graph& graph,
                                             const Speed& speed, bool composed) {
  CLEW_RETURN_IF_ERROR(check_ways(options, composed));
  auto layout = read_layout(options, graph, speed);
  if (!layout.ok()) return layout;
  if (!composed) CLEW_RETURN_IF_ERROR(read_hosts(options, graph, *layout));
  CLEW_RETURN_IF_ERROR(check_pace(graph, speed.pace));
  CLEW_RETURN_IF_ERROR(robot::check_robots(graph, options.domain));
  CLEW_RETURN_IF_ERROR(check_programs(graph, options.external));
  return layout;
}

/// How fast the run is to be, where nobody said so as well.
Result<Speed> speed_of(const RunOptions& options, const runtime::Graph& graph) {
  if (!options.pace.empty()) return read_pace(options.pace);
  return robot::has_robot(graph) ? Speed{bridge::Pace::kRealtime, 1.0} : Speed{};
}

int run_command(const RunOptions& options) {
  // From here on a signal ends the run with a report, also one that comes before the first tick.
  bridge::EndSignals signals;
  if (const auto fleet = fleet_of(options)) return run_fleet_command(options, *fleet, signals);
  if (const auto checked = check_options(options); !checked.ok()) return complain(checked.error());
  auto job = options.resume.empty() ? new_job(options) : resumed_job(options);
  if (!job.ok()) return complain(job.error());
  const auto speed = speed_of(options, job->plan.graph);
  if (!speed.ok()) return complain(speed.error());
  const std::string& layout_name = options.layout.empty() ? job->plan.graph.layout : options.layout;
  const bool composed = layout_name == "composed";
  const auto layout = checked_layout(options, job->plan.graph, *speed, composed);
  if (!layout.ok()) return complain(layout.error());
  const runtime::ConfigPath files = runtime::ConfigPath::from_environment();
  const auto stages = stages::all();
  bridge::RunControl control(job->plan, stages, files);
  if (const auto planned = plan_changes(options, *job, control); !planned.ok()) {
    return complain(planned.error());
  }
  bridge::RunView view = view_of(job->plan);
  control.set_called(layout->name);
  control.set_page(&view);
  const auto viewed = start_view(options, layout->name, view);
  if (!viewed.ok()) return complain(viewed.error());
  const auto claimed = claim_files(options, *job);
  if (!claimed.ok()) return complain(claimed.error());

  auto bridged = BridgedRun::start(options, layout->name);
  if (!bridged.ok()) return complain(bridged.error());
  std::optional<bridge::RunProfile> profile;
  if (!options.profile.empty()) profile.emplace(bridge::profile_of(job->plan));
  auto report = run_job(*job, *layout, composed, control, profile ? &*profile : nullptr);
  clear_display();
  if (!report.ok() || !report->statistics.truth) bridged->stop();
  if (!report.ok()) return complain(report.error());
  judge_recording(*layout, *report);
  if (!report->aborted.empty()) logs::error("{}", report->aborted);
  const bool wrote = job->recording && !(report->recording && report->recording->nothing);
  if (job->recording && !wrote) {
    logs::info("nothing happened that the black box writes for: no recording");
  }
  RunFacts facts{layout_name, composed ? "inprocess" : middleware_text(job->plan.graph, *layout),
                 wrote ? job->recording->path : ""};
  facts.seed_given = options.overrides.seed.has_value();
  for (const domain::Intervention& change : control.interventions()) {
    if (!change.changes.empty()) facts.planned_changes.push_back(change.tick);
  }
  print_result(options, *report, job->plan, facts);
  end_view(options, view, *report, signals);
  const auto told = tell_profile(profile, options.profile);
  return told.ok() ? exit_status(*report) : complain(told.error());
}

}  // namespace

void add_run(CLI::App& main, int& status) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* app =
      main.add_subcommand("run", "Run a graph with a simulated robot, or a fleet of them");
  app->add_option("graph", options->graph,
                  "a name or a path; see 'clew list graphs' and 'clew list fleets'");
  add_overrides(*app, options->overrides);
  add_plugins(*app, options->plugins);
  add_run_arguments(*app, *options);
  app->callback([options, &status] { status = run_command(*options); });
}

}  // namespace clew::tools
