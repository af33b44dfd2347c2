// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "world/world.hpp"
#include "world_import/world_import.hpp"

namespace clew::world_import {

/// Files to import, in a directory of their own.
class SourceFiles {
 public:
  SourceFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "clew-import-XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
  }
  ~SourceFiles() { std::filesystem::remove_all(directory_); }
  SourceFiles(const SourceFiles&) = delete;
  SourceFiles& operator=(const SourceFiles&) = delete;

  std::string write(const std::string& name, const std::string& bytes) const {
    const std::string path = directory_ + '/' + name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  std::string path(const std::string& name) const { return directory_ + '/' + name; }

 private:
  std::string directory_;
};

/// The world that is imported from a file.
inline world::World world_from(const std::string& path, const ImportOptions& options = {}) {
  const auto text = import_world(path, options);
  EXPECT_TRUE(text.ok()) << text.error().text();
  auto world = world::World::parse(*text, "imported");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::move(world).value();
}

/// Why a file is refused.
inline std::string refusal_of(const std::string& path, const ImportOptions& options = {}) {
  const auto text = import_world(path, options);
  return text.ok() ? "" : text.error().text();
}

inline bool is_blocked(const world::World& world, double x_m, double y_m) {
  return world.clearance_m({x_m, y_m}, 1.0, 0.0) == 0.0;
}

}  // namespace clew::world_import
