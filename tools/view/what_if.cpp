// SPDX-License-Identifier: Apache-2.0
#include "view/what_if.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/nearest_name.hpp"
#include "runtime/raw_graph.hpp"

namespace clew::view {
namespace {

using core::Error;
using core::Result;
using nlohmann::json;

constexpr std::uint64_t kMostTicks = 100000;
constexpr std::size_t kMostWalls = 2000;
constexpr std::size_t kMostRuleBases = 8;
constexpr std::size_t kMostRuleBytes = 64 * 1024;
constexpr char kRuleBases[] = "rulebases";
constexpr double kMostCoordinate_m = 100000.0;
constexpr double kLeastPace = 0.001;
constexpr double kMostPace = 1000.0;
constexpr std::string_view kWith = "--with=";

Error bad(const std::string& what) { return {what, "request", 0, 0}; }

template <typename Infos>
const auto* find_named(const Infos& infos, const std::string& name) {
  const auto found =
      std::find_if(infos.begin(), infos.end(), [&](const auto& info) { return info.name == name; });
  return found == infos.end() ? nullptr : &*found;
}

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Result<std::uint64_t> count_of(const json& object, const char* key, std::uint64_t most) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > most) {
    return bad(fmt::format("{} must be a whole number from 0 to {}", key, most));
  }
  return found->get<std::uint64_t>();
}

Result<json> parse(std::string_view text) {
  json parsed = json::parse(text, nullptr, false);
  if (parsed.is_discarded() || !parsed.is_object()) return bad("is not an object of JSON");
  return parsed;
}

/// The recording and the tick that a request is about.
Result<std::uint64_t> read_moment(const json& request, std::size_t recordings,
                                  PageCommand& command) {
  const auto recording = count_of(request, "recording", SIZE_MAX);
  if (!recording.ok() || *recording >= recordings) return bad("there is no such recording");
  command.recording = *recording;
  const auto tick = count_of(request, "tick", UINT32_MAX);
  if (tick.ok()) command.tick = *tick;
  return tick;
}

/// `recover.detector` and the names to put there, as an option of the command line.
Result<std::string> read_with(const std::string& place, const json& names,
                              const std::vector<runtime::StageInfo>& stages) {
  const std::size_t dot = place.find('.');
  const auto* stage = find_named(stages, place.substr(0, dot));
  const auto* part = stage == nullptr || dot == std::string::npos
                         ? nullptr
                         : find_named(stage->parts, place.substr(dot + 1));
  if (part == nullptr) return bad("there is no part '" + place + "'");
  if (!names.is_array() || names.empty()) return bad(place + " needs a list of names");
  std::string option = "--with=" + place + '=';
  for (const json& name : names) {
    const std::string word = name.is_string() ? name.get<std::string>() : std::string();
    if (find_named(part->variants, word) == nullptr) {
      return bad(place + " has no behaviour '" + word + "'");
    }
    option += (option.back() == '=' ? "" : ",") + word;
  }
  return option;
}

bool is_plain_name(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
}

Result<std::string> value_text(const core::ParameterInfo& info, const json& value) {
  const auto refused = [&] { return bad(info.name + " cannot be " + value.dump()); };
  if (value.is_boolean() && std::holds_alternative<bool>(info.default_value)) {
    return std::string(value.get<bool>() ? "true" : "false");
  }
  if (value.is_number() && info.range) {
    const double number = value.get<double>();
    if (!(number >= info.range->min && number <= info.range->max)) {
      return bad(fmt::format("{} is {}; allowed: {} to {}", info.name, number, info.range->min,
                             info.range->max));
    }
    return value.dump();
  }
  if (!value.is_string()) return refused();
  const auto word = value.get<std::string>();
  const bool is_choice =
      std::find(info.choices.begin(), info.choices.end(), word) != info.choices.end();
  const bool is_file = !info.folder.empty() && is_plain_name(word);
  if (!is_choice && !is_file) return refused();
  return word;
}

/// A parameter that a request names, and how the command line does.
struct NamedParameter {
  const core::ParameterInfo* info = nullptr;
  std::string place;
};

Result<NamedParameter> find_parameter(const json& entry,
                                      const std::vector<runtime::StageInfo>& stages) {
  const auto* stage = find_named(stages, text_of(entry, "stage"));
  if (stage == nullptr) return bad("there is no stage '" + text_of(entry, "stage") + "'");
  const std::string part_name = text_of(entry, "part");
  const std::string name = text_of(entry, "name");
  const auto* part = find_named(stage->parts, part_name);
  const auto* variant =
      part == nullptr ? nullptr : find_named(part->variants, text_of(entry, "behaviour"));
  const auto* info = find_named(variant == nullptr ? stage->parameters : variant->parameters, name);
  if (info == nullptr) return bad("there is no parameter '" + name + "' of " + stage->name);
  std::string place = stage->name;
  if (variant != nullptr && part->name != runtime::kBehaviourPart) {
    place += '.' + part->name + '.' + variant->name;
  }
  return NamedParameter{info, place + '.' + name};
}

Result<std::string> read_set(const json& entry, const std::vector<runtime::StageInfo>& stages) {
  const auto parameter = find_parameter(entry, stages);
  if (!parameter.ok()) return parameter.error();
  const auto value = value_text(*parameter->info, entry.value("value", json()));
  if (!value.ok()) return value.error();
  return fmt::format("--set={}={}", parameter->place, *value);
}

/// What stands in them, the components judge that load them.
Result<void> read_rules(const json& request, const std::vector<runtime::StageInfo>& stages,
                        std::vector<EditedRules>& edited) {
  const json rules = request.value("rules", json::array());
  if (!rules.is_array() || rules.size() > kMostRuleBases) {
    return bad(fmt::format("rules is a list of up to {}", kMostRuleBases));
  }
  for (const json& entry : rules) {
    if (!entry.is_object()) return bad("rules is a list of objects");
    const auto parameter = find_parameter(entry, stages);
    if (!parameter.ok()) return parameter.error();
    if (parameter->info->folder != kRuleBases) {
      return bad(parameter->place + " names no rule base");
    }
    std::string text = text_of(entry, "text");
    if (text.empty() || text.size() > kMostRuleBytes) {
      return bad(fmt::format("a rule base is a text of up to {} bytes", kMostRuleBytes));
    }
    edited.push_back({parameter->place, std::move(text)});
  }
  return {};
}

Result<void> read_changes(const json& request, const std::vector<runtime::StageInfo>& stages,
                          std::vector<std::string>& words) {
  const json with = request.value("with", json::object());
  const json set = request.value("set", json::array());
  if (!with.is_object() || !set.is_array()) return bad("with is an object, set is a list");
  for (const auto& [place, names] : with.items()) {
    auto option = read_with(place, names, stages);
    if (!option.ok()) return option.error();
    words.push_back(std::move(option).value());
  }
  for (const json& entry : set) {
    if (!entry.is_object()) return bad("set is a list of objects");
    auto option = read_set(entry, stages);
    if (!option.ok()) return option.error();
    words.push_back(std::move(option).value());
  }
  return {};
}

Result<void> read_max_ticks(const json& request, std::vector<std::string>& words) {
  const auto max_ticks = count_of(request, "max_ticks", kMostTicks);
  if (!max_ticks.ok()) return max_ticks.error();
  words.push_back(fmt::format("--max-ticks={}", *max_ticks));
  return {};
}

/// What the changes say, without their options.
std::string changes_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (word.compare(0, 6, "--with") != 0 && word.compare(0, 5, "--set") != 0) continue;
    text += (text.empty() ? "" : ", ") + word.substr(equals + 1);
  }
  return text;
}

/// So many finite numbers.
Result<std::string> numbers(const json& list, std::size_t count, const char* what) {
  if (!list.is_array() || list.size() != count) {
    return bad(fmt::format("{} needs {} numbers", what, count));
  }
  std::string text = "[";
  for (const json& number : list) {
    if (!number.is_number() || !(std::fabs(number.get<double>()) <= kMostCoordinate_m)) {
      return bad(fmt::format("{} holds what is no coordinate", what));
    }
    text += (text.size() == 1 ? "" : ", ") + fmt::format("{}", number.get<double>());
  }
  return text + ']';
}

Result<std::string> world_file(const json& world) {
  std::string text = "format: clew-world/1\nname: drawn\nabout: \"Drawn on the page.\"\n";
  const std::pair<const char*, std::size_t> lists[] = {{"bounds", 4}, {"start", 3}, {"target", 2}};
  for (const auto& [key, count] : lists) {
    const auto list = numbers(world.value(key, json()), count, key);
    if (!list.ok()) return list.error();
    text += fmt::format("{}: {}\n", key, *list);
  }
  const auto radius =
      numbers(json::array({world.value("target_radius", json())}), 1, "target_radius");
  if (!radius.ok()) return radius.error();
  text += "target_radius: " + radius->substr(1, radius->size() - 2) + '\n';
  const json walls = world.value("walls", json::array());
  if (!walls.is_array() || walls.size() > kMostWalls) return bad("walls is a list of up to 2000");
  text += "walls: [";
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto wall = numbers(walls[i], 4, "a wall");
    if (!wall.ok()) return wall.error();
    text += (i == 0 ? "" : ", ") + *wall;
  }
  return text + "]\n";
}

Result<PageOrder> read_step(const json& request, PageOrder order) {
  const auto ticks = count_of(request, "ticks", kMostTicks);
  if (!ticks.ok() || *ticks == 0) return bad(fmt::format("ticks: from 1 to {}", kMostTicks));
  order.ticks = *ticks;
  order.words = {std::to_string(*ticks)};
  return order;
}

Result<PageOrder> read_pace(const json& request, PageOrder order) {
  const json factor = request.value("factor", json());
  const bool in_range = factor.is_number() && factor.get<double>() <= kMostPace &&
                        (factor.get<double>() == 0.0 || factor.get<double>() >= kLeastPace);
  if (!in_range) {
    return bad(fmt::format("factor: 0, or from {} to {}", kLeastPace, kMostPace));
  }
  order.pace_factor = factor.get<double>();
  order.words = {order.pace_factor == 0.0 ? "lockstep" : fmt::format("{}x", order.pace_factor)};
  return order;
}

Result<PageOrder> read_goal(const json& request, PageOrder order) {
  for (const char* key : {"x", "y"}) {
    const json number = request.value(key, json());
    if (!number.is_number() || !(std::fabs(number.get<double>()) <= kMostCoordinate_m)) {
      return bad("a target needs coordinates x and y");
    }
    order.words.push_back(fmt::format("{}", number.get<double>()));
  }
  order.changes = {"goal=" + order.words[0] + ',' + order.words[1]};
  return order;
}

Result<std::string> known_name(const char* what, const json& request,
                               const std::vector<std::string>& names) {
  const std::string name = text_of(request, what);
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  return bad(core::unknown_name(what, name, names));
}

}  // namespace

Result<PageCommand> read_branch(std::string_view text, std::size_t recordings,
                                const std::vector<runtime::StageInfo>& stages) {
  const auto request = parse(text);
  if (!request.ok()) return request.error();
  PageCommand command;
  const auto tick = read_moment(*request, recordings, command);
  if (!tick.ok()) return tick.error();
  command.words.push_back(fmt::format("--branch={}", *tick));
  CLEW_RETURN_IF_ERROR(read_changes(*request, stages, command.words));
  CLEW_RETURN_IF_ERROR(read_rules(*request, stages, command.rules));
  CLEW_RETURN_IF_ERROR(read_max_ticks(*request, command.words));
  std::string changes = changes_text(command.words);
  for (const EditedRules& edited : command.rules) {
    changes += (changes.empty() ? "" : ", ") + edited.place + " edited";
  }
  command.what = fmt::format("branch at {}{}", *tick, changes.empty() ? "" : ": " + changes);
  return command;
}

Result<PageCommand> read_question(std::string_view text, std::size_t recordings) {
  const auto request = parse(text);
  if (!request.ok()) return request.error();
  PageCommand command;
  const auto tick = read_moment(*request, recordings, command);
  if (!tick.ok()) return tick.error();
  command.words = {"--tick", std::to_string(*tick), "--json"};
  return command;
}

Result<PageCommand> read_run(std::string_view text, const KnownNames& names,
                             const std::vector<runtime::StageInfo>& stages) {
  const auto request = parse(text);
  if (!request.ok()) return request.error();
  PageCommand command;
  const auto graph = known_name("graph", *request, names.graphs);
  if (!graph.ok()) return graph.error();
  command.graph = *graph;
  if (const json world = request->value("world", json()); world.is_object()) {
    auto file = world_file(world);
    if (!file.ok()) return file.error();
    command.world_text = std::move(file).value();
  } else {
    auto name = known_name("world", *request, names.worlds);
    if (!name.ok()) return name.error();
    command.world = std::move(name).value();
  }
  CLEW_RETURN_IF_ERROR(read_changes(*request, stages, command.words));
  CLEW_RETURN_IF_ERROR(read_max_ticks(*request, command.words));
  command.what = command.graph + " in " + (command.world.empty() ? "a drawn world" : command.world);
  const std::string changes = changes_text(command.words);
  if (!changes.empty()) command.what += ": " + changes;
  return command;
}

Result<PageOrder> read_order(std::string_view text, const std::vector<runtime::StageInfo>& stages) {
  const auto request = parse(text);
  if (!request.ok()) return request.error();
  PageOrder order;
  order.order = text_of(*request, "order");
  if (order.order == "pause" || order.order == "resume" || order.order == "stop") return order;
  if (order.order == "step") return read_step(*request, std::move(order));
  if (order.order == "pace") return read_pace(*request, std::move(order));
  if (order.order == "goal") return read_goal(*request, std::move(order));
  if (order.order != "swap") return bad("there is no order '" + order.order + "'");
  CLEW_RETURN_IF_ERROR(read_changes(*request, stages, order.words));
  for (std::string& word : order.words) {
    order.changes.push_back(word.substr(word.find('=') + 1));
    // `clew swap` takes behaviours without an option.
    if (word.compare(0, kWith.size(), kWith) == 0) word = order.changes.back();
  }
  CLEW_RETURN_IF_ERROR(read_rules(*request, stages, order.rules));
  if (order.changes.empty() && order.rules.empty()) return bad("nothing is to be changed");
  return order;
}

}  // namespace clew::view
