// SPDX-License-Identifier: Apache-2.0
#include "clew/own_program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "clew/version.hpp"
#include "core/hash128.hpp"

namespace clew::tools {

std::string own_program() {
  const std::string link = "/proc/self/exe";
  char path[4096];
  const ssize_t length = ::readlink(link.c_str(), path, sizeof path);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : link;
}

core::Result<std::string> program_fingerprint() {
  std::FILE* file = std::fopen("/proc/self/exe", "rb");
  if (file == nullptr) return core::Error{"cannot be read", "/proc/self/exe"};
  std::string bytes;
  char buffer[1 << 16];
  for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
    bytes.append(buffer, got);
  }
  std::fclose(file);
  return fmt::format("{} (build {})", CLEW_VERSION, core::hash128(bytes).hex());
}

}  // namespace clew::tools
