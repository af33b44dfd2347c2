// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "clew/command_line.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/train_commands.hpp"
#include "files/whole_file.hpp"
#include "log/log.hpp"
#include "plot/line_chart.hpp"
#include "train/neuro_fuzzy_start.hpp"
#include "train/training_groups.hpp"

namespace clew::tools {
namespace {

inline constexpr char kDefaultNeuroFuzzyRecipe[] = "wang_yang_meng";
struct TrainNeuroFuzzyOptions {
  std::string recipe = kDefaultNeuroFuzzyRecipe;
  std::string recording;  ///< empty: the expert's runs in the recipe's worlds
  std::string output;
  std::string curves;  ///< an SVG file; empty: none
  bool json = false;
};

using core::Error;
using core::Result;

struct Trained {
  std::string file;
  std::string curves;
  double begun_mps = 0.0;  ///< root mean squared error over the test groups, before training
  double ended_mps = 0.0;  ///< and after it
};

plot::LineChart chart_of(const train::NeuroFuzzyTraining& training,
                         const train::TestErrors& errors) {
  plot::LineChart chart{"Training of the neuro-fuzzy controller",
                        "iteration",
                        "root mean squared error of the wheels' speeds, m/s",
                        {},
                        {}};
  plot::ChartLine train{"training groups", {}};
  plot::ChartLine test{"test groups", {}};
  for (const train::LearningPoint& point : training.curve) {
    const auto iteration = static_cast<double>(point.iteration);
    train.points.push_back({iteration, point.train_mps});
    test.points.push_back({iteration, point.test_mps});
  }
  chart.lines = {train, test};
  chart.levels = {{"32 rules, untrained (test)", errors.rules_mps},
                  {"128 rules, interpolated (test)", errors.interpolated_mps},
                  {"128 rules, filled (test)", errors.filled_mps}};
  return chart;
}

std::string command_of(const TrainNeuroFuzzyOptions& options) {
  std::string command = "clew train neuro-fuzzy";
  if (options.recipe != kDefaultNeuroFuzzyRecipe) command += " --recipe " + options.recipe;
  if (!options.recording.empty()) command += " --recording FILE";
  return command;
}

Result<Trained> train(const TrainNeuroFuzzyOptions& options) {
  const auto path = runtime::ConfigPath::from_environment();
  const auto file = path.find("training", options.recipe);
  if (!file.ok()) return file.error();
  const auto recipe = train::NeuroFuzzyRecipe::parse(*file);
  if (!recipe.ok()) return recipe.error();
  const auto rules = path.find("rulebases", recipe->start);
  if (!rules.ok()) return rules.error();
  const auto start = control::NeuroFuzzyNets::parse(*rules);
  if (!start.ok()) return start.error();
  if (recipe->each_network && !options.recording.empty()) {
    return Error{
        "tells only the speeds of wheels; the recipe's 'learn: networks' needs the expert's "
        "opinion of each network: leave out the key, or --recording",
        options.recording};
  }
  const auto shown = options.recording.empty()
                         ? train::groups_of_expert(*recipe, path)
                         : train::groups_of_recording(*recipe, options.recording);
  if (!shown.ok()) return shown.error();
  const auto groups = train::draw_groups(*recipe, shown->groups);
  if (!groups.ok()) return Error{groups.error().message, options.recording};
  const auto begun = train::start_networks(*recipe, *start, *groups);
  if (!begun.ok()) return Error{begun.error().message, options.recording};
  const auto training = train::train_neuro_fuzzy(*recipe, *begun, *groups);
  const auto errors = train::compare(training, *begun, *groups);
  return Trained{train::trained_file(*recipe, training, errors, command_of(options), shown->origin),
                 plot::draw(chart_of(training, errors)), errors.rules_mps, errors.trained_mps};
}

/// Writes what was asked for; the trained file, in stdout's place, last.
Result<void> deliver(const Trained& trained, const TrainNeuroFuzzyOptions& options) {
  if (!options.curves.empty()) {
    CLEW_RETURN_IF_ERROR(files::write_file(options.curves, trained.curves));
  }
  if (!options.output.empty()) return files::write_file(options.output, trained.file);
  fmt::print("{}", trained.file);
  return {};
}

/// A training that ends worse than it began is written nowhere.
int refuse(const Trained& trained) {
  return complain({fmt::format("training made it worse: {:.3f} m/s over the test groups before it, "
                               "{:.3f} after; nothing was written. Lower the recipe's "
                               "learning_rates, raise iterations or groups, or lay the sets over "
                               "the readings (sets: readings)",
                               trained.begun_mps, trained.ended_mps),
                   {},
                   0,
                   0},
                  kExitFailed);
}

int train_neuro_fuzzy_command(const TrainNeuroFuzzyOptions& options) {
  const auto trained = train(options);
  if (!trained.ok()) return complain(trained.error());
  if (trained->ended_mps > trained->begun_mps) return refuse(*trained);
  const auto delivered = deliver(*trained, options);
  if (!delivered.ok()) return complain(delivered.error());
  if (options.json) {
    fmt::print("{}\n", json_line({{"file", options.output},
                                  {"recipe", options.recipe},
                                  {"error_before_mps", trained->begun_mps},
                                  {"error_after_mps", trained->ended_mps}}));
  } else {
    logs::info("error over the test groups: {:.3f} m/s before training, {:.3f} after",
               trained->begun_mps, trained->ended_mps);
  }
  return kExitGood;
}

}  // namespace

void add_train_neuro_fuzzy(CLI::App& train, int& status) {
  const auto options = std::make_shared<TrainNeuroFuzzyOptions>();
  CLI::App* app =
      train.add_subcommand("neuro-fuzzy", "The wheel speed networks of Wang, Yang & Meng");
  app->add_option("--recipe", options->recipe,
                  "groups, iterations, learning rates, worlds and seed")
      ->capture_default_str();
  app->add_option("--recording", options->recording,
                  "learn from the commands of a run with infrared rangers, not from the expert");
  auto* output = app->add_option("-o,--output", options->output, "the file to write (stdout)")
                     ->check(given_name());
  app->add_flag("--json", options->json, "tell what was written and learnt, as one JSON object")
      ->needs(output);
  app->add_option("--curves", options->curves, "write the learning curves to FILE.svg")
      ->check(given_name());
  app->callback([options, &status] { status = train_neuro_fuzzy_command(*options); });
}

}  // namespace clew::tools
