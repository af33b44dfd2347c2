// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::runtime {

/// Where graphs, worlds, robots and data files come from.
class ConfigSource {
 public:
  virtual ~ConfigSource() = default;
  /// The file called `name` in `folder` (`graphs`, `worlds`, `robots`, `rulebases`, ...).
  virtual core::Result<core::Resource> find(const std::string& folder,
                                            const std::string& name) const = 0;
};

/// Files on disk. A name with a slash or ending in .yaml is a path; any other is looked up as
/// `<root>/<folder>/<name>.yaml` in each root in turn. A file of `maps` comes with the picture that
/// its `image` names, a path from where the file is.
class ConfigPath : public ConfigSource {
 public:
  explicit ConfigPath(std::vector<std::string> roots) : roots_(std::move(roots)) {}
  /// configs/ of the source tree or share/clew of the installation, whichever holds the running
  /// program; then the directories of CLEW_PATH (separated by colons), the user's own
  /// (~/.config/clew) and the machine's (/etc/clew). The first that has a name wins.
  static ConfigPath from_environment();

  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override;
  /// The names in `folder`, sorted, each once.
  std::vector<std::string> names(const std::string& folder) const;

 private:
  std::vector<std::string> roots_;
};

/// The files that a run was made of, by name: `graph.yaml` (fully expanded), `world.yaml`,
/// `robot.yaml`, and data files as `rulebases/krishna_kalra_som.yaml`, with a map's picture as
/// `maps/office.image`. A recording carries it, and
/// a run's processes get it from their supervisor.
using Bundle = std::map<std::string, std::string>;

/// Adds a data file to a bundle.
void add_to_bundle(const std::string& folder, const std::string& name, const core::Resource& file,
                   Bundle& bundle);

/// A bundle's own files, and others for data files that it does not have.
class BundleAndFiles : public ConfigSource {
 public:
  BundleAndFiles(const Bundle& bundle, const ConfigSource& files)
      : bundle_(bundle), files_(files) {}
  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override;

 private:
  const Bundle& bundle_;
  const ConfigSource& files_;
};

/// A bundle as a source: every graph, world and robot is the one that it holds.
class BundleSource : public ConfigSource {
 public:
  explicit BundleSource(const Bundle& bundle) : bundle_(bundle) {}
  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override;

 private:
  const Bundle& bundle_;
};

}  // namespace clew::runtime
