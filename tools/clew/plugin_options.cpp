// SPDX-License-Identifier: Apache-2.0
#include "clew/plugin_options.hpp"

#include <cstdio>

#include "log/log.hpp"
#include "plugins/plugin_loader.hpp"
#include "runtime/config_source.hpp"

namespace clew::tools {

void add_plugins(CLI::App& app, std::vector<std::string>& plugins) {
  app.add_option("--plugin", plugins,
                 "NAME or path of a library that adds behaviours; may be repeated")
      ->allow_extra_args(false);
}

core::Result<void> load_plugins_of(const std::vector<std::string>& plugins,
                                   const std::string& graph) {
  if (graph.empty()) return bridge::load_plugins(plugins);
  const auto file = runtime::ConfigPath::from_environment().find("graphs", graph);
  return bridge::load_plugins(plugins, file.ok() ? &*file : nullptr);
}

core::Result<void> load_plugins_for(const bridge::RunRecording& recording,
                                    const std::vector<std::string>& plugins) {
  CLEW_RETURN_IF_ERROR(bridge::load_plugins(plugins));
  const auto graph = runtime::BundleSource(recording.description().bundle).find("graphs", "graph");
  if (!graph.ok()) return {};
  for (const std::string& note : bridge::other_plugins(*graph)) {
    logs::info("{}: {}", recording.path(), note);
  }
  return {};
}

}  // namespace clew::tools
