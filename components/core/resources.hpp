// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/result.hpp"

namespace clew::core {

/// The text of a data file, and what to call it in an error.
struct Resource {
  std::string file;
  std::string text;
  std::string image = {};  ///< bytes of the picture that the file names, if it is a map
};

/// The data files of a run (rule bases, trained networks) by `folder/name`, read beforehand: a
/// behaviour never opens a file, and a recording can carry them all.
class Resources {
 public:
  void add(const std::string& folder, const std::string& name, Resource resource) {
    files_[folder + '/' + name] = std::move(resource);
  }
  Result<Resource> find(const std::string& folder, const std::string& name) const {
    const auto found = files_.find(folder + '/' + name);
    if (found == files_.end()) return Error{"no data file '" + folder + '/' + name + "'"};
    return found->second;
  }
  const std::map<std::string, Resource>& all() const { return files_; }

 private:
  std::map<std::string, Resource> files_;
};

}  // namespace clew::core
