// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "clew/commands.hpp"
#include "clew/version.hpp"
#include "core/nearest_name.hpp"
#include "domain/topics.hpp"
#include "replay/playback.hpp"

namespace clew::tools {
namespace {

// A status that a command line gives is remembered here, since CLI11's callbacks return nothing.
struct Outcome {
  int status = kExitGood;
};

/// For counts, which a graph file holds, too.
const CLI::Validator kCount(
    [](std::string& text) {
      std::int64_t count = 0;
      const char* const end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, count);
      if (error == std::errc() && stop == end && count >= 0) return std::string();
      return fmt::format("found '{}'; allowed: a whole number from 0 to {}", text,
                         std::numeric_limits<std::int64_t>::max());
    },
    "");

/// For the name of a file to write.
const CLI::Validator kNamed(
    [](std::string& name) { return std::string(name.empty() ? "the name is empty" : ""); }, "");

void add_overrides(CLI::App& app, runtime::GraphOverrides& overrides) {
  app.add_option("--world", overrides.world, "another world: a name or a path");
  app.add_option("--robot", overrides.robot, "another robot: a name or a path");
  app.add_option("--with", overrides.with, "STAGE[.PART]=NAME[,NAME...]: another behaviour")
      ->allow_extra_args(false);
  app.add_option("--set", overrides.set, "STAGE[.PART][.NAME].PARAM=VALUE: another value")
      ->allow_extra_args(false);
  app.add_option("--seed", overrides.seed, "of all random numbers (1)")->check(kCount);
  app.add_option("--max-ticks", overrides.max_ticks, "give up after so many (20000)")
      ->check(kCount);
}

void add_run(CLI::App& main, RunOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("run", "Run a graph with a simulated robot");
  app->add_option("graph", options.graph, "a name or a path");
  add_overrides(*app, options.overrides);
  app->add_option("--resume", options.resume,
                  "go on with a recording whose run was cut off, instead of a graph");
  app->add_option("--layout", options.layout, "processes | composed");
  app->add_option("--middleware", options.middleware,
                  "cyclonedds | fastdds, or STAGE=VENDOR; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--pace", options.pace, "lockstep | realtime | Nx");
  app->add_option("--realtime-priority", options.realtime_priority,
                  "1 to 99: first-in-first-out scheduling of component processes (none)")
      ->check(CLI::Range(1, 99));
  app->add_option("--domain", options.domain, "DDS domain, 0 to 99 (a free one)");
  app->add_option("--record", options.record, "write a recording (MCAP)")->check(kNamed);
  app->add_flag("--force", options.force, "overwrite the recording");
  app->add_option(
      "--record-on", options.record_on,
      "trap: a black box, which writes what it kept, and then goes on recording, when a "
      "trap is detected, a collision happens or the run ends badly");
  app->add_option("--record-last", options.record_last_s,
                  "simulated seconds that a black box keeps (30)")
      ->check(CLI::Range(0.001, 86400.0));
  app->add_option("--compression", options.compression,
                  "of the recording: none | zstd | lz4 (none: the fastest, and its bytes depend on "
                  "no compressor's version; zstd makes it several times smaller)");
  app->add_option("--on-record-error", options.on_record_error,
                  "stop | continue: what a run does whose recording fails or lacks samples (stop)");
  app->add_option("--external", options.external, "wait for a STAGE that a person starts")
      ->allow_extra_args(false);
  app->add_option("--prefix", options.prefix, "STAGE='gdb --args': start it with a command before")
      ->allow_extra_args(false);
  app->add_flag("--json", options.json, "print the result as one JSON object");
  app->add_flag("--no-hash", options.no_hash, "do not hash what is published");
  auto view = std::make_shared<bool>(false);
  app->add_flag("--view", *view, "not in this version")->group("");
  app->callback([&options, &outcome, view] {
    outcome.status =
        *view ? complain({"--view is not in this version", {}, 0, 0}) : run_command(options);
  });
}

void add_bench(CLI::App& main, BenchCommandOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("bench", "Run graphs in all worlds of a suite, and compare");
  app->add_option("suite", options.suite, "a name or a path")->required();
  app->add_option("--graph", options.graphs, "in place of the suite's graphs; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--with", options.with, "STAGE[.PART]=NAME[,NAME...]: in every graph")
      ->allow_extra_args(false);
  app->add_option("--set", options.set, "STAGE[.PART][.NAME].PARAM=VALUE: in every graph")
      ->allow_extra_args(false);
  app->add_option(
         "--vary", options.vary,
         "STAGE.PART=NAME,NAME,... or STAGE...PARAM=VALUE,VALUE,...: every graph with each "
         "of them; A+B is the list of A and B; repeated: all combinations, and two make a "
         "matrix in the report")
      ->allow_extra_args(false);
  app->add_option("--jobs", options.jobs, "worker processes (one a core)")
      ->check(CLI::Range(1, 1024));
  app->add_option("--out", options.out,
                  "directory for results and report (out/bench/SUITE); results that are there are "
                  "gone on from");
  app->add_flag("--force", options.force, "drop the results that are there");
  app->add_flag("--json", options.json, "print one JSON object a run");
  app->add_option("--write-worlds", options.write_worlds,
                  "write the generated worlds and their pictures to a directory, run nothing");
  app->callback([&] { outcome.status = bench_command(options); });
}

void add_check(CLI::App& main, CheckOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("check", "Check a graph and show its wiring");
  app->add_option("graph", options.graph, "a name or a path")->required();
  add_overrides(*app, options.overrides);
  app->add_flag("--expand", options.expand, "print the graph with every value in it");
  app->callback([&] { outcome.status = check_command(options); });
}

void add_list(CLI::App& main, ListOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("list", "List graphs, worlds, stages and behaviours");
  app->add_option("what", options.what, "graphs | worlds | STAGE[.PART]");
  app->add_option("name", options.name, "only this one");
  app->callback([&] { outcome.status = list_command(options); });
}

void add_component(CLI::App& main, ComponentOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("component", "Run one stage of a run as this process");
  app->add_option("graph", options.graph, "a name or a path; -: as the run has it")->required();
  app->add_option("stage", options.stage)->required();
  app->add_option("--domain", options.domain, "the run's DDS domain (CLEW_DOMAIN_ID)");
  app->callback([&] { outcome.status = component_command(options); });
}

// Started by runs only.
void add_recorder(CLI::App& main, RecorderOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("recorder", "Record a run as this process");
  app->group("");
  app->add_option("--domain", options.domain, "the run's DDS domain")->required();
  app->callback([&] { outcome.status = recorder_command(options); });
}

void add_plot(CLI::App& main, PlotOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("plot", "Draw the path of one or more recordings");
  app->add_option("recording", options.recordings)->required();
  app->add_option("-o,--output", options.output, "FILE.svg or FILE.png")->required();
  app->add_option("--tick", options.tick,
                  "draw what the components show of this tick, from one recording");
  app->callback([&] { outcome.status = plot_command(options); });
}

void add_info(CLI::App& main, InfoOptions& options, Outcome& outcome) {
  CLI::App* app =
      main.add_subcommand("info", "Tell what a recording holds, and whether it is whole");
  app->add_option("recording", options.recording)->required();
  app->add_flag("--json", options.json, "print it as one JSON object");
  app->callback([&] { outcome.status = info_command(options); });
}

void add_diff(CLI::App& main, DiffOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("diff", "Find the first difference between two recordings");
  app->add_option("a", options.a, "a recording")->required();
  app->add_option("b", options.b, "another")->required();
  app->add_option("--tolerance", options.tolerance, "numbers this close count as equal (0)")
      ->check(CLI::NonNegativeNumber);
  app->add_flag("--json", options.json, "print it as one JSON object");
  app->callback([&] { outcome.status = diff_command(options); });
}

void add_publish(CLI::App& app, ReplayOptions& options) {
  app.add_option("--publish", options.publish,
                 "put these TOPICs, or the inputs of --component, on the wire")
      ->expected(0, static_cast<int>(domain::kTopicCount));
  app.add_option("--domain", options.domain, "DDS domain, 0 to 99 (a free one)");
  app.add_option("--middleware", options.middleware, "cyclonedds | fastdds (cyclonedds)");
  app.add_flag("--start", options.start, "start the component's process, too");
  app.add_option("--prefix", options.prefix, "STAGE='gdb --args': start it with a command before");
  app.add_option("--reader", options.readers, "start a COMMAND that reads; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--wait", options.wait_s, "seconds to wait for readers (10; by hand started: 60)")
      ->check(CLI::Range(0.1, 86400.0));
  app.add_flag("--start-paused", options.start_paused, "wait before the first tick");
  app.add_flag("--commands", options.commands,
               "read pause, resume, step [N], rate N and end from stdin, a line each");
}

void add_replay(CLI::App& main, ReplayOptions& options, Outcome& outcome) {
  CLI::App* app = main.add_subcommand("replay", "Feed a recording to its components and compare");
  app->add_option("recording", options.recording, "required");
  app->add_option("--component", options.component, "only this stage (all, each on its own)");
  app->add_option("--with", options.overrides.with, "STAGE[.PART]=NAME[,NAME...]: other behaviour")
      ->allow_extra_args(false);
  app->add_option("--set", options.overrides.set, "STAGE[.PART][.NAME].PARAM=VALUE: other value")
      ->allow_extra_args(false);
  app->add_option("--from", options.first_tick, "compare from this tick")->check(kCount);
  app->add_option("--to", options.last_tick, "end with this tick")->check(kCount);
  app->add_option("--rate", options.rate, "simulated over wall-clock time (as fast as it goes)")
      ->check(CLI::Range(bridge::Playback::kLowestRate, bridge::Playback::kHighestRate));
  app->add_option("--branch", options.branch_tick, "run the graph on from this tick")
      ->check(kCount);
  app->add_option("--record", options.record, "write a recording of the branch (MCAP)");
  app->add_flag("--force", options.force, "overwrite it");
  app->add_option("--max-ticks", options.overrides.max_ticks, "give up the branch after so many")
      ->check(kCount);
  add_publish(*app, options);
  app->add_flag("--json", options.json, "print the result as one JSON object");
  app->callback([app, &options, &outcome] {
    options.publishes = app->count("--publish") > 0;
    // An option without a value is given as an empty one.
    if (options.publish == std::vector<std::string>{""}) options.publish.clear();
    outcome.status = replay_command(options);
  });
}

void add_train_som(CLI::App& train, TrainSomOptions& options, Outcome& outcome) {
  CLI::App* som = train.add_subcommand("som", "The landmark map of Krishna & Kalra 2000");
  som->add_option("--recipe", options.recipe, "worlds, scales, iterations and seed")
      ->capture_default_str();
  som->add_option("-o,--output", options.output, "the file to write (stdout)");
  som->callback([&] { outcome.status = train_som_command(options); });
}

void add_train_neuro_fuzzy(CLI::App& train, TrainNeuroFuzzyOptions& options, Outcome& outcome) {
  CLI::App* app =
      train.add_subcommand("neuro-fuzzy", "The wheel speed networks of Wang, Yang & Meng");
  app->add_option("--recipe", options.recipe, "groups, iterations, learning rates, worlds and seed")
      ->capture_default_str();
  app->add_option("--recording", options.recording,
                  "learn from the commands of a run with infrared rangers, not from the expert");
  app->add_option("-o,--output", options.output, "the file to write (stdout)");
  app->add_option("--curves", options.curves, "write the learning curves to FILE.svg");
  app->callback([&] { outcome.status = train_neuro_fuzzy_command(options); });
}

// Names that later versions will use.
void add_reserved(CLI::App& main, Outcome& outcome) {
  for (const char* name : {"topic", "view", "bridge", "doctor"}) {
    CLI::App* app = main.add_subcommand(name, "not in this version");
    app->group("");
    app->allow_extras();
    app->callback([&outcome, name] {
      outcome.status = complain({std::string(name) + ": not in this version", {}, 0, 0});
    });
  }
}

/// Gives each command the flag --version that the program has.
void add_versions(CLI::App& app) {
  app.set_version_flag("--version", version_text());
  for (CLI::App* command : app.get_subcommands({})) {
    command->set_version_flag("--version", version_text());
  }
}

/// CLI11 would only say that a command is required.
core::Result<void> check_command(const CLI::App& app, const std::string& name) {
  if (name.empty() || name.front() == '-') return {};
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return {};
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  return core::Error{core::unknown_name("command", name, known), {}, 0, 0};
}

core::Result<void> check_commands(const CLI::App& app, int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  CLEW_RETURN_IF_ERROR(check_command(app, command));
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
    const bool has_commands = known->get_require_subcommand_min() > 0;
    if (argc > 2 && known->get_name() == command && has_commands) {
      return check_command(*known, argv[2]);
    }
  }
  return {};
}

/// CLI11 would rather name an argument that is missing than an option that nobody knows.
core::Result<void> check_options(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    CLEW_RETURN_IF_ERROR(check_options(*command));
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // kept for later
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word.size() < 2 || word.front() != '-') continue;
    return core::Error{core::unknown_name("option", word, known), {}, 0, 0};
  }
  return {};
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Sensor-based navigation of a mobile robot as a graph of DDS components", "clew");
  app.require_subcommand(1);
  Outcome outcome;
  RunOptions run;
  BenchCommandOptions bench;
  CheckOptions check;
  ListOptions list;
  ComponentOptions component;
  RecorderOptions recorder;
  PlotOptions plot;
  InfoOptions info;
  DiffOptions diff;
  ReplayOptions replay;
  TrainSomOptions train_som;
  TrainNeuroFuzzyOptions train_neuro_fuzzy;
  add_run(app, run, outcome);
  add_bench(app, bench, outcome);
  add_check(app, check, outcome);
  add_list(app, list, outcome);
  add_component(app, component, outcome);
  add_recorder(app, recorder, outcome);
  add_plot(app, plot, outcome);
  add_info(app, info, outcome);
  add_diff(app, diff, outcome);
  add_replay(app, replay, outcome);
  CLI::App* train = app.add_subcommand("train", "Train a network");
  train->require_subcommand(1);
  add_train_som(*train, train_som, outcome);
  add_train_neuro_fuzzy(*train, train_neuro_fuzzy, outcome);
  add_reserved(app, outcome);
  add_versions(app);
  if (const auto known = check_commands(app, argc, argv); !known.ok()) {
    return complain(known.error());
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const auto all_known = check_options(app);
    if (!all_known.ok()) return complain(all_known.error());
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain({fmt::format("{}; --help tells more", error.what()), {}, 0, 0});
  }
  return outcome.status;
}

/// Whether nobody reads standard output any more.
bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// What was said has not arrived, for the reason `number`, or 0 if that is not known any more. A
/// reader that has gone wants no more, also no complaint.
int complain_of_output(int number) {
  if (reader_has_gone()) return kExitFailed;
  const std::string why = number == 0 ? "writing failed" : std::generic_category().message(number);
  return complain({why, "standard output", 0, 0}, kExitFailed);
}

}  // namespace
}  // namespace clew::tools

int main(int argc, char** argv) {
  using namespace clew::tools;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  // Writing reports these instead: a reader that has gone, a file that has reached its limit.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const int status = parse_and_run(argc, argv);
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    return complain_of_output(errno);
  } catch (const std::system_error& error) {  // of fmt::print
    return complain_of_output(error.code().value());
  }
}
