// SPDX-License-Identifier: Apache-2.0
#include "clew/bench_sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/estimate.hpp"
#include "bench/merge.hpp"
#include "bench/noted_signals.hpp"
#include "clew/command_line.hpp"
#include "clew/json_line.hpp"
#include "clew/own_program.hpp"
#include "clew/print_text.hpp"
#include "clew/terminal.hpp"
#include "log/log.hpp"
#include "stages/all.hpp"
#include "sweep/slurm.hpp"
#include "sweep/sweep.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using Clock = std::chrono::steady_clock;

constexpr double kSample_s = 10.0;  // for a sample of runs

/// The queue that --on names.
Result<std::unique_ptr<sweep::JobQueue>> queue_of(const std::string& on) {
  const std::size_t colon = on.find(':');
  const std::string partition = colon == std::string::npos ? "" : on.substr(colon + 1);
  const bool is_plain = partition.find_first_of(" ,") == std::string::npos;
  const bool has_partition = colon == std::string::npos || (!partition.empty() && is_plain);
  if (on.substr(0, colon) != "slurm" || !has_partition) {
    return Error{"found '" + on + "'; allowed: slurm, slurm:PARTITION", "--on"};
  }
  return std::unique_ptr<sweep::JobQueue>(std::make_unique<sweep::Slurm>(partition));
}

/// A line on the terminal; nothing in a pipe.
std::function<void(const sweep::SweepProgress&)> sweep_progress() {
  if (!shows_progress()) return [](const sweep::SweepProgress&) {};
  return [started_at = Clock::now()](const sweep::SweepProgress& progress) {
    const double spent_s = std::chrono::duration<double>(Clock::now() - started_at).count();
    const auto run = static_cast<double>(progress.done - progress.found);
    const std::string left =
        run == 0.0 ? ""
                   : ", " +
                         duration_text(spent_s / run *
                                       static_cast<double>(progress.total - progress.done)) +
                         " left";
    std::fprintf(stderr, "\r\033[K%zu of %zu runs, %zu tasks running, %zu waiting%s", progress.done,
                 progress.total, progress.running, progress.waiting, left.c_str());
  };
}

void say(const std::string& sentence) {
  if (shows_progress()) std::fputs("\r\033[K", stderr);
  logs::info("{}", sentence);
}

/// How a bench is spread: over tasks of a cluster, or over workers here.
struct Spread {
  std::string where;
  std::size_t tasks = 1;
  std::size_t cores = 1;    ///< of a task
  std::size_t at_once = 1;  ///< cores that run at a time
  std::size_t surveys = 0;  ///< of worlds, in all tasks
};

Result<Spread> spread_of(const bench::BenchPlan& plan, const bench::BenchOptions& bench,
                         const BenchSweepOptions& options) {
  Spread spread{"this machine", 1, bench.jobs, bench.jobs, 0};
  if (!options.on.empty()) {
    const auto queue = queue_of(options.on);
    if (!queue.ok()) return queue.error();
    const auto cores = (*queue)->cores();
    if (!cores.ok()) return cores.error();
    const std::size_t tasks = options.shards > 0
                                  ? std::min(options.shards, plan.runs())
                                  : sweep::default_shards(plan, *cores, options.cores);
    spread = {(*queue)->name(), tasks, options.cores, std::min(*cores, tasks * options.cores), 0};
  }
  const bench::Shards shards(plan, spread.tasks);
  for (std::size_t number = 1; number <= spread.tasks; ++number) {
    spread.surveys += shards.units_of(number, spread.cores).size();
  }
  return spread;
}

nlohmann::ordered_json cost_json(const bench::BenchPlan& plan, const bench::Estimate& estimate,
                                 const Spread& spread, double core_s, double wall_s) {
  return {{"runs", plan.runs()},
          {"variants", plan.variants.size()},
          {"worlds", plan.worlds.size()},
          {"seeds", plan.seeds.size()},
          {"sampled", estimate.sampled},
          {"sample_s", estimate.spent_s},
          {"run_s", estimate.run_s},
          {"longest_run_s", estimate.longest_s},
          {"survey_s", estimate.survey_s},
          {"core_s", core_s},
          {"error_share", estimate.error_share},
          {"tasks", spread.tasks},
          {"cores_of_task", spread.cores},
          {"cores_at_once", spread.at_once},
          {"wall_s", wall_s}};
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 10.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

void add_sweep(CLI::App& app, BenchSweepOptions& options) {
  CLI::Option* on =
      app.add_option("--on", options.on,
                     "slurm or slurm:PARTITION: as an array of shards on a cluster, one core a "
                     "task unless --jobs says more; Ctrl-C cancels, the same command goes on");
  app.add_option("--shards", options.shards, "with --on: how many (two a core of the partition)")
      ->check(number_between(1, bench::kMostShards))
      ->needs(on);
  app.add_flag("--dry-run", options.dry_run,
               "run a sample only, 10 s at most, and print what the whole will cost");
}

Result<bench::BenchEnd> run_on_cluster(const bench::BenchPlan& plan, const bench::BenchOrder& order,
                                       const runtime::ConfigPath& configs,
                                       const bench::BenchOptions& bench,
                                       const BenchSweepOptions& options) {
  const auto queue = queue_of(options.on);
  if (!queue.ok()) return queue.error();
  sweep::SweepOptions sweep;
  sweep.directory = bench.directory;
  sweep.program = own_program();
  sweep.shards = options.shards;
  sweep.cores = options.cores;
  sweep.restart = bench.restart;
  sweep.wait = bench::NotedSignals::wait;
  sweep.progress = sweep_progress();
  sweep.say = say;
  Result<sweep::SweepEnd> end = Error{};
  {
    const bench::NotedSignals signals;
    end = sweep::run_sweep(plan, order, sweep, **queue);
    if (end.ok() && end->is_cancelled) return bench::BenchEnd{bench::NotedSignals::noted(), 0, {}};
  }
  if (!end.ok()) return end.error();
  const auto shards = bench::read_shards(end->directories);
  if (!shards.ok()) return shards.error();
  return bench::merge_shards(plan, order, *shards, configs, stages::all(), bench);
}

Result<void> print_cost(const bench::BenchPlan& plan, const runtime::ConfigPath& configs,
                        const bench::BenchOptions& bench, const BenchSweepOptions& options) {
  const auto spread = spread_of(plan, bench, options);
  if (!spread.ok()) return spread.error();
  const auto estimate = bench::estimate_cost(plan, configs, stages::all(), kSample_s);
  if (!estimate.ok()) return estimate.error();
  if (estimate->sampled == 0) return Error{"the sample was interrupted"};
  const double core_s = bench::total_s(plan, *estimate, spread->surveys);
  const double wall_s = core_s / static_cast<double>(spread->at_once);
  if (options.json) {
    fmt::print("{}\n", json_line(cost_json(plan, *estimate, *spread, core_s, wall_s)));
    return {};
  }
  print_text(
      "runs     {}: {} variants x {} worlds x {} seeds\n"
      "sample   {} runs in {}: {} a run, the longest {}; {} before the first run in a world\n"
      "in all   {} of one core; standard error {:.0f} %\n"
      "tasks    {} of {} cores on {}, {} cores at once: about {}\n",
      plan.runs(), plan.variants.size(), plan.worlds.size(), plan.seeds.size(), estimate->sampled,
      duration_text(estimate->spent_s), duration_text(estimate->run_s),
      duration_text(estimate->longest_s), duration_text(estimate->survey_s), duration_text(core_s),
      100.0 * estimate->error_share, spread->tasks, spread->cores, spread->where, spread->at_once,
      duration_text(wall_s));
  return {};
}

}  // namespace clew::tools
