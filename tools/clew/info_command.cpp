// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/signature_facts.hpp"
#include "clew/stage_text.hpp"
#include "clew/waypoint_marks.hpp"
#include "log/log.hpp"
#include "recording/run_recording.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"
#include "wire/codec.hpp"

namespace clew::tools {
namespace {

struct InfoOptions {
  std::string recording;
  std::vector<std::string> plugins;
  std::string signed_by;  ///< the file of a certificate, or empty
  bool json = false;
};

using bridge::RunRecording;
using bridge::RunSurvey;
using core::Result;
using nlohmann::ordered_json;

struct TopicFacts {
  domain::Topic topic = domain::Topic::kCommand;
  RunSurvey::TopicSurvey survey;
  std::uint64_t missing_ticks = 0;  ///< of those that it should have
};

/// All that the command tells of a recording.
struct RecordingFacts {
  std::vector<TopicFacts> topics;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t ticks = 0;           ///< spanned
  std::uint64_t missing_at_end = 0;  ///< whole ticks of its recorder, behind those spanned
  std::uint64_t missing_samples = 0;
  core::Hash128 hash;
  bool hash_matches = true;  ///< or the recording does not say
  bool types_match = false;
  std::string no_plan;  ///< why this version cannot make the run's components; empty if it can
  std::optional<std::uint64_t> branch_tick;
  std::vector<WaypointMark> waypoints;  ///< that were reached
  SignatureFacts signature;
};

/// By kind.
std::map<std::string, std::size_t> count_incidents(const RunRecording& recording) {
  std::map<std::string, std::size_t> counts;
  for (const domain::Incident& incident : recording.incidents()) ++counts[incident.kind];
  return counts;
}

bool was_aborted(const RunRecording& recording) {
  return recording.end() && !recording.end()->aborted.empty();
}

/// How many samples a topic should have. Of a run that was aborted, those up to its own last one
/// and to the ticks that were whole.
std::uint64_t ticks_of(const RunSurvey::TopicSurvey& topic, const RunRecording& recording,
                       const RecordingFacts& facts) {
  if (!was_aborted(recording)) return facts.ticks + facts.missing_at_end;
  const std::uint64_t own_end = topic.samples > 0 ? topic.last_tick + 1 : facts.first_tick;
  return std::max({own_end, recording.end()->ticks, facts.first_tick}) - facts.first_tick;
}

RecordingFacts gather(const RunRecording& recording, const RunSurvey& survey) {
  RecordingFacts facts;
  facts.hash = survey.hash;
  facts.hash_matches = !recording.end() || recording.end()->hash == survey.hash;
  facts.types_match = recording.description().idl_fingerprint == bridge::idl_fingerprint();
  bool first = true;
  for (const auto& [topic, found] : survey.topics) {
    facts.first_tick = first ? found.first_tick : std::min(facts.first_tick, found.first_tick);
    facts.last_tick = std::max(facts.last_tick, found.last_tick);
    first = false;
  }
  if (!survey.topics.empty()) facts.ticks = facts.last_tick - facts.first_tick + 1;
  const std::uint64_t end_tick = facts.first_tick + facts.ticks;
  if (recording.end() && recording.end()->ticks > end_tick) {
    facts.missing_at_end = recording.end()->ticks - end_tick;
  }
  for (const auto& [topic, schema] : recording.description().schemas) {
    TopicFacts of_topic{topic, {}, 0};
    const auto found = survey.topics.find(topic);
    if (found != survey.topics.end()) of_topic.survey = found->second;
    of_topic.missing_ticks = ticks_of(of_topic.survey, recording, facts) - of_topic.survey.samples;
    facts.missing_samples += of_topic.missing_ticks;
    facts.topics.push_back(std::move(of_topic));
  }
  return facts;
}

bool is_good(const RunRecording& recording, const RecordingFacts& facts) {
  return recording.complete() && facts.missing_samples == 0 && facts.hash_matches &&
         facts.no_plan.empty() && facts.signature.good();
}

std::string state_text(const RunRecording& recording, const RecordingFacts& facts) {
  if (recording.tear()) {
    return fmt::format("torn at byte {}: {}", recording.tear()->at_byte, recording.tear()->reason);
  }
  if (!recording.missing_piece().empty()) return "cut off: it " + recording.cut_off();
  if (!recording.complete()) return "cut off: its recorder did not finish it";
  if (!facts.no_plan.empty()) return "cannot be replayed: " + facts.no_plan;
  if (facts.missing_at_end > 0) {
    return fmt::format("lacks the last {} ticks that its recorder wrote", facts.missing_at_end);
  }
  if (facts.missing_samples > 0) return fmt::format("lacks {} samples", facts.missing_samples);
  if (!facts.hash_matches) return "holds other samples than its recorder wrote";
  if (was_aborted(recording)) return "complete; the run was aborted: " + recording.end()->aborted;
  return "complete";
}

std::string hash_text(const RunRecording& recording, const RecordingFacts& facts) {
  if (!recording.end()) return facts.hash.hex() + " (of what is there)";
  if (facts.hash_matches) return facts.hash.hex() + " (as recorded)";
  return fmt::format("{} (its recorder wrote {})", facts.hash.hex(), recording.end()->hash.hex());
}

/// When a recording goes on in another file, in words.
std::string split_text(const bridge::RecordingSplit& split) {
  std::vector<std::string> texts;
  if (split.bytes > 0) texts.push_back(fmt::format("from {} bytes on", split.bytes));
  if (split.seconds > 0) texts.push_back(fmt::format("every {} s", split.seconds));
  return fmt::format("{}", fmt::join(texts, ", and "));
}

Result<runtime::Graph> graph_of(const RunRecording& recording) {
  const auto file = runtime::BundleSource(recording.description().bundle).find("graphs", "graph");
  if (!file.ok()) return file.error();
  return runtime::load_graph(*file, "graph", {}, stages::all());
}

void print_configuration(const RunRecording& recording) {
  const auto graph = graph_of(recording);
  if (!graph.ok()) {
    print_text("graph      not one of this version: {}\n", graph.error().text());
    return;
  }
  print_text("graph      {}\nworld      {}\nrobot      {}\n", graph->name, graph->world,
             graph->robot);
  for (const auto& stage : graph->stages) {
    print_text("{:<10} {}\n", stage.info->name, stage_text(stage));
  }
}

std::vector<std::string> left_out(const RunRecording& recording) {
  std::vector<std::string> names;
  for (const domain::Topic topic : recording.description().left_out) {
    names.emplace_back(domain::topic_name(topic));
  }
  return names;
}

/// Of a recording that is not of all topics, or in several files.
void print_files(const RunRecording& recording) {
  if (recording.description().split.any()) {
    print_text("files      {}: a new one {}\n", recording.pieces(),
               split_text(recording.description().split));
  }
  if (const auto names = left_out(recording); !names.empty()) {
    print_text("left out   {}\n", fmt::join(names, ", "));
  }
}

/// What befell the run, what was changed in it, and how far its mission came.
void print_story(const RunRecording& recording, const RecordingFacts& facts) {
  if (const auto& box = recording.description().black_box) {
    print_text("black box  {}; can be replayed from tick {} on\n", box->why, box->tick);
  }
  if (const auto counts = count_incidents(recording); !counts.empty()) {
    std::vector<std::string> texts;
    for (const auto& [kind, count] : counts) texts.push_back(fmt::format("{} {}", count, kind));
    print_text("incidents  {}; 'clew events' tells them\n", fmt::join(texts, ", "));
  }
  for (const auto& change : recording.interventions()) {
    print_text(
        "changed    at tick {}: {}\n", change.tick,
        change.order.empty() ? fmt::format("{}", fmt::join(change.changes, ", ")) : change.order);
  }
  for (const WaypointMark& mark : facts.waypoints) {
    print_text("way-point  {} of {} reached at tick {}, at ({:.2f}, {:.2f})\n", mark.number,
               mark.of, mark.tick, mark.place.x(), mark.place.y());
  }
}

void print(const RunRecording& recording, const RecordingFacts& facts) {
  const auto& description = recording.description();
  print_text("{}: {}\n", recording.path(), state_text(recording, facts));
  if (facts.ticks > 0) {
    print_text("ticks      {} to {}, {} s each: {:.1f} s\n", facts.first_tick, facts.last_tick,
               description.tick_s, static_cast<double>(facts.last_tick) * description.tick_s);
  } else {
    print_text("ticks      none\n");
  }
  print_files(recording);
  print_story(recording, facts);
  if (facts.branch_tick) {
    print_text("branched   at tick {}; the ticks before are those of another run\n",
               *facts.branch_tick);
  }
  print_text("hash       {}\n", hash_text(recording, facts));
  if (recording.end() && recording.end()->run_hash) {
    print_text("of the run {} (all topics, as the run had it)\n", recording.end()->run_hash->hex());
  }
  print_text("seed       {}\n", description.seed);
  if (const std::string text = facts.signature.text(); !text.empty()) {
    print_text("signature  {}\n", text);
  }
  for (const auto& [program, version] : description.versions) {
    print_text("version    {} {}\n", program, version);
  }
  print_text("IDL        {}{}\n", description.idl_fingerprint,
             facts.types_match ? "" : ", not that of this version");
  print_configuration(recording);
  print_text("topic      {:<22} {:>9} {:>9} {:>9} {:>9}\n", "type", "samples", "first", "last",
             "missing");
  for (const TopicFacts& topic : facts.topics) {
    print_text("{:<10} {:<22} {:>9} {:>9} {:>9} {:>9}\n", domain::topic_name(topic.topic),
               domain::type_name(topic.topic), topic.survey.samples, topic.survey.first_tick,
               topic.survey.last_tick, topic.missing_ticks);
  }
  for (const auto& [name, text] : description.bundle) {
    print_text("file       {} ({} bytes)\n", name, text.size());
  }
}

ordered_json stages_json(const runtime::Graph& graph) {
  ordered_json stages = ordered_json::object();
  for (const auto& stage : graph.stages) {
    ordered_json parts = ordered_json::object();
    if (!stage.deployment.exec.empty()) parts["exec"] = stage.deployment.exec;
    if (stage.deployment.ros2) parts["ros2"] = *stage.deployment.ros2;
    for (const auto& [part, choices] : stage.config.parts) {
      parts[part] = ordered_json::array();
      for (const auto& choice : choices) parts[part].push_back(choice.name);
    }
    stages[stage.info->name] = std::move(parts);
  }
  return stages;
}

ordered_json topics_json(const RecordingFacts& facts) {
  ordered_json topics = ordered_json::array();
  for (const TopicFacts& topic : facts.topics) {
    const bool any = topic.survey.samples > 0;
    topics.push_back({{"topic", domain::topic_name(topic.topic)},
                      {"type", domain::type_name(topic.topic)},
                      {"samples", topic.survey.samples},
                      {"first_tick", any ? ordered_json(topic.survey.first_tick) : nullptr},
                      {"last_tick", any ? ordered_json(topic.survey.last_tick) : nullptr},
                      {"missing_ticks", topic.missing_ticks}});
  }
  return topics;
}

void add_configuration(const RunRecording& recording, ordered_json& json) {
  const auto graph = graph_of(recording);
  json["graph"] = graph.ok() ? ordered_json(graph->name) : nullptr;
  json["world"] = graph.ok() ? ordered_json(graph->world) : nullptr;
  json["robot"] = graph.ok() ? ordered_json(graph->robot) : nullptr;
  json["stages"] = graph.ok() ? stages_json(*graph) : ordered_json(nullptr);
}

ordered_json to_json(const RunRecording& recording, const RecordingFacts& facts) {
  const auto& description = recording.description();
  ordered_json json;
  json["recording"] = recording.path();
  json["complete"] = is_good(recording, facts);
  json["aborted"] =
      was_aborted(recording) ? ordered_json(recording.end()->aborted) : ordered_json(nullptr);
  json["cannot_be_replayed"] =
      facts.no_plan.empty() ? ordered_json(nullptr) : ordered_json(facts.no_plan);
  json["torn"] = nullptr;
  if (const auto& tear = recording.tear()) {
    json["torn"] = {{"at_byte", tear->at_byte}, {"reason", tear->reason}};
  }
  json["ticks"] = facts.ticks;
  json["first_tick"] = facts.ticks > 0 ? ordered_json(facts.first_tick) : nullptr;
  json["last_tick"] = facts.ticks > 0 ? ordered_json(facts.last_tick) : nullptr;
  json["tick_s"] = description.tick_s;
  json["duration_s"] = static_cast<double>(facts.last_tick) * description.tick_s;
  json["branch_tick"] = facts.branch_tick ? ordered_json(*facts.branch_tick) : nullptr;
  json["interventions"] = ordered_json::array();
  for (const auto& change : recording.interventions()) {
    json["interventions"].push_back(
        {{"tick", change.tick}, {"changes", change.changes}, {"order", change.order}});
  }
  json["incidents"] = count_incidents(recording);
  json["waypoints"] = waypoints_json(facts.waypoints);
  json["black_box"] = nullptr;
  if (const auto& box = description.black_box) {
    json["black_box"] = {{"first_tick", box->tick}, {"why", box->why}};
  }
  json["missing_samples"] = facts.missing_samples;
  json["hash"] = facts.hash.hex();
  json["recorded_hash"] =
      recording.end() ? ordered_json(recording.end()->hash.hex()) : ordered_json(nullptr);
  json["run_hash"] = recording.end() && recording.end()->run_hash
                         ? ordered_json(recording.end()->run_hash->hex())
                         : ordered_json(nullptr);
  json["pieces"] = recording.pieces();
  json["left_out"] = left_out(recording);
  facts.signature.add_to(json);
  json["seed"] = description.seed;
  json["versions"] = description.versions;
  json["idl_fingerprint"] = description.idl_fingerprint;
  json["idl_is_ours"] = facts.types_match;
  add_configuration(recording, json);
  json["topics"] = topics_json(facts);
  json["files"] = ordered_json::object();
  for (const auto& [name, text] : description.bundle) json["files"][name] = text.size();
  return json;
}

int info_command(const InfoOptions& options) {
  auto signature = read_signature_facts(options.recording, options.signed_by);
  const auto recording = RunRecording::open(options.recording);
  if (!recording.ok()) {
    // What cannot be read may be what somebody changed.
    if (signature.ok() && !signature->good()) {
      logs::warning("signature {}", signature->text());
    }
    return complain(recording.error());
  }
  if (!signature.ok()) return complain(signature.error());
  const auto survey = recording->survey_samples();
  if (!survey.ok()) return complain(survey.error());
  const auto branch = bridge::branch_of(*recording);
  if (!branch.ok()) return complain(branch.error());
  RecordingFacts facts = gather(*recording, *survey);
  if (*branch) facts.branch_tick = (*branch)->tick;
  facts.signature = std::move(signature).value();
  const auto plugins = load_plugins_for(*recording, options.plugins);
  if (!plugins.ok()) return complain(plugins.error());
  if (facts.types_match) {
    const auto plan = runtime::prepare_run(recording->description().bundle, stages::all());
    if (!plan.ok()) facts.no_plan = plan.error().text();
    if (plan.ok()) {
      auto marks = waypoint_marks(*recording);
      if (marks.ok()) {
        facts.waypoints = std::move(marks).value();
      } else {
        logs::info("{}: its way-points cannot be told: {}", recording->path(),
                   marks.error().text());
      }
    }
  }
  if (options.json) {
    print_text("{}\n", json_line(to_json(*recording, facts)));
  } else {
    print(*recording, facts);
  }
  return is_good(*recording, facts) ? kExitGood : kExitFailed;
}

}  // namespace

void add_info(CLI::App& main, int& status) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* app =
      main.add_subcommand("info", "Show what a recording holds, and whether it is complete");
  app->add_option("recording", options->recording)->required();
  add_plugins(*app, options->plugins);
  app->add_option("--signed-by", options->signed_by,
                  "the file of a certificate: it must be signed by its owner, or by somebody that "
                  "he vouches for");
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = info_command(*options); });
}

}  // namespace clew::tools
