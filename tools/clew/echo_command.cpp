// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/recorded_fields.hpp"
#include "clew/sample_output.hpp"
#include "core/nearest_name.hpp"
#include "log/log.hpp"
#include "replay/live_checks.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::tools {
namespace {

using bridge::Field;
using core::Error;
using core::Result;

struct EchoOptions {
  std::string recording;
  std::string topic;
  std::vector<std::string> fields;  ///< empty: all
  std::uint64_t first_tick = 0;
  std::optional<std::uint64_t> last_tick;
  bool jsonl = false;
  bool csv = false;
};

/// Calls visit(sample, fields) for each sample of the topic; `visit` returns whether to go on.
template <typename Visit>
Result<void> for_each_sample(const bridge::RunRecording& recording,
                             const bridge::SampleFilter& filter, const Visit& visit) {
  auto samples = recording.samples(filter);
  FieldReader reader;
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) return {};
    auto fields = reader.fields_of(**sample);
    if (!fields.ok()) return Error{fields.error().message, recording.path()};
    keep_recorded(recording, (*sample)->topic, *fields);
    if (!visit(**sample, *fields)) return {};
  }
}

/// A field must be in one sample at least: lists may be empty in most.
Result<void> check_field(const bridge::RunRecording& recording, const bridge::SampleFilter& filter,
                         const std::string& wanted) {
  bool found = false;
  std::set<std::string> known;
  CLEW_RETURN_IF_ERROR(for_each_sample(recording, filter, [&](const auto&, const auto& fields) {
    for (const Field& field : fields) {
      found = found || lies_in(field.path, wanted);
      known.insert(without_indices(field.path));
    }
    return !found;
  }));
  if (found) return {};
  const std::string topic(domain::topic_name(*filter.topics.begin()));
  const std::vector<std::string> names(known.begin(), known.end());
  return Error{core::unknown_name("field of " + topic, wanted, names), "--field"};
}

Result<void> print_csv(const bridge::RunRecording& recording, const bridge::SampleFilter& filter,
                       const std::vector<std::string>& wanted) {
  FieldColumns columns;
  CLEW_RETURN_IF_ERROR(for_each_sample(recording, filter, [&](const auto&, const auto& fields) {
    columns.add(chosen_fields(fields, wanted));
    return true;
  }));
  fmt::print("tick,sequence");
  for (const std::string& path : columns.paths()) fmt::print(",{}", path);
  fmt::print("\n");
  return for_each_sample(recording, filter, [&](const auto& sample, const auto& fields) {
    fmt::print("{},{}", sample.tick, sample.sequence);
    fmt::print("{}{}\n", columns.paths().empty() ? "" : ",", columns.row(fields));
    return true;
  });
}

Result<void> echo(const bridge::RunRecording& recording, const EchoOptions& options) {
  const auto topic = bridge::recorded_topic(recording, options.topic);
  if (!topic.ok()) return topic.error();
  bridge::SampleFilter filter{{*topic}, options.first_tick};
  if (options.last_tick) filter.last_tick = *options.last_tick;
  for (const std::string& name : options.fields) {
    CLEW_RETURN_IF_ERROR(check_field(recording, filter, name));
  }
  if (options.csv) return print_csv(recording, filter, options.fields);
  return for_each_sample(recording, filter, [&](const auto& sample, const auto& fields) {
    if (options.jsonl) {
      fmt::print("{}\n", sample_json(sample, fields, options.fields));
    } else {
      print_sample(sample, chosen_fields(fields, options.fields));
    }
    return true;
  });
}

int echo_command(const EchoOptions& options) {
  if (options.jsonl && options.csv) {
    return complain({"--jsonl and --csv are two formats: leave out one", {}, 0, 0});
  }
  if (options.last_tick && *options.last_tick < options.first_tick) {
    return complain(
        {fmt::format("no tick is from {} to {}", options.first_tick, *options.last_tick),
         {},
         0,
         0});
  }
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  const auto echoed = echo(*recording, options);
  if (!echoed.ok()) return complain(echoed.error());
  if (const std::string why = recording->cut_off(); !why.empty()) {
    logs::warning("{}: {}; told is what is there", recording->path(), why);
  }
  return kExitGood;
}

}  // namespace

void add_echo(CLI::App& main, int& status) {
  const auto options = std::make_shared<EchoOptions>();
  CLI::App* app = main.add_subcommand("echo", "Print the samples of a recorded topic");
  app->add_option("recording", options->recording, "of a run")->required();
  app->add_option("topic", options->topic, "state, scan, command, ...; see 'clew info'")
      ->required();
  app->add_option("--field", options->fields,
                  "only this one, as stamp.sim_time_s or ranges_m[3]; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--from", options->first_tick, "begin with this tick")->check(whole_number());
  app->add_option("--to", options->last_tick, "end with this tick")->check(whole_number());
  app->add_flag("--jsonl", options->jsonl, "one JSON object a line");
  app->add_flag("--csv", options->csv, "a table, with a header");
  app->callback([options, &status] { status = echo_command(*options); });
}

}  // namespace clew::tools
