// SPDX-License-Identifier: Apache-2.0
/// What manual pages and completions are made from: the tables that the command parses with.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace clew::tools {

/// Commands that `--help` lists, in its order.
std::vector<const CLI::App*> shown_commands(const CLI::App& app);
/// The options that `--help` lists, in its order, without positional arguments.
std::vector<const CLI::Option*> shown_options(const CLI::App& app);
/// The positional arguments, in order.
std::vector<const CLI::Option*> arguments_of(const CLI::App& app);
/// `-o`, `--output`, ...
std::vector<std::string> names_of(const CLI::Option& option);
/// Whether a value follows.
bool takes_value(const CLI::Option& option);

/// The page clew-COMMAND(1) of a command, or clew(1) of the program, as roff.
std::string manual_page(const CLI::App& app, const std::string& version);

/// A script that completes command lines in that shell.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

/// The list of names (`clew list graphs`) that an option or argument chooses from; empty if it
/// chooses from none.
std::string list_for(const CLI::App& command, const CLI::Option& option);

}  // namespace clew::tools
