// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <string>

#include "clew/command_tables.hpp"

namespace clew::tools {
namespace {

constexpr char kExitStatus[] = R"(.SH EXIT STATUS
.TP
0
Good. Of \fBrun\fR: the robot reached the target.
.TP
1
An internal error, or what was compared differs. Of \fBrun\fR: the run was aborted.
.TP
2
Bad usage or bad input; standard error says where, what was found and what is allowed.
.TP
3, 4, 5
Of \fBrun\fR: timeout, collided, unreachable.
.TP
130
Interrupted by SIGINT or SIGTERM.
)";

constexpr char kEnvironment[] = R"(.SH ENVIRONMENT
.TP
.B CLEW_PATH
Directories, separated by colons, where names of graphs, worlds, robots and data files are looked
up after those that are installed, and before those of the user and of the machine.
.TP
.B XDG_CONFIG_HOME
Where clew/ holds the user's own, in place of ~/.config; a relative path is ignored.
.TP
.B CLEW_DOMAIN_ID
The DDS domain of the run that a component belongs to, where \-\-domain does not say it.
.TP
.B CLEW_LOG_LEVEL
The least that is told: debug, info, warning, error or off. Options \-v and \-q outrank it.
.TP
.B CLEW_LOG_DIR
A directory where each process writes what it tells to a file of its own, with times.
.SH FILES
.TP
.I share/clew
Shipped graphs, worlds, robots, suites, rule bases and maps, in a folder each, beside the folder of
the program.
.TP
.I ~/.config/clew
The same folders, of the user. The key that recordings are signed with, signing.pem.
.TP
.I /etc/clew
The same folders, of the machine.
)";

/// Text that roff prints as it is.
std::string escaped(const std::string& text) {
  std::string roff;
  for (const char c : text) {
    if (c == '\\') {
      roff += "\\e";
    } else if (c == '-') {
      roff += "\\-";
    } else if ((c == '.' || c == '\'') && (roff.empty() || roff.back() == '\n')) {
      roff += std::string("\\&") + c;
    } else {
      roff += c;
    }
  }
  return roff;
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// `clew run`, as it is typed.
std::string typed_name(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name()
                                     : typed_name(*app.get_parent()) + ' ' + app.get_name();
}

std::string page_name(const CLI::App& app) {
  std::string name = typed_name(app);
  for (char& c : name) c = c == ' ' ? '-' : c;
  return name;
}

/// What stands for an option's value: an upper-case word that begins its description, else VALUE.
std::string value_name(const CLI::Option& option) {
  const std::string& text = option.get_description();
  std::string word = text.substr(0, text.find_first_of(" :,"));
  bool is_name = word.size() > 1;
  for (const char c : word) {
    is_name = is_name && (std::isupper(static_cast<unsigned char>(c)) != 0 || c == '.' ||
                          c == '=' || c == '[' || c == ']');
  }
  return is_name ? word : "VALUE";
}

std::string synopsis(const CLI::App& app) {
  std::string text = ".B " + escaped(typed_name(app)) + '\n';
  if (!shown_commands(app).empty()) text += ".I COMMAND\n";
  for (const CLI::Option* argument : arguments_of(app)) {
    const std::string name = escaped(capitals(argument->get_single_name()));
    const std::string more = argument->get_items_expected_max() > 1 ? "..." : "";
    text += argument->get_required() ? ".I " + name + more + '\n'
                                     : ".RI [ " + name + " ]" + more + '\n';
  }
  return text + ".RI [ OPTION ]...\n";
}

std::string arguments_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* argument : arguments_of(app)) {
    if (argument->get_description().empty()) continue;
    text += ".TP\n.I " + escaped(capitals(argument->get_single_name())) + '\n' +
            escaped(argument->get_description()) + '\n';
  }
  return text.empty() ? text : ".SH ARGUMENTS\n" + text;
}

std::string option_text(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : names_of(option)) {
    names += (names.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  }
  if (takes_value(option)) names += " \\fI" + escaped(value_name(option)) + "\\fR";
  return ".TP\n" + names + '\n' + escaped(option.get_description()) + '\n';
}

/// The options under the headings that `--help` has.
std::string options_text(const CLI::App& app) {
  std::string text = ".SH OPTIONS\n";
  for (const std::string& group : app.get_groups()) {
    std::string of_group;
    for (const CLI::Option* option : shown_options(app)) {
      if (option->get_group() == group) of_group += option_text(*option);
    }
    if (of_group.empty()) continue;
    if (group != "Options") text += ".SS " + escaped(group) + '\n';
    text += of_group;
  }
  return text;
}

std::string commands_text(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : shown_commands(app)) {
    text +=
        ".TP\n.BR " + page_name(*command) + " (1)\n" + escaped(command->get_description()) + '\n';
  }
  return text.empty() ? text : ".SH COMMANDS\n" + text;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  const std::string name = page_name(app);
  std::string text = ".\\\" Made by 'clew manual' from the tables of the command line.\n";
  text += ".TH " + capitals(name) + " 1 \"\" \"clew " + version + "\" \"Clew\"\n";
  text += ".SH NAME\n" + name + " \\- " + escaped(app.get_description()) + '\n';
  text += ".SH SYNOPSIS\n" + synopsis(app);
  text += arguments_text(app) + options_text(app) + commands_text(app);
  text += kExitStatus;
  text += kEnvironment;
  text += ".SH SEE ALSO\n";
  if (app.get_parent() == nullptr) return text + "Each command has a page of its own.\n";
  return text + ".BR " + page_name(*app.get_parent()) + " (1)\n";
}

}  // namespace clew::tools
