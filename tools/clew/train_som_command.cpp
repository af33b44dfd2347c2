// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "clew/command_line.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/train_commands.hpp"
#include "files/whole_file.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "train/scaled_world.hpp"
#include "train/som_training.hpp"
#include "world/world.hpp"

namespace clew::tools {
namespace {

inline constexpr char kDefaultSomRecipe[] = "krishna_kalra_som";
struct TrainSomOptions {
  std::string recipe = kDefaultSomRecipe;
  std::string output;
  bool json = false;
};

using core::Error;
using core::Resource;
using core::Result;

// The robot of the paper's training runs: fuzzy control up to the target, no memory; classify only
// tells classes.
constexpr char kTrainingGraph[] = R"(world: landmark
robot: disc-015
max_ticks: 1000
sense:    {behaviour: cones}
classify: {behaviour: krishna_kalra, networks: [], som: ""}
control:  {behaviour: krishna_kalra_fuzzy, approach_m: 0}
drive:    {behaviour: turn_then_step}
)";

/// The training graph in one landmark world; everything else as usual.
class LandmarkSource : public runtime::ConfigSource {
 public:
  LandmarkSource(const runtime::ConfigPath& path, Resource world)
      : path_(path), world_(std::move(world)) {}

  Result<Resource> find(const std::string& folder, const std::string& name) const override {
    if (folder == "graphs") return Resource{"training graph", kTrainingGraph};
    if (folder == "worlds") return world_;
    return path_.find(folder, name);
  }

 private:
  const runtime::ConfigPath& path_;
  Resource world_;
};

Result<train::ClassesSeen> run_past(const std::string& name, double scale,
                                    const runtime::ConfigPath& path) {
  const auto file = path.find("worlds", name);
  if (!file.ok()) return file.error();
  const auto world = world::World::parse(file->text, file->file);
  if (!world.ok()) return world.error();
  const LandmarkSource source(path, {file->file, train::scaled_world_yaml(*world, scale)});
  const auto plan = runtime::prepare_run("training", {}, source, stages::all());
  // A copy that is too small for the robot is refused as a world.
  if (!plan.ok() && scale < 1.0) return train::ClassesSeen();
  if (!plan.ok()) return plan.error();
  auto nodes = runtime::make_nodes(*plan);
  if (!nodes.ok()) return nodes.error();
  runtime::ComposedExecutor executor(std::move(nodes).value(), nullptr);
  train::ClassesSeen classes;
  do {
    executor.step();
    classes.push_back(std::get<domain::Landmark>(executor.messages()).spatial_class);
  } while (std::get<domain::State>(executor.messages()).outcome == domain::Outcome::kRunning);
  return classes;
}

Result<std::string> train(const TrainSomOptions& options) {
  const auto path = runtime::ConfigPath::from_environment();
  const auto file = path.find("training", options.recipe);
  if (!file.ok()) return file.error();
  const auto recipe = train::SomRecipe::parse(*file);
  if (!recipe.ok()) return recipe.error();
  std::string command = "clew train som";
  if (options.recipe != kDefaultSomRecipe) command += " --recipe " + options.recipe;
  const auto run = [&path](const std::string& world, double scale) {
    return run_past(world, scale, path);
  };
  return train::train_som(*recipe, run, command);
}

int train_som_command(const TrainSomOptions& options) {
  const auto trained = train(options);
  if (!trained.ok()) return complain(trained.error());
  if (options.output.empty()) {
    fmt::print("{}", *trained);
    return kExitGood;
  }
  const auto written = files::write_file(options.output, *trained);
  if (!written.ok()) return complain(written.error());
  if (options.json) {
    fmt::print("{}\n", json_line({{"file", options.output}, {"recipe", options.recipe}}));
  }
  return kExitGood;
}

}  // namespace

void add_train_som(CLI::App& train, int& status) {
  const auto options = std::make_shared<TrainSomOptions>();
  CLI::App* som = train.add_subcommand("som", "The landmark map of Krishna & Kalra 2000");
  som->add_option("--recipe", options->recipe, "worlds, step of scale, iterations and seed")
      ->capture_default_str();
  auto* output = som->add_option("-o,--output", options->output, "the file to write (stdout)")
                     ->check(given_name());
  som->add_flag("--json", options->json, "tell what was written, as one JSON object")
      ->needs(output);
  som->callback([options, &status] { status = train_som_command(*options); });
}

}  // namespace clew::tools
