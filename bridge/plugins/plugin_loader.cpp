// SPDX-License-Identifier: Apache-2.0
#include "plugins/plugin_loader.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "plugins/plugin_file.hpp"
#include "stages/additions.hpp"

namespace clew::bridge {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;
using AddFunction = void(stages::Additions*);

/// The function of a plug-in, as the linker gives it.
Result<void*> open(const PluginFile& file) {
  // All symbols now: a library that lacks one is refused here, and not in the middle of a run.
  void* const handle = ::dlopen(file.path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = handle == nullptr ? nullptr : ::dlsym(handle, plugin::kEntry);
  if (entry == nullptr) {
    const char* const why = ::dlerror();
    return Error{std::string("cannot be loaded: ") + (why == nullptr ? "unknown reason" : why),
                 file.path};
  }
  return entry;
}

Result<void> load(const PluginFile& file) {
  if (const runtime::PluginInfo* loaded = runtime::find_plugin(file.name())) {
    if (loaded->digest == file.digest) return {};
    return Error{"plug-in '" + file.name() + "' is loaded already, from " + loaded->file,
                 file.path};
  }
  CLEW_RETURN_IF_ERROR(check_fits(file));
  const auto entry = open(file);
  if (!entry.ok()) return entry.error();
  stages::Additions additions;
  reinterpret_cast<AddFunction*> (*entry)(&additions);
  auto behaviours = stages::add(std::move(additions));
  if (!behaviours.ok()) return Error{behaviours.error().message, file.path};
  if (behaviours->empty()) return Error{"adds no behaviour", file.path};
  runtime::note_plugin(
      {file.name(), file.version(), file.path, file.digest, std::move(behaviours).value()});
  return {};
}

}  // namespace

Result<std::string> find_plugin_file(const std::string& name,
                                     const std::vector<std::string>& roots) {
  if (name.find('/') != std::string::npos) return name;
  const std::string file = "lib" + name + ".so";
  std::string searched;
  for (const std::string& root : roots) {
    for (const fs::path& path : {fs::path(root) / "plugins" / file, fs::path(root) / file}) {
      std::error_code code;
      if (fs::exists(path, code)) return path.string();
    }
    searched += (searched.empty() ? "" : ", ") + root;
  }
  return Error{"there is no plug-in '" + name + "': no plugins/" + file + " or " + file + " in " +
               searched + " (CLEW_PATH adds directories; a path needs a slash)"};
}

Result<void> load_plugin(const std::string& path) {
  const auto file = read_plugin_file(path);
  if (!file.ok()) return file.error();
  return load(*file);
}

Result<void> load_plugins(const std::vector<std::string>& names, const core::Resource* graph) {
  const std::vector<std::string> roots = runtime::config_roots();
  for (const std::string& name : names) {
    const auto path = find_plugin_file(name, roots);
    if (!path.ok()) return Error{path.error().message, "--plugin"};
    CLEW_RETURN_IF_ERROR(load_plugin(*path));
  }
  if (graph == nullptr) return {};
  const auto named = runtime::read_plugins(*graph);
  // A text that is no graph is refused by who reads it as one.
  if (!named.ok()) return {};
  for (const runtime::NamedPlugin& plugin : *named) {
    if (runtime::find_plugin(plugin.name) != nullptr) continue;
    const auto path = find_plugin_file(plugin.name, roots);
    if (!path.ok()) return plugin.place.error(path.error().message);
    const auto loaded = load_plugin(*path);
    if (!loaded.ok()) return plugin.place.error("plugins: " + loaded.error().text());
  }
  return {};
}

std::string plugin_lines() {
  std::string lines;
  for (const runtime::PluginInfo& plugin : runtime::loaded_plugins()) {
    lines += plugin.digest + ' ' + plugin.file + '\n';
  }
  return lines;
}

Result<void> load_plugin_lines(const std::string& lines) {
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos) return Error{"the run names no plug-in"};
    const auto file = read_plugin_file(line.substr(space + 1));
    if (!file.ok()) return file.error();
    if (file->digest != line.substr(0, space)) {
      return Error{"has changed since the run began", file->path};
    }
    CLEW_RETURN_IF_ERROR(load(*file));
  }
  return {};
}

Result<void> check_plugin_lines(const std::string& lines, const std::vector<std::string>& allowed) {
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    const std::string path = line.substr(line.find(' ') + 1);
    if (std::count(allowed.begin(), allowed.end(), path) > 0) continue;
    return Error{"this host does not load it for others; see --allow of 'clew host'", path};
  }
  return {};
}

std::vector<std::string> other_plugins(const core::Resource& recorded_graph) {
  std::vector<std::string> notes;
  const auto named = runtime::read_plugins(recorded_graph);
  if (!named.ok()) return notes;
  for (const runtime::NamedPlugin& plugin : *named) {
    const runtime::PluginInfo* loaded = runtime::find_plugin(plugin.name);
    if (loaded == nullptr || plugin.digest.empty() || loaded->digest == plugin.digest) continue;
    notes.push_back("plug-in '" + plugin.name + "' (" + loaded->file + ") has digest " +
                    loaded->digest + "; recorded with " + plugin.digest);
  }
  return notes;
}

}  // namespace clew::bridge
