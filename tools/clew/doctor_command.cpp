// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/terminal.hpp"
#include "clew/version.hpp"
#include "doctor/doctor.hpp"

namespace clew::tools {
namespace {

void print(const doctor::Finding& finding, bool json) {
  if (json) {
    fmt::print("{}\n", json_line({{"check", finding.check},
                                  {"ok", finding.ok},
                                  {"found", finding.found},
                                  {"fix", finding.fix}}));
    return;
  }
  fmt::print("{}  {:24}  {}\n",
             finding.ok ? in_colour("good", Tone::kGood) : in_colour("BAD ", Tone::kBad),
             terminal_text(finding.check), terminal_text(finding.found));
  if (!finding.fix.empty()) {
    fmt::print("      {:24}  what to do: {}\n", "", terminal_text(finding.fix));
  }
}

int doctor_command(bool json) {
  bool all_good = true;
  const auto tell = [&](const std::vector<doctor::Finding>& findings) {
    for (const doctor::Finding& finding : findings) {
      print(finding, json);
      all_good = all_good && finding.ok;
    }
    std::fflush(stdout);
  };
  tell({{"versions", true, version_text(), {}}});
  tell(doctor::check_machine());
  tell(doctor::check_dds());
  return all_good ? kExitGood : kExitFailed;
}

}  // namespace

void add_doctor(CLI::App& main, int& status) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* app = main.add_subcommand(
      "doctor", "Look whether this machine has what runs need, and say what to do");
  app->add_flag("--json", *json, "a line a check");
  app->callback([json, &status] { status = doctor_command(*json); });
}

}  // namespace clew::tools
