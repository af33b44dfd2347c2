// SPDX-License-Identifier: Apache-2.0
#include "clew/run_arguments.hpp"

#include "clew/command_line.hpp"
#include "clew/recording_options.hpp"

namespace clew::tools {
namespace {

void add_ways(CLI::App& app, RunOptions& options) {
  app.add_option("--layout", options.layout,
                 "processes | composed (as the graph says, else processes)")
      ->group("How it runs");
  app.add_option("--middleware", options.middleware,
                 "cyclonedds | fastdds, or STAGE=VENDOR; may be repeated")
      ->allow_extra_args(false)
      ->group("How it runs");
  app.add_option("--pace", options.pace, "lockstep (unless a robot takes part) | realtime | Nx")
      ->group("How it runs");
  app.add_option("--realtime-priority", options.realtime_priority,
                 "1 to 99: first-in-first-out scheduling of component processes (none)")
      ->check(number_between(1, 99))
      ->group("How it runs");
  app.add_option("--domain", options.domain, "DDS domain, 0 to 99 (a free one)")
      ->group("How it runs");
  // A flag with a value, so that it does not take the word after it.
  app.add_flag(
         "--secure{minted}", options.secure,
         "protect what is on the wire (DDS Security) with keys for this run alone, or those of "
         "--secure=DIR; see 'clew keys'")
      ->group("How it runs");
  app.add_flag("--ros2{/}", options.ros2,
               "start 'clew bridge ros2' beside it; --ros2=NAMESPACE: one robot of several")
      ->group("How it runs");
  app.add_option("--name", options.name, "what 'clew swap', 'clew goal' and others call the run")
      ->check(given_name())
      ->group("How it runs");
  app.add_option("--at", options.at,
                 "TICK:STAGE.PART=NAME, TICK:STAGE.PARAM=VALUE or "
                 "TICK:goal=X,Y[,RADIUS[,HEADING[,TOLERANCE]]][/X,Y...]: "
                 "change the "
                 "run from that tick on; may be repeated")
      ->allow_extra_args(false)
      ->group("How it runs");
  app.add_option("--threads", options.threads,
                 "of a fleet: threads that its robots share; the result is the same with any (1)")
      ->check(number_between(1, 64))
      ->group("How it runs");
  app.add_option("--external", options.external, "wait for a STAGE that you start yourself")
      ->allow_extra_args(false)
      ->group("Debugging");
  app.add_option("--profile", options.profile,
                 "tell where the time of a composed run goes, and write a Chrome trace to a file")
      ->check(given_name())
      ->group("Debugging");
  app.add_option("--prefix", options.prefix, "STAGE='gdb --args': start it under a command")
      ->allow_extra_args(false)
      ->group("Debugging");
}

void add_hosts(CLI::App& app, RunOptions& options) {
  app.add_option("--hosts", options.hosts, "a file of hosts, for stages that run on one of them")
      ->check(given_name())
      ->group("How it runs");
  app.add_option("--host", options.host,
                 "STAGE=NAME: on which of them a stage runs, or 'here'; may be repeated")
      ->allow_extra_args(false)
      ->group("How it runs");
  app.add_option("--fallback", options.fallback,
                 "none | local | NAME: where components go whose host is lost: wait for it, or go "
                 "on here or "
                 "on another host")
      ->capture_default_str()
      ->group("How it runs");
}

void add_recording(CLI::App& app, RunOptions& options) {
  const auto add = [&](const char* name, auto& value, const char* about) {
    return app.add_option(name, value, about)->group("Recording");
  };
  add("--record", options.record,
      "write a recording (MCAP); of a fleet: one a robot into this folder")
      ->check(given_name());
  app.add_flag("--force", options.force, "overwrite the recording")->group("Recording");
  add("--record-topics", options.record_topics,
      "NAME[,NAME...] or patterns such as 's*': only these topics (all); what lacks topics cannot "
      "be gone on with, and replays the stages whose topics are all there")
      ->delimiter(',')
      ->allow_extra_args(false);
  add("--split-size", options.split_bytes,
      "go on in another file, NAME_1.mcap, ..., when one is as large, not counting what each "
      "repeats "
      "of the run's description: bytes, or with kB, MB, GB")
      ->transform(size_in_bytes(kLeastSplit));
  add("--split-s", options.split_s, "the same after so much simulated time, in seconds")
      ->check(number_between(0.001, 1e6));
  add("--record-on", options.record_on,
      "trap: a black box. If a trap is detected, a collision happens or the run ends badly, it "
      "writes what it kept and then records on");
  add("--record-last", options.record_last_s, "simulated seconds that a black box keeps (30)")
      ->check(number_between(0.001, 86400.0));
  add("--compression", options.compression,
      "none | zstd | lz4 (none: the fastest, and its bytes depend on no compressor's version; zstd "
      "makes it several times smaller)");
  add("--on-record-error", options.on_record_error,
      "stop | continue: what the run does if its recording fails or lacks samples (stop)");
  add("--resume", options.resume, "resume the cut-off run of a recording, instead of a graph");
  add("--exec", options.exec,
      "with --resume: a COMMAND of a component of someone else's, as the recording has it, else "
      "nothing is run; may be repeated")
      ->allow_extra_args(false);
}

/// `--view` alone takes a free port.
void add_view_option(CLI::App& app, RunOptions& options) {
  const auto take = [&options](const CLI::results_t& words) {
    int port = 0;
    const bool free = words.empty() || words.front().empty();
    if (!free && !CLI::detail::lexical_cast(words.front(), port)) return false;
    options.view = port;
    return free || (port > 0 && port <= 65535);
  };
  app.add_option("--view", take,
                 "show it on a web page while it runs; PORT: of 127.0.0.1 (a free one)")
      ->type_name("[PORT]")
      ->expected(0, 1)
      ->group("How it runs");
}

}  // namespace

void add_run_arguments(CLI::App& app, RunOptions& options) {
  add_ways(app, options);
  add_hosts(app, options);
  add_view_option(app, options);
  add_recording(app, options);
  app.add_flag("--json", options.json, "print the result as one JSON object");
  app.add_flag("--no-hash", options.no_hash, "do not hash what is published");
}

}  // namespace clew::tools
