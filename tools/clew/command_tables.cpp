// SPDX-License-Identifier: Apache-2.0
#include "clew/command_tables.hpp"

#include <map>
#include <set>

namespace clew::tools {

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) {
    return !command->get_name().empty() && !command->get_group().empty();
  });
}

std::vector<const CLI::Option*> shown_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) {
    return option->nonpositional() && !option->get_group().empty();
  });
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) {
    return option->get_positional() && !option->nonpositional();
  });
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string list_for(const CLI::App& command, const CLI::Option& option) {
  static const std::map<std::string, std::string> kLists = {
      {"graph", "graphs"},   {"--graph", "graphs"}, {"--world", "worlds"}, {"world", "worlds"},
      {"--robot", "robots"}, {"suite", "suites"},   {"--worlds", "suites"}};
  std::string name = option.get_single_name();
  if (option.nonpositional()) name = "--" + name;
  static const std::set<std::string> kOfWorlds = {"check", "solve", "severity", "picture",
                                                  "shrink"};
  if (name == "world" && kOfWorlds.count(command.get_name()) == 0) return {};
  const auto found = kLists.find(name);
  return found == kLists.end() ? std::string() : found->second;
}

}  // namespace clew::tools
