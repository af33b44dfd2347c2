// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/help_groups.hpp"
#include "clew/log_options.hpp"
#include "clew/stack_limit.hpp"
#include "clew/standard_streams.hpp"
#include "clew/train_commands.hpp"
#include "clew/version.hpp"
#include "core/nearest_name.hpp"

namespace clew::tools {
namespace {

void add_train(CLI::App& main, int& status) {
  CLI::App* train = main.add_subcommand("train", "Train a network");
  train->require_subcommand(1);
  add_train_som(*train, status);
  add_train_neuro_fuzzy(*train, status);
}

/// Gives each command the flag --version that the program has.
void add_versions(CLI::App& app) {
  app.set_version_flag("--version", version_text());
  for (CLI::App* command : app.get_subcommands({})) {
    command->set_version_flag("--version", version_text());
  }
}

/// Lets no option and argument that is a whole number begin with a zero: CLI11 would read 010 as 8.
void add_decimal_checks(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    // A range follows the type's name.
    const std::string type = option->get_type_name();
    if (type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0) option->check(decimal_number());
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    add_decimal_checks(*command);
  }
}

/// CLI11 would only say that a command is required.
core::Result<void> check_command(const CLI::App& app, const std::string& name) {
  if (name.empty() || name.front() == '-') return {};
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return {};
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  return core::Error{core::unknown_name("command", name, known)};
}

core::Result<void> check_commands(const CLI::App& app, const std::vector<char*>& words) {
  if (words.size() < 2) {
    return core::Error{
        "what shall it do? 'clew --help' lists the commands, 'clew run default' runs a robot"};
  }
  const std::string command = words[1];
  CLEW_RETURN_IF_ERROR(check_command(app, command));
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (known->get_name() != command || known->get_require_subcommand_min() == 0) continue;
    if (words.size() > 2) return check_command(*known, words[2]);
    return core::Error{"what shall '" + command + "' do? 'clew " + command +
                       " --help' lists its commands"};
  }
  return {};
}

/// The words of the command line: `clew help run` is `clew run --help`.
std::vector<char*> words_of(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  static char help[] = "--help";
  if (words.size() > 1 && std::string(words[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back(help);
  }
  return words;
}

/// CLI11 would rather name an argument that is missing than an option that nobody knows.
core::Result<void> check_options(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    CLEW_RETURN_IF_ERROR(check_options(*command));
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // kept for later
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word.size() < 2 || word.front() != '-') continue;
    return core::Error{core::unknown_name("option", word, known)};
  }
  return {};
}

/// What is wrong with the command line, in our words where CLI11 has its own.
std::string parse_error_text(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string converting = "Could not convert: ";
  const std::string twice = ": At Most 1 required but received ";
  const auto value = text.find(" = ");
  if (text.rfind(converting, 0) == 0 && value != std::string::npos) {
    const std::string found = text.substr(value + 3);
    // What is a number, and not taken for one, has a fraction or too many digits.
    char* end = nullptr;
    std::strtod(found.c_str(), &end);
    const bool is_number = !found.empty() && *end == '\0';
    const bool is_whole = found.find_first_not_of("+-0123456789") == std::string::npos;
    return fmt::format("{}: found '{}'; allowed: a {}number",
                       text.substr(converting.size(), value - converting.size()), found,
                       !is_number ? ""
                       : is_whole ? "smaller "
                                  : "whole ");
  }
  const auto option = text.find(twice);
  if (option != std::string::npos) {
    return text.substr(0, option) + ": is given more than once; once is allowed";
  }
  return text;
}

/// CLI11's callbacks return nothing; this one comes before the command's.
struct LogRefusal {
  core::Error error;
};

int parse_and_run(const std::vector<char*>& words) {
  CLI::App app("Sensor-based navigation of a mobile robot as a graph of DDS components", "clew");
  app.require_subcommand(1);
  // CLI11's callbacks return nothing, so each command leaves its status here.
  int status = kExitGood;
  // In the order of the help.
  for (const auto add :
       {add_list,      add_check,   add_rules,  add_world,        add_doctor,     add_run,
        add_component, add_bridge,  add_host,   add_keys,         add_live,       add_top,
        add_topic,     add_view,    add_report, add_info,         add_events,     add_explain,
        add_echo,      add_plot,    add_export, add_import,       add_sign,       add_replay,
        add_diff,      add_bisect,  add_bench,  add_query,        add_encounters, add_hunt,
        add_shrink,    add_tune,    add_new,    add_check_plugin, add_train,      add_completion,
        add_recorder,  add_gateway, add_manual, add_relay}) {
    add(app, status);
  }
  add_versions(app);
  add_help(app);
  add_decimal_checks(app);
  const auto log = std::make_shared<LogOptions>();
  add_log_options(app, log);
  app.parse_complete_callback([&] {
    if (const auto opened = open_log(app, *log); !opened.ok()) throw LogRefusal{opened.error()};
  });
  if (const auto known = check_commands(app, words); !known.ok()) {
    return complain(known.error());
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const LogRefusal& refusal) {
    return complain(refusal.error);
  } catch (const CLI::ParseError& error) {
    const auto all_known = check_options(app);
    if (!all_known.ok()) return complain(all_known.error());
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain({parse_error_text(error) + "; see --help", {}, 0, 0});
  }
  return status;
}

/// Whether nobody reads standard output any more.
bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// What was said has not arrived, for the reason `number`, or 0 if that is not known any more. A
/// reader that has gone wants no more, also no complaint.
int complain_of_output(int number) {
  if (reader_has_gone()) return kExitFailed;
  const std::string why = number == 0 ? "writing failed" : std::generic_category().message(number);
  return complain({why, "standard output", 0, 0}, kExitFailed);
}

}  // namespace
}  // namespace clew::tools

int main(int argc, char** argv) {
  using namespace clew::tools;
  hold_standard_streams();
  if (const auto raised = raise_small_stacks(); !raised.ok()) return complain(raised.error());
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  // Writing reports these instead: a reader that has gone, a file that has reached its limit.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const int status = parse_and_run(words_of(argc, argv));
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    return complain_of_output(errno);
  } catch (const std::system_error& error) {  // of fmt::print
    return complain_of_output(error.code().value());
  }
}
