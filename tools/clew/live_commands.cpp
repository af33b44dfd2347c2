// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/run_layout.hpp"
#include "line/command_desk.hpp"
#include "runtime/goals.hpp"

namespace clew::tools {
namespace {

using bridge::RunCommand;

struct LiveOptions {
  std::string run;
  std::vector<std::string> with;
  std::vector<std::string> set;
  std::vector<std::string> places;
  bool cancel = false;
  std::optional<std::uint64_t> at;
  std::uint64_t ticks = 1;
  std::string pace;
  bool json = false;
};

/// Tells the run, and prints from which tick on it holds.
int tell(const LiveOptions& options, const RunCommand& command, const std::string& what) {
  const auto answer = bridge::command_run(options.run, command);
  if (!answer.ok()) return complain(answer.error());
  if (options.json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"run", options.run}, {"tick", answer->tick}}.dump());
  } else {
    fmt::print("{} at tick {}\n", what, answer->tick);
  }
  return kExitGood;
}

int swap_command(const LiveOptions& options) {
  RunCommand command{RunCommand::Kind::kChange, options.with, options.at};
  command.changes.insert(command.changes.end(), options.set.begin(), options.set.end());
  if (command.changes.empty()) {
    return complain(
        {"what is to be changed? STAGE.PART=NAME, or --set STAGE.PARAM=VALUE", {}, 0, 0});
  }
  return tell(options, command, "changes");
}

/// Places as typed: way-points `X,Y[,RADIUS...]`, or the numbers of one place.
core::Result<world::Goals> read_places(const std::vector<std::string>& places) {
  const bool has_comma = std::any_of(places.begin(), places.end(), [](const std::string& place) {
    return place.find(',') != std::string::npos;
  });
  return runtime::parse_goals(fmt::format("{}", fmt::join(places, has_comma ? "/" : ",")));
}

int goal_command(const LiveOptions& options) {
  if (options.cancel == !options.places.empty()) {
    return complain({"where to? X Y [RADIUS], way-points X,Y[,RADIUS]..., or --cancel", {}, 0, 0});
  }
  const auto goals =
      options.cancel ? core::Result<world::Goals>(world::Goals{}) : read_places(options.places);
  if (!goals.ok()) return complain(goals.error());
  const std::string what = options.cancel       ? "no goal, the robot waits,"
                           : goals->size() == 1 ? "new goal"
                                                : fmt::format("{} way-points", goals->size());
  return tell(options, {RunCommand::Kind::kChange, {runtime::goals_change(*goals)}, options.at},
              what);
}

int pace_command(const LiveOptions& options) {
  const auto speed = read_pace(options.pace);
  if (!speed.ok()) return complain(speed.error());
  if (speed->pace == bridge::Pace::kRealtime) {
    return complain(
        {"a run is in real time from its beginning or not at all; 1x is as fast", "--pace", 0, 0});
  }
  RunCommand command{RunCommand::Kind::kPace};
  command.pace_factor = speed->pace == bridge::Pace::kLockstep ? 0.0 : speed->factor;
  return tell(options, command, "another pace");
}

CLI::App* add_command(CLI::App& main, const char* name, const char* about,
                      const std::shared_ptr<LiveOptions>& options) {
  CLI::App* app = main.add_subcommand(name, about);
  app->add_option("run", options->run, "the number of its domain, or its name (run --name)")
      ->required();
  app->add_flag("--json", options->json, "print the tick as a JSON object");
  return app;
}

void add_order(CLI::App& main, int& status, const char* name, const char* about,
               RunCommand::Kind kind, const char* done) {
  const auto options = std::make_shared<LiveOptions>();
  CLI::App* app = add_command(main, name, about, options);
  if (kind == RunCommand::Kind::kStep) {
    app->add_option("ticks", options->ticks, "how many (1)")->check(number_between(1, 1e9));
  }
  app->callback([options, &status, kind, done] {
    RunCommand command{kind};
    command.ticks = options->ticks;
    status = tell(*options, command, done);
  });
}

}  // namespace

void add_live(CLI::App& main, int& status) {
  const auto add_tick = [](CLI::App& app, LiveOptions& options) {
    app.add_option("--at", options.at, "the tick from which on it holds (as soon as can be)")
        ->check(whole_number());
  };
  const auto swap = std::make_shared<LiveOptions>();
  CLI::App* app = add_command(main, "swap", "Change a behaviour of a run that goes on", swap);
  app->add_option("change", swap->with, "STAGE.PART=NAME[,NAME...]");
  app->add_option("--set", swap->set, "STAGE[.PART][.NAME].PARAM=VALUE: another value")
      ->allow_extra_args(false);
  add_tick(*app, *swap);
  app->callback([swap, &status] { status = swap_command(*swap); });

  const auto goal = std::make_shared<LiveOptions>();
  app = add_command(main, "goal", "Send the robot of a run that goes on somewhere else", goal);
  app->add_option(
      "place", goal->places,
      "X Y [RADIUS [HEADING [TOLERANCE]]] in m and rad (the world's radius, any heading), or "
      "way-points in their order, each X,Y[,RADIUS[,HEADING[,TOLERANCE]]]; the run ends at "
      "the last");
  app->add_flag("--cancel", goal->cancel, "the robot waits where it is until it gets another goal");
  add_tick(*app, *goal);
  app->callback([goal, &status] { status = goal_command(*goal); });

  const auto pace = std::make_shared<LiveOptions>();
  app = add_command(main, "pace", "Let a run go faster or slower", pace);
  app->add_option("pace", pace->pace, "lockstep, or a factor of simulated time: 10x")->required();
  app->callback([pace, &status] { status = pace_command(*pace); });

  using Kind = RunCommand::Kind;
  add_order(main, status, "pause", "Hold a run before its next tick", Kind::kPause, "paused");
  add_order(main, status, "step", "Run ticks of a run that is paused", Kind::kStep, "paused");
  add_order(main, status, "resume", "Let a run that is paused go on", Kind::kResume, "goes on");
  add_order(main, status, "stop", "End a run", Kind::kStop, "stopped");
}

}  // namespace clew::tools
