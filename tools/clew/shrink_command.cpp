// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/property_option.hpp"
#include "clew/terminal.hpp"
#include "files/whole_file.hpp"
#include "hunt/case_file.hpp"
#include "hunt/shrink.hpp"
#include "plot/plot.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using hunt::Shrunk;
using nlohmann::ordered_json;

struct ShrinkCommandOptions {
  std::string world;  ///< or a case
  std::string property;
  hunt::GraphChoice graph;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> plugins;
  std::size_t most_runs = 1000;
  std::string output;
  bool json = false;
};

/// What is shrunk, and the property's text.
struct Subject {
  hunt::RunCase which;
  std::string property;
  std::string property_source;
};

/// A case says all but what the command line says, too.
Result<Subject> read_case(const core::Resource& file, const ShrinkCommandOptions& options) {
  const auto read = hunt::parse_case(file.text, file.file);
  if (!read.ok()) return read.error();
  auto which = hunt::run_of(*read, options.world);
  if (!which.ok()) return which.error();
  const hunt::GraphChoice& typed = options.graph;
  if (!typed.graph.empty()) which->graph.graph = typed.graph;
  if (typed.robot) which->graph.robot = typed.robot;
  if (typed.max_ticks) which->graph.max_ticks = typed.max_ticks;
  which->graph.with.insert(which->graph.with.end(), typed.with.begin(), typed.with.end());
  which->graph.set.insert(which->graph.set.end(), typed.set.begin(), typed.set.end());
  which->seed = options.seed.value_or(which->seed);
  const bool own = options.property.empty();
  return Subject{std::move(which).value(), own ? read->property : options.property,
                 own ? file.file : "--property"};
}

Result<Subject> read_subject(const ShrinkCommandOptions& options) {
  const auto file = runtime::ConfigPath::from_environment().find("worlds", options.world);
  if (!file.ok()) return file.error();
  if (hunt::is_case(file->text, file->file)) return read_case(*file, options);
  if (options.graph.graph.empty()) {
    return Error{"is missing; expected a graph's name or path", "--graph"};
  }
  return Subject{{options.graph, file->text, options.world, options.seed.value_or(1)},
                 options.property,
                 "--property"};
}

/// `minimal.svg` of `minimal.yaml`.
std::string beside(const std::string& output, const char* ending) {
  return std::filesystem::path(output).replace_extension(ending).string();
}

Result<void> draw(const hunt::RunCase& which, const hunt::Workshop& workshop,
                  const std::string& output) {
  const std::string recording = beside(output, ".mcap");
  std::error_code ignored;
  const bool was_there = std::filesystem::exists(recording, ignored);
  if (was_there) return Error{"is in the way of a recording that is drawn", recording};
  CLEW_RETURN_IF_ERROR(hunt::record_case(which, workshop, recording));
  const auto drawn = plot::plot_recordings({recording}, beside(output, ".svg"));
  std::filesystem::remove(recording, ignored);
  return drawn;
}

Result<void> write(const Shrunk& shrunk, const Subject& subject, const hunt::Workshop& workshop,
                   const std::string& output) {
  CLEW_RETURN_IF_ERROR(files::write_file(output, shrunk.which.world_text));
  hunt::CaseFile file;
  file.about = fmt::format("shrunk from {}: {} of {} parts left", subject.which.world_file,
                           shrunk.parts_after, shrunk.parts_before);
  file.property = subject.property;
  file.graph = shrunk.which.graph;
  file.world = std::filesystem::path(output).filename().string();
  file.seed = shrunk.which.seed;
  file.outcome = shrunk.outcome;
  file.hash = shrunk.hash;
  CLEW_RETURN_IF_ERROR(files::write_file(beside(output, ".case.yaml"), hunt::case_text(file)));
  // Its picture is titled with the new file.
  hunt::RunCase written = shrunk.which;
  written.world_file = output;
  return draw(written, workshop, output);
}

void print(const Shrunk& shrunk, const std::string& output) {
  print_text("{} of {} parts of the world are left, {} runs; outcome {}, seed {}\n",
             shrunk.parts_after, shrunk.parts_before, shrunk.runs, shrunk.outcome,
             shrunk.which.seed);
  if (shrunk.end == Shrunk::End::kOutOfRuns) {
    print_text("it may be made smaller still: the runs did not suffice (--runs)\n");
  }
  if (shrunk.end == Shrunk::End::kInterrupted) print_text("interrupted: it may be made smaller\n");
  print_text("world    {}\npicture  {}\ncase     {}\n", output, beside(output, ".svg"),
             beside(output, ".case.yaml"));
  print_text("again    clew hunt --case {}\n         {}\n", beside(output, ".case.yaml"),
             hunt::command_line(shrunk.which.graph, output, shrunk.which.seed));
}

ordered_json to_json(const Shrunk& shrunk, const Subject& subject, const std::string& output) {
  return {{"property", subject.property},
          {"parts_before", shrunk.parts_before},
          {"parts_after", shrunk.parts_after},
          {"runs", shrunk.runs},
          {"minimal", shrunk.end == Shrunk::End::kMinimal},
          {"outcome", shrunk.outcome},
          {"seed", shrunk.which.seed},
          {"hash", shrunk.hash},
          {"world", output},
          {"picture", beside(output, ".svg")},
          {"case", beside(output, ".case.yaml")},
          {"command", hunt::command_line(shrunk.which.graph, output, shrunk.which.seed)}};
}

int shrink_command(const ShrinkCommandOptions& options) {
  auto subject = read_subject(options);
  if (!subject.ok()) return complain(subject.error());
  const auto property = subject->property.empty()
                            ? read_property(options.property)
                            : hunt::Property::parse(subject->property, subject->property_source);
  if (!property.ok()) return complain(property.error());
  const auto loaded = load_plugins_of(options.plugins, subject->which.graph.graph);
  if (!loaded.ok()) return complain(loaded.error());
  const auto configs = runtime::ConfigPath::from_environment();
  const hunt::Workshop workshop{configs, stages::all()};
  hunt::ShrinkOptions how;
  how.most_runs = options.most_runs;
  const bool shows = shows_progress();
  if (shows) {
    how.progress = [](std::size_t runs, std::size_t left) {
      std::fprintf(stderr, "\r\033[K%zu runs, %zu parts left", runs, left);
    };
  }
  const auto shrunk = hunt::shrink(subject->which, *property, workshop, how);
  if (shows) std::fputs("\r\033[K", stderr);
  if (!shrunk.ok()) return complain(shrunk.error());
  if (shrunk->end == Shrunk::End::kHolds || shrunk->end == Shrunk::End::kUndecided) {
    const bool holds = shrunk->end == Shrunk::End::kHolds;
    return complain(
        {fmt::format("the property {} there (outcome {}): there is no failure to shrink",
                     holds ? "holds" : "is undecided", shrunk->outcome),
         subject->which.world_file, 0, 0},
        kExitFailed);
  }
  const auto written = write(*shrunk, *subject, workshop, options.output);
  if (!written.ok()) return complain(written.error());
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*shrunk, *subject, options.output)));
  } else {
    print(*shrunk, options.output);
  }
  return shrunk->end == Shrunk::End::kInterrupted ? kExitInterrupted : kExitGood;
}

}  // namespace

void add_shrink(CLI::App& main, int& status) {
  const auto options = std::make_shared<ShrinkCommandOptions>();
  CLI::App* app = main.add_subcommand("shrink", "Make a world in which a property fails smaller");
  app->add_option("world", options->world, "a name or a path of a world, or a case of clew hunt")
      ->required();
  app->add_option("--graph", options->graph.graph, "a name or a path; a case has its own");
  add_property(*app, options->property);
  app->add_option("-o,--output", options->output,
                  "the world file to write; beside it go a picture, .svg, and a test, .case.yaml")
      ->required()
      ->check(given_name());
  app->add_option("--robot", options->graph.robot, "another robot: a name or a path");
  app->add_option("--with", options->graph.with, "STAGE[.PART]=NAME[,NAME...]: another behaviour")
      ->allow_extra_args(false);
  app->add_option("--set", options->graph.set, "STAGE[.PART][.NAME].PARAM=VALUE: another value")
      ->allow_extra_args(false);
  app->add_option("--seed", options->seed, "of the run that fails (1)")->check(whole_number());
  app->add_option("--max-ticks", options->graph.max_ticks,
                  "time out after this many ticks (the graph's)")
      ->check(CLI::PositiveNumber);
  add_plugins(*app, options->plugins);
  app->add_option("--runs", options->most_runs, "give up after so many (1000)")
      ->check(number_between(1, 1e7));
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = shrink_command(*options); });
}

}  // namespace clew::tools
