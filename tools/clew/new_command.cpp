// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "core/nearest_name.hpp"
#include "files/whole_file.hpp"
#include "runtime/plugin_list.hpp"

namespace clew::tools {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;

struct NewOptions {
  std::string kind;
  std::string name;
  std::string directory;  ///< empty: ./NAME
};

/// Kinds of behaviours, and where they stand in a graph.
const std::map<std::string, std::string> kParts = {
    {"detector", "recover.detector"}, {"escape", "recover.escape"}, {"controller", "control"},
    {"classifier", "classify"},       {"sensor", "sense"},          {"drive", "drive"}};

/// CMake keeps these for itself: no library of a project can have such a name.
const std::set<std::string> kCMakesOwn = {"all",           "clean",   "depend",  "edit_cache",
                                          "help",          "install", "package", "package_source",
                                          "rebuild_cache", "test"};

Result<void> check(const NewOptions& options) {
  if (kParts.count(options.kind) == 0) {
    std::vector<std::string> known;
    for (const auto& [kind, part] : kParts) known.push_back(kind);
    return Error{core::unknown_name("kind", options.kind, known)};
  }
  const std::string& name = options.name;
  const bool good = !name.empty() && name.size() <= 40 &&
                    std::islower(static_cast<unsigned char>(name[0])) != 0 &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return c == '_' || std::islower(static_cast<unsigned char>(c)) != 0 ||
                             std::isdigit(static_cast<unsigned char>(c)) != 0;
                    });
  if (kCMakesOwn.count(name) != 0) {
    return Error{"found the name '" + name + "', which CMake keeps for itself; allowed: any other"};
  }
  if (good) return {};
  return Error{"found the name '" + name +
               "'; allowed: a letter, then letters, digits and _, all small, at most 40"};
}

/// `my_detector` as a class: `MyDetector`.
std::string class_name(const std::string& name) {
  std::string words;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') {
      words += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    }
    begins = c == '_';
  }
  return words;
}

std::string filled(std::string text, const std::map<std::string, std::string>& words) {
  for (const auto& [word, value] : words) {
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size()) {
      text.replace(at, word.size(), value);
    }
  }
  return text;
}

Result<fs::path> find_templates() {
  for (const std::string& root : runtime::config_roots()) {
    const fs::path folder = fs::path(root) / "templates" / "plugin";
    std::error_code code;
    if (fs::is_directory(folder, code)) return folder;
  }
  return Error{"there are no templates/plugin in " + runtime::config_roots().front()};
}

Result<void> write(const fs::path& from, const fs::path& to,
                   const std::map<std::string, std::string>& words) {
  std::ifstream source(from);
  std::ostringstream text;
  text << source.rdbuf();
  if (!source) return Error{"cannot be read", from.string()};
  return files::write_file(to.string(), filled(text.str(), words));
}

Result<void> write_project(const NewOptions& options, const fs::path& folder) {
  const auto templates = find_templates();
  if (!templates.ok()) return templates.error();
  std::error_code code;
  if (fs::exists(folder, code)) {
    return Error{"is there already; nothing was written", folder.string()};
  }
  fs::create_directories(folder, code);
  if (code) return Error{"cannot be made: " + code.message(), folder.string()};
  const std::map<std::string, std::string> words = {{"@NAME@", options.name},
                                                    {"@CLASS@", class_name(options.name)},
                                                    {"@KIND@", options.kind},
                                                    {"@PART@", kParts.at(options.kind)}};
  const std::pair<std::string, std::string> files[] = {
      {"CMakeLists.txt.in", "CMakeLists.txt"},
      {"README.md.in", "README.md"},
      {options.kind + ".yaml.in", "graph.yaml"},
      {options.kind + ".cpp.in", options.name + ".cpp"}};
  for (const auto& [from, to] : files) {
    CLEW_RETURN_IF_ERROR(write(*templates / from, folder / to, words));
  }
  return {};
}

int new_command(const NewOptions& options) {
  if (const auto checked = check(options); !checked.ok()) return complain(checked.error());
  const std::string folder = options.directory.empty() ? options.name : options.directory;
  const auto written = write_project(options, folder);
  if (!written.ok()) return complain(written.error());
  fmt::print(
      "{0}: CMakeLists.txt, README.md, graph.yaml, {1}.cpp\n"
      "build it: cmake -S {0} -B {0}/build && cmake --build {0}/build\n"
      "test it:  ctest --test-dir {0}/build --output-on-failure\n"
      "run it:   clew run {0}/graph.yaml --plugin {0}/build/lib{1}.so\n",
      folder, options.name);
  return kExitGood;
}

}  // namespace

void add_new(CLI::App& main, int& status) {
  const auto options = std::make_shared<NewOptions>();
  CLI::App* app = main.add_subcommand("new", "Write the project of a plug-in with a behaviour");
  app->add_option("kind", options->kind,
                  "detector | escape | controller | classifier | sensor | drive")
      ->required();
  app->add_option("name", options->name, "of the behaviour: small letters, digits and _")
      ->required();
  app->add_option("--dir", options->directory, "where to (./NAME)")->check(given_name());
  app->callback([options, &status] { status = new_command(*options); });
}

}  // namespace clew::tools
