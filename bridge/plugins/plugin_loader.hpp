// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "runtime/plugin_list.hpp"

namespace clew::bridge {

/// The file that a user means by a plug-in's name: a path if it has a slash; else
/// `plugins/libNAME.so` or `libNAME.so` in the first of `roots` that has one.
core::Result<std::string> find_plugin_file(const std::string& name,
                                           const std::vector<std::string>& roots);

/// Loads a plug-in for the rest of this process, and adds its behaviours to the stages. Before any
/// of its code runs, its descriptor is read and checked. One that is loaded already stays. Refused,
/// besides: two plug-ins of one name, and a behaviour whose name is taken.
core::Result<void> load_plugin(const std::string& path);

/// Loads those that a user named, and those that the graph file does; paths in it are from the
/// working directory, as all paths in graph files are.
core::Result<void> load_plugins(const std::vector<std::string>& names,
                                const core::Resource* graph = nullptr);

/// Under this name an assignment's bundle carries the plug-ins to load.
inline constexpr char kPluginLines[] = "plugins";

/// The files of the loaded plug-ins, for the processes of a run: a line each, digest and path.
std::string plugin_lines();
/// Loads those of such lines. Refused: a file that has changed since.
core::Result<void> load_plugin_lines(const std::string& lines);

/// Refuses lines of a plug-in whose file is not among the `allowed` paths.
core::Result<void> check_plugin_lines(const std::string& lines,
                                      const std::vector<std::string>& allowed);

/// What a user should know of a recorded graph whose plug-ins are loaded: each that has another
/// digest than it had, a sentence each.
std::vector<std::string> other_plugins(const core::Resource& recorded_graph);

}  // namespace clew::bridge
