// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clew/commands.hpp"
#include "clew/difference_output.hpp"
#include "clew/json_line.hpp"
#include "recording/run_recording.hpp"
#include "replay/recording_diff.hpp"

namespace clew::tools {
namespace {

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
  json["configuration"] = ordered_json::array();
  for (const auto& found : diff.configuration) {
    json["configuration"].push_back({{"what", found.what}, {"a", found.a}, {"b", found.b}});
  }
  return json;
}

void print(const RecordingDiff& diff) {
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
    fmt::print(stderr, "clew: {}: {}; compared is what is there\n", recording.path(), why);
  }
}

}  // namespace

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

}  // namespace clew::tools
