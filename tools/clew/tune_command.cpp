// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/own_program.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/terminal.hpp"
#include "log/log.hpp"
#include "runtime/plugin_list.hpp"
#include "stages/all.hpp"
#include "tune/tune.hpp"

namespace clew::tools {
namespace {

using nlohmann::ordered_json;
using tune::Score;
using tune::Tuned;

struct TuneCommandOptions {
  tune::TuneRequest request;
  std::vector<std::string> plugins;
  std::size_t evaluations = 60;
  std::uint64_t seed = 1;
  std::size_t jobs = 0;
  std::string out;
  bool force = false;
  bool json = false;
};

ordered_json to_json(const Score& score) {
  const auto interval = bench::wilson_interval(score.successes, score.runs);
  return {{"runs", score.runs},
          {"successes", score.successes},
          {"success_interval", {interval.low, interval.high}},
          {"cost", score.cost}};
}

ordered_json to_json(const Tuned& tuned) {
  ordered_json json = {{"settings", tuned.settings},
                       {"evaluations", tuned.evaluations},
                       {"default_tuning", to_json(tuned.default_tuning)},
                       {"best_tuning", to_json(tuned.best_tuning)},
                       {"default_validation", to_json(tuned.default_validation)},
                       {"best_validation", to_json(tuned.best_validation)},
                       {"only_default", tuned.only_default},
                       {"only_best", tuned.only_best},
                       {"mcnemar_p", bench::mcnemar_p(tuned.only_default, tuned.only_best)},
                       {"median_gain", tuned.median_gain}};
  json["median_gain_interval"] = nullptr;
  if (tuned.gain_interval) {
    json["median_gain_interval"] = {tuned.gain_interval->low, tuned.gain_interval->high};
  }
  return json;
}

void print_score(const char* what, const Score& score) {
  const auto interval = bench::wilson_interval(score.successes, score.runs);
  print_text("  {:<14} {:>4} of {} succeeded ({:.0f} to {:.0f} %), cost {:.3f}\n", what,
             score.successes, score.runs, 100.0 * interval.low, 100.0 * interval.high, score.cost);
}

void print(const Tuned& tuned, const TuneCommandOptions& options) {
  print_text("best of {} settings:\n ", tuned.evaluations);
  for (const std::string& setting : tuned.settings) print_text(" --set {}", setting);
  print_text("\n\nwhere it was tuned:\n");
  print_score("graph's own", tuned.default_tuning);
  print_score("best", tuned.best_tuning);
  print_text("\nin worlds that it was not tuned in:\n");
  print_score("graph's own", tuned.default_validation);
  print_score("best", tuned.best_validation);
  print_text("  {} runs succeeded with the graph's own only, {} with the best only: p = {:.3f}\n",
             tuned.only_default, tuned.only_best,
             bench::mcnemar_p(tuned.only_default, tuned.only_best));
  print_text("  median difference in cost {:+.3f}", tuned.median_gain);
  if (tuned.gain_interval) {
    print_text(" ({:+.3f} to {:+.3f})", tuned.gain_interval->low, tuned.gain_interval->high);
  }
  print_text(", below 0 is better\n\nall runs: {}/runs.jsonl\n", options.out);
}

std::function<void(std::size_t, std::optional<double>)> terminal_progress() {
  if (!shows_progress()) return {};
  return [](std::size_t runs, std::optional<double> best) {
    const std::string cost = best ? fmt::format(", least cost {:.3f}", *best) : std::string();
    std::fprintf(stderr, "\r\033[K%zu runs%s", runs, cost.c_str());
  };
}

int tune_command(TuneCommandOptions& options) {
  const auto loaded = load_plugins_of(options.plugins, options.request.graph);
  if (!loaded.ok()) return complain(loaded.error());
  const auto configs = runtime::ConfigPath::from_environment();
  const auto space = tune::make_space(options.request, configs, stages::all());
  if (!space.ok()) return complain(space.error());
  if (options.out.empty()) {
    options.out = "out/tune/" + std::filesystem::path(options.request.graph).stem().string();
  }
  tune::TuneOptions how;
  how.evaluations = options.evaluations;
  how.seed = options.seed;
  how.jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  how.directory = options.out;
  how.restart = options.force;
  const auto program = program_fingerprint();
  if (!program.ok()) return complain(program.error());
  how.configuration["clew"] = *program;
  for (const auto& plugin : runtime::loaded_plugins()) {
    how.configuration["plugin " + plugin.name] = plugin.digest;
  }
  how.progress = terminal_progress();
  const auto tuned = tune::tune(*space, {configs, stages::all()}, how);
  if (how.progress) std::fputs("\r\033[K", stderr);
  if (!tuned.ok()) return complain(tuned.error());
  if (tuned->interrupted_by != 0) {
    logs::info("interrupted; the same command goes on from {}", options.out);
    return kExitInterrupted;
  }
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*tuned)));
  } else {
    print(*tuned, options);
  }
  return kExitGood;
}

}  // namespace

void add_tune(CLI::App& main, int& status) {
  const auto options = std::make_shared<TuneCommandOptions>();
  tune::TuneRequest& request = options->request;
  CLI::App* app = main.add_subcommand("tune", "Search parameters that do best over a suite");
  app->add_option("graph", request.graph, "a name or a path")->required();
  app->add_option("--over", request.suite, "a suite: its worlds and seeds")->required();
  app->add_option("--set", request.set,
                  "STAGE...PARAM=LOW..HIGH: a range to search, of whole numbers if both ends are; "
                  "STAGE...PARAM=VALUE: a value")
      ->required()
      ->allow_extra_args(false);
  app->add_option("--validate", request.validate,
                  "a suite of other worlds to validate on (every second world of each family)");
  app->add_option("--with", request.with, "STAGE[.PART]=NAME[,NAME...]: another behaviour")
      ->allow_extra_args(false);
  app->add_option("--robot", request.robot, "another robot: a name or a path");
  app->add_option("--max-ticks", request.max_ticks, "time out after this many ticks (the suite's)")
      ->check(CLI::PositiveNumber);
  add_plugins(*app, options->plugins);
  app->add_option("--evaluations", options->evaluations, "settings to try, at least (60)")
      ->check(number_between(1, 1e6));
  app->add_option("--seed", options->seed, "of the search (1)")->check(whole_number());
  app->add_option("--jobs", options->jobs, "worker processes (one a core); changes no result")
      ->check(number_between(1, 1024));
  app->add_option("--out", options->out,
                  "directory for results (out/tune/GRAPH); those that are there are gone on from")
      ->check(given_name());
  app->add_flag("--force", options->force, "drop existing results");
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = tune_command(*options); });
}

}  // namespace clew::tools
