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
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/property_option.hpp"
#include "clew/terminal.hpp"
#include "hunt/case_file.hpp"
#include "hunt/hunt.hpp"
#include "hunt/hunt_space.hpp"
#include "log/log.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using hunt::HuntEnd;
using hunt::HuntRun;
using nlohmann::ordered_json;

struct HuntCommandOptions {
  hunt::HuntRequest request;
  std::string property;
  std::string case_file;
  std::vector<std::string> plugins;
  std::string out;
  std::size_t runs = 200;
  std::uint64_t seed = 1;
  std::size_t jobs = 0;
  bool keep_start = false;
  bool force = false;
  bool fields = false;
  bool json = false;
};

std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "-";
}

/// The runs that held by the least, nearest first.
std::vector<const HuntRun*> nearest_misses(const HuntEnd& end, std::size_t most) {
  std::vector<const HuntRun*> runs;
  for (const HuntRun& run : end.runs) {
    if (run.verdict.holds == true) runs.push_back(&run);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const HuntRun* a, const HuntRun* b) {
    return *a->verdict.robustness < *b->verdict.robustness;
  });
  if (runs.size() > most) runs.resize(most);
  return runs;
}

ordered_json to_json(const HuntEnd& end, const HuntCommandOptions& options,
                     const std::vector<std::string>& cases) {
  ordered_json json = {{"property", options.property},
                       {"graph", options.request.graph},
                       {"seed", options.seed},
                       {"runs", end.runs.size()},
                       {"held", end.held()},
                       {"failed", end.failures()},
                       {"undecided", end.undecided()},
                       {"refused", end.refusals()},
                       {"out", options.out}};
  const auto nearest = nearest_misses(end, 1);
  json["nearest_miss"] = nullptr;
  if (!nearest.empty()) json["nearest_miss"] = ordered_json::parse(nearest.front()->line);
  json["cases"] = ordered_json::array();
  std::size_t next = 0;
  for (const HuntRun& run : end.runs) {
    if (!run.failed()) continue;
    ordered_json one = ordered_json::parse(run.line);
    one["case"] = cases[next++];
    json["cases"].push_back(std::move(one));
  }
  return json;
}

void print_runs(const std::vector<const HuntRun*>& runs, const std::vector<std::string>& cases) {
  const auto line = [&](auto index, const std::string& robustness, const std::string& outcome,
                        const std::string& world, const std::string& where) {
    const std::string start = fmt::format("{:>6} {:>10} {:<12} ", index, robustness, outcome);
    // Nothing goes beyond the last word of a line.
    print_text("{}{}\n", start, where.empty() ? world : fmt::format("{:<28} {}", world, where));
  };
  line("run", "robustness", "outcome", "world", cases.empty() ? "" : "case");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    line(runs[i]->index, number_text(runs[i]->verdict.robustness), runs[i]->outcome, runs[i]->world,
         cases.empty() ? "" : cases[i]);
  }
}

void print(const HuntEnd& end, const HuntCommandOptions& options,
           const std::vector<std::string>& cases) {
  print_text("{} runs: the property held in {} and failed in {}", end.runs.size(), end.held(),
             end.failures());
  if (end.undecided() > 0) print_text(", {} were undecided", end.undecided());
  if (end.refusals() > 0) print_text(", {} could not be made", end.refusals());
  print_text("\n");
  std::vector<const HuntRun*> failures;
  for (const HuntRun& run : end.runs) {
    if (run.failed()) failures.push_back(&run);
    if (!run.refused.empty()) logs::warning("run {}: {}", run.index, run.refused);
  }
  if (!failures.empty()) {
    print_text("\nfailures:\n");
    print_runs(failures, cases);
    print_text("\nmake one smaller: clew shrink {} -o minimal.yaml\n", cases.front());
  }
  const auto nearest = nearest_misses(end, 5);
  if (!nearest.empty()) {
    print_text("\nnearest misses:\n");
    print_runs(nearest, {});
  }
  print_text("\nall runs: {}/runs.jsonl\n", options.out);
}

/// What is there is somebody's, unless --force drops it.
Result<void> prepare_directory(const HuntCommandOptions& options) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(fs::path(options.out) / "runs.jsonl", error)) return {};
  if (!options.force) return Error{"holds a hunt already; --force drops it", options.out};
  fs::remove_all(fs::path(options.out) / "cases", error);
  fs::remove(fs::path(options.out) / "runs.jsonl", error);
  return {};
}

std::function<void(std::size_t, std::size_t)> terminal_progress(std::size_t total) {
  if (!shows_progress()) return {};
  return [total](std::size_t done, std::size_t failed) {
    std::fprintf(stderr, "\r\033[K%zu of %zu runs, %zu failures", done, total, failed);
  };
}

int search(HuntCommandOptions& options, const hunt::Property& property) {
  const auto configs = runtime::ConfigPath::from_environment();
  options.request.moves_start = !options.keep_start;
  const auto space = hunt::make_space(options.request, configs, stages::all());
  if (!space.ok()) return complain(space.error());
  if (options.out.empty()) {
    options.out = "out/hunt/" + std::filesystem::path(options.request.graph).stem().string();
  }
  const auto prepared = prepare_directory(options);
  if (!prepared.ok()) return complain(prepared.error());
  hunt::HuntOptions how;
  how.runs = options.runs;
  how.seed = options.seed;
  how.jobs = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  how.progress = terminal_progress(options.runs);
  const hunt::Workshop workshop{configs, stages::all()};
  const auto end = hunt::hunt(*space, property, workshop, how);
  if (how.progress) std::fputs("\r\033[K", stderr);
  if (!end.ok()) return complain(end.error());
  const auto cases = hunt::write_hunt(*end, *space, property, workshop, options.out);
  if (!cases.ok()) return complain(cases.error());
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*end, options, *cases)));
  } else {
    print(*end, options, *cases);
  }
  if (end->interrupted_by != 0) return kExitInterrupted;
  return end->failures() == 0 ? kExitGood : kExitFailed;
}

/// A case that was found before, once more.
int repeat_case(const HuntCommandOptions& options) {
  const auto configs = runtime::ConfigPath::from_environment();
  const auto file = configs.find("cases", options.case_file);
  if (!file.ok()) return complain(file.error());
  const auto read = hunt::parse_case(file->text, file->file);
  if (!read.ok()) return complain(read.error());
  const auto loaded = load_plugins_of({}, read->graph.graph);
  if (!loaded.ok()) return complain(loaded.error());
  const auto property = options.property.empty()
                            ? hunt::Property::parse(read->property, file->file)
                            : hunt::Property::parse(options.property, "--property");
  if (!property.ok()) return complain(property.error());
  const auto which = hunt::run_of(*read, options.case_file);
  if (!which.ok()) return complain(which.error());
  const auto outcome = hunt::run_case(*which, *property, {configs, stages::all()});
  if (!outcome.ok()) return complain(outcome.error());
  if (!*outcome) return kExitInterrupted;
  const auto verdict = property->judge((*outcome)->values);
  const bool same = read->hash.empty() || read->hash == (*outcome)->hash;
  const std::string word = (*outcome)->values.word(hunt::Field::kOutcome);
  if (options.json) {
    ordered_json json = {{"property", property->text()}, {"outcome", word}};
    json["holds"] = verdict.holds ? ordered_json(*verdict.holds) : ordered_json(nullptr);
    json["robustness"] =
        verdict.robustness ? ordered_json(*verdict.robustness) : ordered_json(nullptr);
    json["hash"] = (*outcome)->hash;
    json["as_recorded"] = same;
    fmt::print("{}\n", json_line(json));
  } else {
    print_text("{}: the property {}; outcome {}, robustness {}\n", options.case_file,
               !verdict.holds   ? "is undecided"
               : *verdict.holds ? "holds"
                                : "fails",
               word, number_text(verdict.robustness));
    if (!same) print_text("the run differs from the one that the case was written of\n");
  }
  return verdict.holds == true ? kExitGood : kExitFailed;
}

int hunt_command(HuntCommandOptions& options) {
  if (options.fields) {
    print_fields();
    return kExitGood;
  }
  const auto loaded = load_plugins_of(options.plugins, options.request.graph);
  if (!loaded.ok()) return complain(loaded.error());
  const bool has_graph = !options.request.graph.empty();
  if (has_graph == !options.case_file.empty()) {
    return complain({"expected either a graph or --case FILE", {}, 0, 0});
  }
  if (!has_graph) return repeat_case(options);
  const auto property = read_property(options.property);
  return property.ok() ? search(options, *property) : complain(property.error());
}

void add_where(CLI::App& app, HuntCommandOptions& options) {
  hunt::HuntRequest& request = options.request;
  app.add_option("--worlds", request.suite, "a suite: its worlds, as they are");
  app.add_option("--world", request.worlds, "a name or a path, with * and ?; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--family", request.families,
                 "of generated worlds: any world of it; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--robot", request.robot, "another robot: a name or a path");
  app.add_option("--with", request.with, "STAGE[.PART]=NAME[,NAME...]: another behaviour")
      ->allow_extra_args(false);
  app.add_option("--set", request.set,
                 "STAGE...PARAM=VALUE: another value; STAGE...PARAM=LOW..HIGH: any value between, "
                 "a whole one if both ends are")
      ->allow_extra_args(false);
  app.add_option("--max-ticks", request.max_ticks, "time out after this many ticks (6000)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--keep-start", options.keep_start,
               "leave start and heading as each world has them");
}

}  // namespace

void add_hunt(CLI::App& main, int& status) {
  const auto options = std::make_shared<HuntCommandOptions>();
  CLI::App* app = main.add_subcommand("hunt", "Search runs for one in which a property fails");
  app->add_option("graph", options->request.graph, "a name or a path");
  add_property(*app, options->property);
  add_where(*app, *options);
  add_plugins(*app, options->plugins);
  app->add_option("--runs", options->runs, "so many at most (200)")->check(number_between(1, 1e7));
  app->add_option("--seed", options->seed, "of the search (1)")->check(whole_number());
  app->add_option("--jobs", options->jobs, "worker processes (one a core); changes no result")
      ->check(number_between(1, 1024));
  app->add_option("--out", options->out, "directory for cases and runs.jsonl (out/hunt/GRAPH)")
      ->check(given_name());
  app->add_flag("--force", options->force, "drop the hunt that is there");
  app->add_option("--case", options->case_file, "run a case again, instead of searching");
  app->add_flag("--fields", options->fields, "list what a property may speak of");
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = hunt_command(*options); });
}

}  // namespace clew::tools
