// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "bench/barn.hpp"
#include "bench/bench.hpp"
#include "bench/merge.hpp"
#include "clew/bench_sweep.hpp"
#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/own_program.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/terminal.hpp"
#include "clew/version.hpp"
#include "log/log.hpp"
#include "runtime/plugin_list.hpp"
#include "stages/all.hpp"
#include "view/page_file.hpp"

namespace clew::tools {
namespace {

struct BenchCommandOptions {
  bench::BenchOrder order;
  std::string shard;               ///< `I/N`; empty: all runs
  std::vector<std::string> merge;  ///< directories of shards, instead of running
  BenchSweepOptions sweep;
  double until_width = 0.0;     ///< 0: all runs
  std::vector<std::string> by;  ///< groupings; empty: the suite's
  std::size_t jobs = 0;         ///< worker processes; 0: one a core
  std::string out;              ///< empty: out/bench/SUITE
  bool force = false;
  bool json = false;
  bool compress = false;
  std::size_t keep = 24;     ///< recordings of runs that failed
  std::string write_worlds;  ///< a directory for the generated worlds, instead of running
};

using core::Result;
using Clock = std::chrono::steady_clock;

/// Loads what the command line names, and what the suite's graphs do.
Result<void> load_plugins_of_bench(const bench::BenchOrder& order,
                                   const std::vector<std::string>& graphs) {
  CLEW_RETURN_IF_ERROR(load_plugins_of(order.plugins));
  for (const std::string& graph : graphs) CLEW_RETURN_IF_ERROR(load_plugins_of({}, graph));
  return {};
}

/// Loads what the command line names, and nothing that a shard does.
Result<void> load_plugins_of_merge(const bench::ShardDirectory& shard,
                                   const std::vector<std::string>& plugins) {
  for (const std::string& name : shard.header.order.plugins) {
    if (std::find(plugins.begin(), plugins.end(), name) == plugins.end()) {
      return core::Error{"was made with the plug-in '" + name + "'; allow it with --plugin " + name,
                         shard.path};
    }
  }
  return load_plugins_of(plugins);
}

/// In place of the suite's groupings, if any.
Result<void> group_by(const std::vector<std::string>& names, bench::BenchPlan& plan) {
  if (names.empty()) return {};
  plan.by.clear();
  for (const std::string& name : names) {
    const auto grouping = bench::read_grouping(name);
    if (!grouping.ok()) return core::Error{grouping.error().message, "--by"};
    plan.by.push_back(*grouping);
  }
  return {};
}

/// The worlds that the suite needs and the user has.
Result<void> read_data(const bench::BenchOrder& order, bench::Suite& suite) {
  if (!suite.needs_barn) {
    if (order.data.empty()) return {};
    return core::Error{"the suite " + suite.name + " needs none; barn does", "--data"};
  }
  if (order.data.empty()) return {};  // the plan says what is missing
  auto worlds = bench::read_barn(order.data);
  if (!worlds.ok()) return worlds.error();
  suite.barn = std::move(worlds).value();
  return {};
}

Result<bench::BenchPlan> make_plan(
    const bench::BenchOrder& order, const runtime::ConfigPath& configs,
    const std::function<Result<void>(const std::vector<std::string>& graphs)>& load) {
  const auto file = configs.find("suites", order.suite);
  if (!file.ok()) return file.error();
  auto suite = bench::read_suite(*file, order.suite);
  if (!suite.ok()) return suite.error();
  CLEW_RETURN_IF_ERROR(read_data(order, *suite));
  CLEW_RETURN_IF_ERROR(load(order.graphs.empty() ? suite->graphs : order.graphs));
  bench::BenchChanges changes;
  changes.graphs = order.graphs;
  changes.with = order.with;
  changes.set = order.set;
  for (const std::string& text : order.vary) {
    auto variation = bench::read_variation(text);
    if (!variation.ok()) return variation.error();
    changes.variations.push_back(std::move(variation).value());
  }
  auto plan = bench::plan_bench(*suite, changes, configs, stages::all());
  if (!plan.ok()) return plan.error();
  const auto program = program_fingerprint();
  if (!program.ok()) return program.error();
  plan->configuration["clew"] = *program;
  if (order.coverage) {
    plan->coverage = true;
    plan->configuration["coverage"] = "counted";
  }
  // Results of another plug-in are no results of this one.
  for (const auto& plugin : runtime::loaded_plugins()) {
    plan->configuration["plugin " + plugin.name] = plugin.digest;
  }
  return plan;
}

/// A line on the terminal, now and then; nothing in a pipe.
std::function<void(std::size_t, std::size_t, std::size_t)> terminal_progress() {
  if (!shows_progress()) return {};
  const auto started_at = Clock::now();
  return [started_at, shown_at = started_at](std::size_t found, std::size_t done,
                                             std::size_t total) mutable {
    const auto now = Clock::now();
    if (now - shown_at < std::chrono::milliseconds(100)) return;
    shown_at = now;
    const double each_s =
        std::chrono::duration<double>(now - started_at).count() / static_cast<double>(done - found);
    std::fprintf(stderr, "\r\033[K%zu of %zu runs, %s left", done, total,
                 duration_text(each_s * static_cast<double>(total - done)).c_str());
  };
}

void clear_progress() {
  if (shows_progress()) std::fputs("\r\033[K", stderr);
}

int write_worlds_of(const bench::BenchPlan& plan, const std::string& directory) {
  const auto count = bench::write_worlds(plan, directory);
  if (!count.ok()) return complain(count.error());
  print_text("{} worlds and their pictures in {}\n", *count, directory);
  return kExitGood;
}

/// The suite's name without folder and ending.
std::string default_directory(const std::string& suite) {
  std::string name = suite.substr(suite.rfind('/') == std::string::npos ? 0 : suite.rfind('/') + 1);
  if (name.size() > 5 && name.compare(name.size() - 5, 5, ".yaml") == 0) {
    name.resize(name.size() - 5);
  }
  return "out/bench/" + name;
}

Result<void> print_runs(const std::string& directory) {
  return bench::visit_runs(directory, [](const std::string& line) { fmt::print("{}\n", line); });
}

/// Says what has come out.
int tell(const bench::BenchEnd& end, const bench::BenchOptions& bench, bool as_json) {
  if (end.interrupted_by != 0) {
    logs::info("interrupted; the same command goes on from {}", bench.directory);
    return kExitInterrupted;
  }
  if (as_json) {
    const auto printed = print_runs(bench.directory);
    return printed.ok() ? kExitGood : complain(printed.error());
  }
  if (bench.shard.count > 1) {
    print_text("shard {}: {} runs in {}; clew bench --merge DIR... --out DIR puts all together\n",
               bench.shard.text(), end.runs, bench.directory);
    return kExitGood;
  }
  for (const std::string& remark : end.report.remarks) print_text("{}\n\n", remark);
  for (std::size_t i = 0; i < end.report.asked_for; ++i) {
    print_text("{}\n", bench::to_markdown(end.report.tables[i]));
  }
  if (end.report.covers) print_text("{}\n", bench::to_markdown(end.report.tables.back()));
  print_text("{}/report.html, report.md, results.csv, results.jsonl{}\n", bench.directory,
             end.report.covers ? ", coverage.csv" : "");
  return kExitGood;
}

Result<bench::BenchEnd> merge(const BenchCommandOptions& options, const bench::BenchOptions& bench,
                              const runtime::ConfigPath& configs) {
  const auto shards = bench::read_shards(options.merge);
  if (!shards.ok()) return shards.error();
  const bench::BenchOrder& order = shards->front().header.order;
  auto plan = make_plan(order, configs, [&](const auto&) {
    return load_plugins_of_merge(shards->front(), options.order.plugins);
  });
  if (!plan.ok()) return plan.error();
  CLEW_RETURN_IF_ERROR(group_by(options.by, *plan));
  return bench::merge_shards(*plan, order, *shards, configs, stages::all(), bench);
}

/// Which directory, which shard, how many workers.
Result<bench::BenchOptions> bench_options(const BenchCommandOptions& options) {
  bench::BenchOptions bench;
  bench.directory = options.out.empty() ? default_directory(options.order.suite) : options.out;
  bench.jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  bench.restart = options.force;
  bench.compress = options.compress;
  bench.keep = options.keep;
  bench.pages = {view::bench_page(), view::page()};
  bench.progress = terminal_progress();
  if (options.shard.empty()) return bench;
  const auto shard = bench::read_shard(options.shard);
  if (!shard.ok()) return shard.error();
  if (options.out.empty()) {
    return core::Error{"needs --out DIR: each shard has a directory of its own", "--shard"};
  }
  bench.shard = *shard;
  return bench;
}

/// Runs it here or on a cluster, or tells only what it would cost.
int run(const bench::BenchPlan& plan, const BenchCommandOptions& options,
        const runtime::ConfigPath& configs, const bench::BenchOptions& bench) {
  BenchSweepOptions sweep = options.sweep;
  sweep.json = options.json;
  if (options.jobs > 0) sweep.cores = options.jobs;
  if (sweep.dry_run) {
    const auto printed = print_cost(plan, configs, bench, sweep);
    return printed.ok() ? kExitGood : complain(printed.error());
  }
  const auto end = sweep.on.empty()
                       ? bench::run_bench(plan, options.order, configs, stages::all(), bench)
                       : run_on_cluster(plan, options.order, configs, bench, sweep);
  clear_progress();
  return end.ok() ? tell(*end, bench, options.json) : complain(end.error());
}

int bench_command(const BenchCommandOptions& options) {
  if (options.merge.empty() && options.order.suite.empty()) {
    return complain({"a suite is required, or --merge; see --help", {}, 0, 0});
  }
  if (!options.merge.empty() && options.out.empty()) {
    return complain({"needs --out DIR for the whole", "--merge", 0, 0});
  }
  const auto bench = bench_options(options);
  if (!bench.ok()) return complain(bench.error());
  const auto configs = runtime::ConfigPath::from_environment();
  if (!options.merge.empty()) {
    const auto end = merge(options, *bench, configs);
    return end.ok() ? tell(*end, *bench, options.json) : complain(end.error());
  }
  auto plan = make_plan(options.order, configs, [&](const auto& graphs) {
    return load_plugins_of_bench(options.order, graphs);
  });
  if (!plan.ok()) return complain(plan.error());
  const auto grouped = group_by(options.by, *plan);
  if (!grouped.ok()) return complain(grouped.error());
  if (options.until_width > 0.0) {
    plan->stopping = bench::Stopping{options.until_width, 0, 0};
    plan->configuration["until_width"] = fmt::format("{}", options.until_width);
  }
  if (!options.write_worlds.empty()) return write_worlds_of(*plan, options.write_worlds);
  return run(*plan, options, configs, *bench);
}

/// The options that change a suite.
void add_order(CLI::App& app, bench::BenchOrder& order) {
  app.add_option("suite", order.suite, "a name or a path");
  app.add_option("--graph", order.graphs, "in place of the suite's graphs; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--with", order.with, "STAGE[.PART]=NAME[,NAME...]: in every graph")
      ->allow_extra_args(false);
  app.add_option("--set", order.set, "STAGE[.PART][.NAME].PARAM=VALUE: in every graph")
      ->allow_extra_args(false);
  app.add_option("--vary", order.vary,
                 "STAGE.PART=NAME,NAME,... or STAGE...PARAM=VALUE,VALUE,...: every graph with each "
                 "of them; A+B is the list of A and B; repeated: all combinations, and two make a "
                 "matrix in the report")
      ->allow_extra_args(false);
  app.add_flag("--coverage", order.coverage,
               "count how often each rule, table cell, neuron and case decided, and which never "
               "did; each run is recorded in passing and fed to its components again");
  app.add_option(
      "--data", order.data,
      "the directory of a suite's worlds that are not part of it: of barn, world_N.world "
      "and path_N.npy");
  add_plugins(app, order.plugins);
}

/// The options of parts of a bench.
void add_shards(CLI::App& app, BenchCommandOptions& options) {
  app.add_option("--shard", options.shard,
                 "I/N: the I-th of N parts only, in a directory of its own");
  CLI::Option* merge = app.add_option("--merge", options.merge,
                                      "directories of all shards of a bench, in any order: makes "
                                      "the whole, in --out; of plug-ins "
                                      "it loads those that --plugin names")
                           ->type_name("DIR");
  for (const char* other :
       {"suite", "--graph", "--with", "--set", "--vary", "--coverage", "--data", "--shard",
        "--jobs", "--write-worlds", "--on", "--shards", "--dry-run", "--until-width"}) {
    merge->excludes(app.get_option(other));
  }
  // Whoever looks at results as they come needs all of them.
  CLI::Option* until_width = app.get_option("--until-width");
  CLI::Option* on = app.get_option("--on");
  app.get_option("--shard")->excludes(on)->excludes(until_width)->excludes(app.get_option("--by"));
  until_width->excludes(on)->excludes(app.get_option("--dry-run"));
}

}  // namespace

void add_bench(CLI::App& main, int& status) {
  const auto options = std::make_shared<BenchCommandOptions>();
  CLI::App* app = main.add_subcommand("bench", "Run graphs in all worlds of a suite, and compare");
  add_order(*app, options->order);
  app->add_option("--by", options->by,
                  fmt::format("also a table of results by {}; may be repeated",
                              fmt::join(bench::grouping_names(), ", ")))
      ->allow_extra_args(false);
  app->add_option("--jobs", options->jobs, "worker processes (one a core)")
      ->check(number_between(1, 1024));
  app->add_option("--out", options->out,
                  "directory for results and report (out/bench/SUITE); results that are there are "
                  "gone on from")
      ->check(given_name());
  app->add_flag("--force", options->force, "drop existing results");
  app->add_flag("--json", options->json, "print one JSON object a run");
  app->add_option("--write-worlds", options->write_worlds,
                  "write the generated worlds and their pictures to a directory, run nothing");
  app->add_flag("--compress", options->compress,
                "leave results.jsonl.zst, as by itself where results have 64 MiB and more");
  app->add_option("--until-width", options->until_width,
                  "run batch after batch until each graph's success is known to so much, as 0.05, "
                  "from one end of its interval to the other")
      ->check(number_between(0.001, 1.0));
  app->add_option("--keep", options->keep,
                  "recordings and reports of so many runs that failed, the worst of each graph "
                  "first (24)")
      ->check(whole_number());
  add_sweep(*app, options->sweep);
  add_shards(*app, *options);
  app->callback([options, &status] { status = bench_command(*options); });
}

}  // namespace clew::tools
