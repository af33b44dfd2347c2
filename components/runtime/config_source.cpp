// SPDX-License-Identifier: Apache-2.0
#include "runtime/config_source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/nearest_name.hpp"
#include "core/yaml_reader.hpp"
#include "runtime/plugin_list.hpp"
#include "runtime/user_folders.hpp"

namespace clew::runtime {
namespace {

namespace fs = std::filesystem;
constexpr char kExtension[] = ".yaml";
constexpr char kImageExtension[] = ".image";
// What the administrator of a machine has for all its users.
constexpr char kMachineConfigs[] = "/etc/clew";
constexpr char kMapFolder[] = "maps";

// A configuration beyond this is a mistake (a device, a recording); 100,000 segments are 4 MB.
constexpr std::uintmax_t kMaxFileBytes = 256u << 20;

// More names than these are for a list of their own, not for a line of error.
constexpr std::size_t kMostListed = 12;

// How a recording begins (MCAP).
constexpr char kRecordingMagic[] = "\x89MCAP";

// Paths are those of the shell, also where a graph file says them.
std::string from_where(const fs::path& path) {
  std::error_code code;
  if (path.is_absolute()) return {};
  return " (a path from the working directory, " + fs::current_path(code).string() + ')';
}

// What the files of a folder are called.
std::string kind_of(const std::string& folder) {
  if (folder == "training") return "recipe";
  if (folder == "rulebases") return "rule base";
  return folder.substr(0, folder.size() - 1);
}

core::Result<core::Resource> read_file(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    return core::Error{"cannot be read: " + why + from_where(path), path};
  };
  std::error_code code;
  if (!fs::is_regular_file(path, code)) {
    return refuse(code ? code.message()
                       : (fs::exists(path) ? "it is no regular file" : "there is no such file"));
  }
  if (fs::file_size(path, code) > kMaxFileBytes) return refuse("it is larger than 256 MiB");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return refuse(std::strerror(errno));
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) return refuse(std::strerror(errno));
  core::Resource file{path, text.str()};
  if (file.text.compare(0, sizeof kRecordingMagic - 1, kRecordingMagic) == 0) {
    return core::Error{
        "is a recording; 'clew info', 'clew replay' and 'clew plot' read it, and 'clew run "
        "--resume' goes on with one that was cut off",
        path};
  }
  return file;
}

// A map's file with its picture; any other as it is. What is wrong with the map's own text is said
// by who reads it.
core::Result<core::Resource> with_image(const std::string& folder,
                                        core::Result<core::Resource> file) {
  if (!file.ok() || folder != kMapFolder) return file;
  const auto root = core::YamlNode::parse(file->text, file->file);
  if (!root.ok()) return file;
  const auto node = root->find("image");
  if (!node.has_value() || !node->string().ok()) return file;
  const auto image = read_file((fs::path(file->file).parent_path() / *node->string()).string());
  if (!image.ok()) return node->error("image " + image.error().text());
  file->image = image->text;
  return file;
}

std::vector<std::string> names_in(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(directory, code)) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  }
  return names;
}

/// What a user who gave a file's name meant, if there is such a file.
std::string hint_at_file(const std::string& name) {
  for (const std::string& file : {name, name + kExtension}) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) continue;
    const bool recording = fs::path(file).extension() == ".mcap";
    return "; '" + file + "' is a file here: " +
           (recording ? "'clew info', 'clew replay' and 'clew view' read recordings"
                      : "a path has a slash or ends in .yaml");
  }
  return {};
}

/// share/clew in the nearest folder above the program that has one. In a build tree it is a link to
/// the source tree's configs/.
std::string shipped_configs(const std::string& program) {
  std::error_code code;
  const fs::path file = fs::canonical(program, code);
  for (fs::path folder = file.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    const fs::path configs = fs::canonical(folder / "share" / "clew", code);
    if (!code && fs::is_directory(configs / "graphs", code)) return configs.string();
  }
  return (file.parent_path().parent_path() / "share" / "clew").string();
}

bool is_there(const std::string& folder) {
  std::error_code code;
  return fs::is_directory(folder, code);
}

bool is_path(const std::string& name) {
  return name.find('/') != std::string::npos || fs::path(name).extension() == kExtension;
}

}  // namespace

std::vector<std::string> config_roots(const std::string& program) {
  std::vector<std::string> roots = {shipped_configs(program)};
  if (const char* path = std::getenv("CLEW_PATH")) {
    std::istringstream stream(path);
    for (std::string root; std::getline(stream, root, ':');) {
      if (!root.empty()) roots.push_back(root);
    }
  }
  if (const auto own = user_config_folder()) roots.push_back(*own);
  roots.emplace_back(kMachineConfigs);
  return roots;
}

ConfigPath ConfigPath::from_environment() { return ConfigPath(config_roots()); }

core::Result<core::Resource> ConfigPath::find(const std::string& folder,
                                              const std::string& name) const {
  if (is_path(name)) return with_image(folder, read_file(name));
  for (const std::string& root : roots_) {
    const fs::path path = fs::path(root) / folder / (name + kExtension);
    std::error_code code;
    if (fs::exists(path, code)) return with_image(folder, read_file(path.string()));
  }
  std::string searched;
  for (const std::string& root : roots_) {
    if (&root != &roots_.front() && !is_there(root)) continue;
    searched += (searched.empty() ? "" : ", ") + (fs::path(root) / folder).string();
  }
  const std::vector<std::string> known = names(folder);
  const std::string where =
      " (in " + searched + "; CLEW_PATH adds directories)" + hint_at_file(name);
  if (known.size() <= kMostListed) {
    return core::Error{core::unknown_name(kind_of(folder), name, known) + where};
  }
  const std::string nearest = core::nearest_name(name, known);
  return core::Error{"unknown " + kind_of(folder) + " '" + name + "'" +
                     (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") +
                     "; 'clew list " + folder + "' tells all " + std::to_string(known.size()) +
                     where};
}

std::vector<std::string> ConfigPath::names(const std::string& folder) const {
  std::set<std::string> names;
  for (const std::string& root : roots_) {
    for (std::string& name : names_in(fs::path(root) / folder)) names.insert(std::move(name));
  }
  return {names.begin(), names.end()};
}

core::Result<core::Resource> BundleSource::find(const std::string& folder,
                                                const std::string& name) const {
  std::string key = folder + '/' + name + kExtension;
  if (folder == "graphs") key = "graph.yaml";
  if (folder == "worlds") key = "world.yaml";
  if (folder == "robots") key = "robot.yaml";
  const auto found = bundle_.find(key);
  if (found == bundle_.end()) return core::Error{"the bundle has no " + key};
  core::Resource file{key, found->second};
  const auto image = bundle_.find(folder + '/' + name + kImageExtension);
  if (image != bundle_.end()) file.image = image->second;
  return file;
}

void add_to_bundle(const std::string& folder, const std::string& name, const core::Resource& file,
                   Bundle& bundle) {
  bundle[folder + '/' + name + kExtension] = file.text;
  if (!file.image.empty()) bundle[folder + '/' + name + kImageExtension] = file.image;
}

core::Result<core::Resource> BundleAndFiles::find(const std::string& folder,
                                                  const std::string& name) const {
  const bool is_data = folder != "graphs" && folder != "worlds" && folder != "robots";
  auto bundled = BundleSource(bundle_).find(folder, name);
  if (bundled.ok() || !is_data) return bundled;
  return files_.find(folder, name);
}

}  // namespace clew::runtime
