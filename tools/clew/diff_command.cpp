// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/difference_output.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "log/log.hpp"
#include "recording/run_recording.hpp"
#include "replay/recording_diff.hpp"

namespace clew::tools {
namespace {

struct DiffOptions {
  std::string a;
  std::string b;
  double tolerance = 0.0;
  bool json = false;
};

using bridge::RecordingDiff;
using nlohmann::ordered_json;

ordered_json to_json(const RecordingDiff& diff) {
  ordered_json json;
  json["identical"] = diff.identical();
  json["first_difference"] = difference_json(diff.first);
  json["topics"] = ordered_json::object();
  for (const auto& [topic, found] : diff.topics) {
    json["topics"][std::string(domain::topic_name(topic))] = {
        {"samples_a", found.samples_a}, {"samples_b", found.samples_b}, {"equal", found.equal},
        {"different", found.different}, {"only_a", found.only_a},       {"only_b", found.only_b}};
  }
  json["topics_only_a"] = ordered_json::array();
  json["topics_only_b"] = ordered_json::array();
  for (const auto& [topic, is_of_a] : diff.topics_of_one) {
    json[is_of_a ? "topics_only_a" : "topics_only_b"].push_back(domain::topic_name(topic));
  }
  json["configuration"] = ordered_json::array();
  for (const auto& found : diff.configuration) {
    json["configuration"].push_back({{"what", found.what}, {"a", found.a}, {"b", found.b}});
  }
  return json;
}

void print(const RecordingDiff& diff) {
  for (const auto& [topic, is_of_a] : diff.topics_of_one) {
    fmt::print("only {} has the topic {}\n", is_of_a ? 'a' : 'b', domain::topic_name(topic));
  }
  if (diff.first) {
    fmt::print("first difference:\n");
    print_difference(*diff.first, "a", "b");
  }
  fmt::print("{:<9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "topic", "in a", "in b", "equal",
             "different", "only a", "only b");
  for (const auto& [topic, found] : diff.topics) {
    fmt::print("{:<9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", domain::topic_name(topic),
               found.samples_a, found.samples_b, found.equal, found.different, found.only_a,
               found.only_b);
  }
  for (const auto& found : diff.configuration) {
    fmt::print("configuration, {}:\n  a: {}\n  b: {}\n", found.what,
               found.a.empty() ? "none" : found.a, found.b.empty() ? "none" : found.b);
  }
  fmt::print("{}\n", diff.identical() ? "identical" : "different");
}

/// A recording that ends early shows as missing samples: said so that nobody wonders.
void note_early_end(const bridge::RunRecording& recording) {
  if (const std::string why = recording.cut_off(); !why.empty()) {
    logs::warning("{}: {}; compared is what is there", recording.path(), why);
  }
}

int diff_command(const DiffOptions& options) {
  const auto a = bridge::RunRecording::open(options.a);
  if (!a.ok()) return complain(a.error());
  const auto b = bridge::RunRecording::open(options.b);
  if (!b.ok()) return complain(b.error());
  const auto diff = bridge::diff_recordings(*a, *b, options.tolerance);
  if (!diff.ok()) return complain(diff.error());
  note_early_end(*a);
  note_early_end(*b);
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*diff)));
  } else {
    print(*diff);
  }
  return diff->identical() ? kExitGood : kExitFailed;
}

}  // namespace

void add_diff(CLI::App& main, int& status) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* app = main.add_subcommand("diff", "Find the first difference between two recordings");
  app->add_option("a", options->a, "a recording")->required();
  app->add_option("b", options->b, "another")->required();
  app->add_option("--tolerance", options->tolerance, "numbers this close count as equal (0)")
      ->check(number_between(0.0, std::numeric_limits<double>::max()));
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = diff_command(*options); });
}

}  // namespace clew::tools
