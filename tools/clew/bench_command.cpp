// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "bench/bench.hpp"
#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/plugin_options.hpp"
#include "clew/terminal.hpp"
#include "clew/version.hpp"
#include "core/hash128.hpp"
#include "runtime/plugin_list.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct BenchCommandOptions {
  std::string suite;
  std::vector<std::string> graphs;  ///< in place of the suite's
  std::vector<std::string> with;
  std::vector<std::string> set;
  std::vector<std::string> vary;  ///< `PATH=VALUE,VALUE,...`
  std::vector<std::string> plugins;
  std::size_t jobs = 0;  ///< worker processes; 0: one a core
  std::string out;       ///< empty: out/bench/SUITE
  bool force = false;
  bool json = false;
  std::string write_worlds;  ///< a directory for the generated worlds, instead of running
};

using core::Result;
using Clock = std::chrono::steady_clock;

/// What of the program the results depend on: all of it.
Result<std::string> program_text() {
  std::FILE* file = std::fopen("/proc/self/exe", "rb");
  if (file == nullptr) return core::Error{"cannot be read", "/proc/self/exe", 0, 0};
  std::string bytes;
  char buffer[1 << 16];
  for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
    bytes.append(buffer, got);
  }
  std::fclose(file);
  return fmt::format("{} (build {})", CLEW_VERSION, core::hash128(bytes).hex());
}

Result<bench::BenchPlan> make_plan(const BenchCommandOptions& options,
                                   const runtime::ConfigPath& configs) {
  const auto file = configs.find("suites", options.suite);
  if (!file.ok()) return file.error();
  const auto suite = bench::read_suite(*file, options.suite);
  if (!suite.ok()) return suite.error();
  CLEW_RETURN_IF_ERROR(load_plugins_of(options.plugins));
  for (const std::string& graph : options.graphs.empty() ? suite->graphs : options.graphs) {
    CLEW_RETURN_IF_ERROR(load_plugins_of({}, graph));
  }
  bench::BenchChanges changes;
  changes.graphs = options.graphs;
  changes.with = options.with;
  changes.set = options.set;
  for (const std::string& text : options.vary) {
    auto variation = bench::read_variation(text);
    if (!variation.ok()) return variation.error();
    changes.variations.push_back(std::move(variation).value());
  }
  auto plan = bench::plan_bench(*suite, changes, configs, stages::all());
  if (!plan.ok()) return plan.error();
  const auto program = program_text();
  if (!program.ok()) return program.error();
  plan->configuration["clew"] = *program;
  // Results of another plug-in are no results of this one.
  for (const auto& plugin : runtime::loaded_plugins()) {
    plan->configuration["plugin " + plugin.name] = plugin.digest;
  }
  return plan;
}

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// A line on the terminal, now and then; nothing in a pipe.
std::function<void(std::size_t, std::size_t, std::size_t)> terminal_progress() {
  if (!is_terminal(STDERR_FILENO)) return {};
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
  if (is_terminal(STDERR_FILENO)) std::fputs("\r\033[K", stderr);
}

int write_worlds_of(const bench::BenchPlan& plan, const std::string& directory) {
  const auto count = bench::write_worlds(plan, directory);
  if (!count.ok()) return complain(count.error());
  fmt::print("{} worlds and their pictures in {}\n", *count, directory);
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

int bench_command(const BenchCommandOptions& options) {
  const auto configs = runtime::ConfigPath::from_environment();
  const auto plan = make_plan(options, configs);
  if (!plan.ok()) return complain(plan.error());
  if (!options.write_worlds.empty()) return write_worlds_of(*plan, options.write_worlds);

  bench::BenchOptions bench;
  bench.directory = options.out.empty() ? default_directory(options.suite) : options.out;
  bench.jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  bench.restart = options.force;
  bench.progress = terminal_progress();
  const auto end = bench::run_bench(*plan, configs, stages::all(), bench);
  clear_progress();
  if (!end.ok()) return complain(end.error());
  if (end->interrupted_by != 0) {
    std::fprintf(stderr, "clew: interrupted; the same command goes on from %s\n",
                 bench.directory.c_str());
    return kExitInterrupted;
  }
  if (options.json) {
    for (const std::string& line : end->lines) fmt::print("{}\n", line);
    return kExitGood;
  }
  for (const std::string& remark : end->report.remarks) fmt::print("{}\n\n", remark);
  fmt::print("{}\n{}/report.html, report.md, results.csv, results.jsonl\n",
             bench::to_markdown(end->report.tables.front()), bench.directory);
  return kExitGood;
}

}  // namespace

void add_bench(CLI::App& main, int& status) {
  const auto options = std::make_shared<BenchCommandOptions>();
  CLI::App* app = main.add_subcommand("bench", "Run graphs in all worlds of a suite, and compare");
  app->add_option("suite", options->suite, "a name or a path")->required();
  app->add_option("--graph", options->graphs, "in place of the suite's graphs; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--with", options->with, "STAGE[.PART]=NAME[,NAME...]: in every graph")
      ->allow_extra_args(false);
  app->add_option("--set", options->set, "STAGE[.PART][.NAME].PARAM=VALUE: in every graph")
      ->allow_extra_args(false);
  app->add_option(
         "--vary", options->vary,
         "STAGE.PART=NAME,NAME,... or STAGE...PARAM=VALUE,VALUE,...: every graph with each "
         "of them; A+B is the list of A and B; repeated: all combinations, and two make a "
         "matrix in the report")
      ->allow_extra_args(false);
  add_plugins(*app, options->plugins);
  app->add_option("--jobs", options->jobs, "worker processes (one a core)")
      ->check(number_between(1, 1024));
  app->add_option("--out", options->out,
                  "directory for results and report (out/bench/SUITE); results that are there are "
                  "gone on from")
      ->check(file_to_write());
  app->add_flag("--force", options->force, "drop existing results");
  app->add_flag("--json", options->json, "print one JSON object a run");
  app->add_option("--write-worlds", options->write_worlds,
                  "write the generated worlds and their pictures to a directory, run nothing");
  app->callback([options, &status] { status = bench_command(*options); });
}

}  // namespace clew::tools
