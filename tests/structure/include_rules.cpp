// SPDX-License-Identifier: Apache-2.0
#include "include_rules.hpp"

#include <map>
#include <optional>
#include <regex>

namespace clew::structure {
namespace {

using Folders = std::set<std::string>;

/// The stages that are the world, or may know it.
const Folders kKnowTheWorld = {"sense", "drive", "plan"};
const Folders kStages = {"sense", "classify", "recover", "control", "drive", "plan"};

/// What each folder may include of the project besides itself.
const std::map<std::string, Folders> kLayers = {
    {"components/core", {}},
    {"components/domain", {"core"}},
    {"components/world", {"core", "domain"}},
    {"components/scan", {"core", "domain"}},
    {"components/map", {"core", "domain"}},
    {"components/runtime", {"core", "domain", "world"}},
    {"components/stages",
     {"core", "domain", "world", "runtime", "sense", "classify", "recover", "control", "drive",
      "plan"}},
    {"components/plugin", {"core", "domain", "runtime", "stages"}},
    {"bridge/plugins", {"core", "domain", "runtime", "stages", "plugin"}},
    {"bridge/log", {"core"}},
    {"bridge/files", {"core"}},
    {"bridge/wire", {"core", "domain"}},
    {"bridge/recording", {"core", "domain", "wire"}},
    {"bridge/dds", {"core"}},
    {"bridge/fastdds", {"core", "dds"}},
    {"bridge/cyclonedds", {"core", "dds"}},
    {"bridge/vendors", {"core", "dds", "fastdds", "cyclonedds"}},
    {"bridge/security", {"core", "dds", "vendors"}},
    {"bridge/run", {"core", "domain", "world", "runtime", "wire", "recording"}},
    {"bridge/line", {"core", "domain", "runtime", "dds", "run"}},
    {"bridge/component",
     {"core", "log", "domain", "scan", "runtime", "wire", "dds", "vendors", "plugins", "run",
      "line"}},
    {"bridge/watch", {"core", "log", "domain", "runtime", "wire", "dds", "vendors", "run", "line"}},
    {"bridge/ros2",
     {"core", "log", "domain", "map", "world", "runtime", "wire", "recording", "dds", "vendors",
      "run", "line", "watch"}},
    {"bridge/domains",
     {"core", "log", "domain", "wire", "dds", "vendors", "run", "line", "watch", "ros2"}},
    {"bridge/robot",
     {"core", "log", "domain", "world", "runtime", "drive", "dds", "vendors", "ros2"}},
    {"bridge/recorder", {"core", "log", "domain", "runtime", "wire", "recording", "run", "line"}},
    {"bridge/supervisor",
     {"core", "log", "domain", "runtime", "wire", "recording", "dds", "vendors", "security",
      "plugins", "run", "line", "component", "recorder"}},
    {"bridge/fleet",
     {"core", "domain", "world", "runtime", "wire", "recording", "run", "line", "recorder"}},
    {"bridge/hosts",
     {"core", "log", "domain", "runtime", "wire", "dds", "vendors", "security", "run", "line",
      "component", "supervisor"}},
    {"bridge/replay",
     {"core", "log", "domain", "world", "runtime", "wire", "recording", "dds", "vendors", "run",
      "line", "component", "recorder", "supervisor"}},
    {"bridge/gateway",
     {"core", "log", "files", "domain", "map", "world", "runtime", "wire", "recording", "run",
      "line", "recorder", "supervisor"}},
};

/// Beginnings of the libraries' headers, and the folder that wraps the library.
const std::vector<std::pair<std::string, std::string>> kVendors = {
    {"fastdds/", "bridge/fastdds"}, {"fastrtps/", "bridge/fastdds"}, {"fastcdr/", "bridge/fastdds"},
    {"dds/", "bridge/cyclonedds"},  {"ddsi/", "bridge/cyclonedds"},
};

struct Include {
  std::string path;
  bool quoted = false;
  std::size_t line = 0;
};

std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(file.lines[i], match, kInclude)) continue;
    includes.push_back({match[2], match[1] == "\"", i + 1});
  }
  return includes;
}

std::string first_folder(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// `components/core`: the first two words of the path.
std::string folder_of(const SourceFile& file) {
  const auto parts = file.path_parts();
  return parts.size() < 3 ? "" : parts[0] + '/' + parts[1];
}

bool is_source(const SourceFile& file) {
  const std::string extension = file.extension();
  return extension == ".cpp" || extension == ".hpp" || extension == ".c" || extension == ".h";
}

/// The component, the registry and the declaration of a stage tie behaviours to the runtime.
bool ties_to_runtime(const SourceFile& file) {
  const std::string stem = file.stem();
  const std::string tail = "_component";
  return stem == "registry" || stem == "stage" ||
         (stem.size() > tail.size() &&
          stem.compare(stem.size() - tail.size(), tail.size(), tail) == 0);
}

/// The folders that a file may include, or nothing if its folder has no place in the layers.
std::optional<Folders> allowed_folders(const SourceFile& file) {
  const std::string folder = folder_of(file);
  const std::string name = folder.substr(folder.find('/') + 1);
  Folders allowed;
  if (first_folder(folder) == "components" && kStages.count(name) > 0) {
    allowed = {"core", "domain", "scan", "map"};
    if (kKnowTheWorld.count(name) > 0) allowed.insert("world");
    if (ties_to_runtime(file)) allowed.insert("runtime");
  } else if (const auto layer = kLayers.find(folder); layer != kLayers.end()) {
    allowed = layer->second;
  } else {
    return std::nullopt;
  }
  allowed.insert(name);
  return allowed;
}

std::string listed(const Folders& folders) {
  std::string text;
  for (const std::string& folder : folders) text += (text.empty() ? "" : ", ") + folder;
  return text;
}

}  // namespace

std::set<std::string> own_headers(const std::vector<SourceFile>& tree) {
  std::set<std::string> own;
  for (const SourceFile& file : tree) {
    const std::string& path = file.path;
    if (is_source(file) && first_folder(path) != "tests") {
      own.insert(path.substr(path.find('/') + 1));
    }
  }
  return own;
}

std::vector<std::string> check_layers(const SourceFile& file, const std::set<std::string>& own) {
  const std::string root = first_folder(file.path);
  if (!is_source(file) || (root != "components" && root != "bridge")) return {};
  const auto allowed = allowed_folders(file);
  if (!allowed) return {violation(file, 1, "its folder has no place in the layers")};
  std::vector<std::string> found;
  for (const Include& include : includes_of(file)) {
    if (!include.quoted) continue;
    const std::string folder = first_folder(include.path);
    if (folder.empty()) {
      found.push_back(violation(file, include.line,
                                "includes " + include.path + " without the path of its folder"));
    } else if (own.count(include.path) > 0 && allowed->count(folder) == 0) {
      found.push_back(violation(file, include.line,
                                "includes " + include.path + "; allowed: " + listed(*allowed)));
    }
  }
  return found;
}

std::vector<std::string> check_runtime_texts(const SourceFile& file) {
  static const std::regex kText(R"re("(\\.|[^"\\])*")re");
  static const std::regex kWord(R"(\w+)");
  if (folder_of(file) != "components/runtime" || !is_source(file)) return {};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string line = std::regex_replace(file.lines[i], std::regex(R"(^\s*(//|#).*)"), "");
    for (std::sregex_iterator text(line.begin(), line.end(), kText), end; text != end; ++text) {
      const std::string words = text->str();
      for (std::sregex_iterator word(words.begin(), words.end(), kWord); word != end; ++word) {
        if (kStages.count(word->str()) == 0) continue;
        found.push_back(violation(file, i + 1, "names the stage " + word->str()));
      }
    }
  }
  return found;
}

std::vector<std::string> check_vendor_headers(const SourceFile& file,
                                              const std::set<std::string>& own) {
  if (!is_source(file) || first_folder(file.path) == "tests") return {};
  std::vector<std::string> found;
  for (const Include& include : includes_of(file)) {
    if (include.quoted && own.count(include.path) > 0) continue;
    for (const auto& [beginning, home] : kVendors) {
      if (include.path.compare(0, beginning.size(), beginning) != 0 || folder_of(file) == home) {
        continue;
      }
      found.push_back(violation(file, include.line,
                                "includes " + include.path + " of a vendor; allowed in " + home));
    }
  }
  return found;
}

}  // namespace clew::structure
