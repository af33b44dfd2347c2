// SPDX-License-Identifier: Apache-2.0
#include "clew/help_groups.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/check.hpp"

namespace clew::tools {
namespace {

using Group = std::pair<const char*, std::vector<const char*>>;

/// In the order in which a newcomer meets them.
const std::vector<Group> kGroups = {
    {"Look at what there is", {"list", "check", "rules", "world", "doctor"}},
    {"Run", {"run", "component", "bridge", "host", "keys"}},
    {"Change a run that goes on",
     {"swap", "goal", "pace", "pause", "step", "resume", "stop", "top", "topic"}},
    {"Look at recordings",
     {"view", "report", "info", "events", "explain", "echo", "plot", "export", "import", "sign"}},
    {"Replay and compare", {"replay", "diff", "bisect"}},
    {"Many runs", {"bench", "query", "encounters", "hunt", "shrink", "tune"}},
    {"Extend", {"new", "check-plugin", "train", "completion"}}};

constexpr char kFooter[] = R"(
Examples:
  $ clew list graphs
  $ clew run krishna_kalra --world double-u --record a.mcap
  $ clew view a.mcap
  $ clew replay a.mcap --with recover.detector=none --branch 100

Environment:
  CLEW_PATH                   directories with graphs, worlds, robots and plug-ins of yours
  XDG_CONFIG_HOME             its clew/ (else ~/.config/clew, then /etc/clew) has such folders, too
  CLEW_DOMAIN_ID              the run of 'clew component' where --domain does not say it
  CLEW_LOG_LEVEL              debug, info, warning, error or off
  CLEW_LOG_DIR                where each process writes what it tells

'clew COMMAND --help' has the options of a command.)";

}  // namespace

void add_help(CLI::App& main) {
  for (const auto& [group, commands] : kGroups) {
    for (const char* const name : commands) main.get_subcommand(name)->group(group);
  }
  for (const CLI::App* command : main.get_subcommands([](const CLI::App*) { return true; })) {
    CLEW_CHECK(command->get_group() != "Subcommands", command->get_name());
  }
  main.footer(kFooter);
}

}  // namespace clew::tools
