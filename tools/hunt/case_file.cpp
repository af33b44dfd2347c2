// SPDX-License-Identifier: Apache-2.0
#include "hunt/case_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "core/quoted.hpp"
#include "core/yaml_fields.hpp"
#include "runtime/config_source.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using core::YamlNode;

constexpr char kFormat[] = "clew-case/1";

std::string list_line(const char* key, const std::vector<std::string>& items) {
  if (items.empty()) return {};
  std::string text;
  for (const std::string& item : items)
    text += (text.empty() ? "" : ", ") + core::yaml_quoted(item);
  return fmt::format("{}: [{}]\n", key, text);
}

Result<void> read_text(const YamlNode& root, const char* key, std::string& field) {
  const auto node = root.find(key);
  if (!node) return {};
  auto text = node->string();
  if (!text.ok()) return text.error();
  field = std::move(text).value();
  return {};
}

Result<void> read_texts(const YamlNode& root, const char* key, std::vector<std::string>& fields) {
  const auto node = root.find(key);
  if (!node) return {};
  const auto items = node->items();
  if (!items.ok()) return items.error();
  for (const YamlNode& item : *items) {
    auto text = item.string();
    if (!text.ok()) return text.error();
    fields.push_back(std::move(text).value());
  }
  return {};
}

Result<void> read_required(const YamlNode& root, const char* key, std::string& field) {
  const auto node = root.at(key);
  return node.ok() ? read_text(root, key, field) : Result<void>(node.error());
}

Result<void> read_numbers(const YamlNode& root, CaseFile& file) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  CLEW_RETURN_IF_ERROR(core::read_count(root, "seed", 0, kMost, file.seed));
  if (!root.find("max_ticks")) return {};
  std::uint64_t ticks = 0;
  CLEW_RETURN_IF_ERROR(core::read_count(root, "max_ticks", 1, kMost, ticks));
  file.graph.max_ticks = ticks;
  return {};
}

}  // namespace

std::string case_text(const CaseFile& file) {
  std::string text = fmt::format("format: {}\n", kFormat);
  if (!file.about.empty()) text += "about: " + core::yaml_quoted(file.about) + '\n';
  text += "property: " + core::yaml_quoted(file.property) + '\n';
  text += "graph: " + core::yaml_quoted(file.graph.graph) + '\n';
  text += "world: " + core::yaml_quoted(file.world) + '\n';
  if (file.graph.robot) text += "robot: " + core::yaml_quoted(*file.graph.robot) + '\n';
  text += list_line("with", file.graph.with) + list_line("set", file.graph.set);
  text += fmt::format("seed: {}\n", file.seed);
  if (file.graph.max_ticks) text += fmt::format("max_ticks: {}\n", *file.graph.max_ticks);
  if (!file.outcome.empty()) text += "outcome: " + file.outcome + '\n';
  if (!file.hash.empty()) text += "hash: " + core::yaml_quoted(file.hash) + '\n';
  return text;
}

Result<CaseFile> parse_case(const std::string& text, const std::string& file) {
  const auto root = YamlNode::parse(text, file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(core::check_format(*root, kFormat));
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "about", "property", "graph", "world", "robot",
                                         "with", "set", "seed", "max_ticks", "outcome", "hash"}));
  CaseFile read;
  CLEW_RETURN_IF_ERROR(read_text(*root, "about", read.about));
  CLEW_RETURN_IF_ERROR(read_required(*root, "property", read.property));
  CLEW_RETURN_IF_ERROR(read_required(*root, "graph", read.graph.graph));
  CLEW_RETURN_IF_ERROR(read_required(*root, "world", read.world));
  if (root->find("robot"))
    CLEW_RETURN_IF_ERROR(read_text(*root, "robot", read.graph.robot.emplace()));
  CLEW_RETURN_IF_ERROR(read_texts(*root, "with", read.graph.with));
  CLEW_RETURN_IF_ERROR(read_texts(*root, "set", read.graph.set));
  CLEW_RETURN_IF_ERROR(read_numbers(*root, read));
  CLEW_RETURN_IF_ERROR(read_text(*root, "outcome", read.outcome));
  CLEW_RETURN_IF_ERROR(read_text(*root, "hash", read.hash));
  return read;
}

bool is_case(const std::string& text, const std::string& file) {
  const auto root = YamlNode::parse(text, file);
  if (!root.ok()) return false;
  const auto format = root->find("format");
  if (!format) return false;
  const auto word = format->string();
  return word.ok() && word->compare(0, 10, "clew-case/") == 0;
}

Result<RunCase> run_of(const CaseFile& file, const std::string& path) {
  RunCase run;
  run.graph = file.graph;
  run.seed = file.seed;
  run.world_file = (std::filesystem::path(path).parent_path() / file.world).string();
  // A name without a folder would be looked up among the shipped worlds.
  if (run.world_file.find('/') == std::string::npos) run.world_file = "./" + run.world_file;
  const auto world = runtime::ConfigPath({}).find("worlds", run.world_file);
  if (!world.ok()) return world.error();
  run.world_text = world->text;
  return run;
}

std::string command_line(const GraphChoice& graph, const std::string& world, std::uint64_t seed) {
  std::string line =
      "clew run " + core::shell_word(graph.graph) + " --world " + core::shell_word(world);
  if (graph.robot) line += " --robot " + core::shell_word(*graph.robot);
  for (const std::string& text : graph.with) line += " --with " + core::shell_word(text);
  for (const std::string& text : graph.set) line += " --set " + core::shell_word(text);
  line += fmt::format(" --seed {}", seed);
  if (graph.max_ticks) line += fmt::format(" --max-ticks {}", *graph.max_ticks);
  return line + " --layout composed";
}

}  // namespace clew::hunt
