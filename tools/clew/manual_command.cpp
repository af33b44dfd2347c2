// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "clew/command_tables.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "core/nearest_name.hpp"
#include "files/whole_file.hpp"

namespace clew::tools {
namespace {

core::Result<void> write_pages(const CLI::App& app, const std::string& stem,
                               const std::string& directory) {
  const std::string path = directory + '/' + stem + ".1";
  CLEW_RETURN_IF_ERROR(files::write_file(path, manual_page(app, CLEW_VERSION)));
  for (const CLI::App* command : shown_commands(app)) {
    CLEW_RETURN_IF_ERROR(write_pages(*command, stem + '-' + command->get_name(), directory));
  }
  return {};
}

int completion_command(const CLI::App& main, const std::string& shell) {
  if (shell == "bash") {
    fmt::print("{}", bash_completion(main));
  } else if (shell == "zsh") {
    fmt::print("{}", zsh_completion(main));
  } else {
    return complain({core::unknown_name("shell", shell, {"bash", "zsh"}), {}, 0, 0});
  }
  return kExitGood;
}

}  // namespace

void add_completion(CLI::App& main, int& status) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* app = main.add_subcommand("completion", "Print a script that completes command lines");
  app->add_option("shell", *shell, "bash | zsh")->required();
  app->callback([&main, shell, &status] { status = completion_command(main, *shell); });
}

void add_manual(CLI::App& main, int& status) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* app = main.add_subcommand("manual", "Write the manual pages into a directory");
  app->group("");  // for those who build packages
  app->add_option("directory", *directory, "where to, one page a command")->required();
  app->callback([&main, directory, &status] {
    const auto written = write_pages(main, main.get_name(), *directory);
    status = written.ok() ? kExitGood : complain(written.error());
  });
}

}  // namespace clew::tools
