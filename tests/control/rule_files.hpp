// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "core/resources.hpp"

namespace clew::control {

/// A file of the source tree, as a behaviour gets it.
inline core::Resource file_of(const std::string& path) {
  std::ifstream stream(std::string(CLEW_SOURCE_DIR) + '/' + path, std::ios::binary);
  return {path.substr(path.rfind('/') + 1),
          {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()}};
}

inline core::Resource shipped_rules() {
  return file_of("configs/rulebases/krishna_kalra_control.yaml");
}

}  // namespace clew::control
