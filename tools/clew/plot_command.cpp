// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/field_chart.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "insides/explanation.hpp"
#include "plot/plot.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct PlotOptions {
  std::vector<std::string> recordings;
  std::string output;
  std::vector<std::string> plugins;
  bool json = false;
  std::optional<std::uint64_t> tick;  ///< what components show of it, instead of the whole run
  std::vector<std::string> fields;    ///< over time, instead of the map
};

using core::Error;
using core::Result;

/// What all components of ours show of a tick; their states are built from the recording.
Result<plot::InsideView> look_inside(const std::string& path, std::uint64_t tick,
                                     const std::vector<std::string>& plugins) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(load_plugins_for(*recording, plugins));
  const auto plan = bridge::recorded_plan(*recording, stages::all());
  if (!plan.ok()) return plan.error();
  plot::InsideView inside;
  inside.tick = tick;
  auto explanations = insides::explain(*recording, *plan, tick, std::nullopt);
  if (!explanations.ok()) return explanations.error();
  for (insides::Explanation& each : *explanations) {
    domain::Picture& picture = each.inside.picture;
    if (!picture.empty()) inside.pictures.push_back(std::move(picture));
  }
  if (inside.pictures.empty()) {
    return Error{fmt::format("no component of ours has something to draw at tick {}", tick), path};
  }
  return inside;
}

Result<void> plot_inside(const PlotOptions& options) {
  if (options.recordings.size() != 1) {
    return Error{
        fmt::format("--tick looks into one recording; found {}", options.recordings.size())};
  }
  const auto inside = look_inside(options.recordings.front(), *options.tick, options.plugins);
  if (!inside.ok()) return inside.error();
  return plot::plot_tick(options.recordings.front(), *inside, options.output);
}

int plot_command(const PlotOptions& options) {
  if (options.tick && !options.fields.empty()) {
    return complain({"--tick and --field are two pictures: leave out one", {}, 0, 0});
  }
  const auto plotted = options.tick ? plot_inside(options)
                       : options.fields.empty()
                           ? plot::plot_recordings(options.recordings, options.output)
                           : plot_fields(options.recordings, options.fields, options.output);
  if (!plotted.ok()) return complain(plotted.error());
  if (options.json) {
    nlohmann::ordered_json json = {{"picture", options.output}, {"recordings", options.recordings}};
    json["tick"] = options.tick ? nlohmann::ordered_json(*options.tick) : nullptr;
    fmt::print("{}\n", json_line(json));
  }
  return kExitGood;
}

}  // namespace

void add_plot(CLI::App& main, int& status) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* app = main.add_subcommand("plot", "Draw the path of one or more recordings");
  app->add_option("recording", options->recordings)->required();
  app->add_option("-o,--output", options->output, "FILE.svg, FILE.png or FILE.pdf")
      ->required()
      ->check(given_name());
  add_plugins(*app, options->plugins);
  app->add_option("--tick", options->tick,
                  "draw what the components show of this tick, from one recording")
      ->check(whole_number());
  app->add_option("--field", options->fields,
                  "draw TOPIC.FIELD over time, as state.speed_mps; may be repeated")
      ->allow_extra_args(false);
  app->add_flag("--json", options->json, "tell what was drawn, as one JSON object");
  app->callback([options, &status] { status = plot_command(*options); });
}

}  // namespace clew::tools
