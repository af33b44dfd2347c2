// SPDX-License-Identifier: Apache-2.0
#include "clew/own_program.hpp"

#include <unistd.h>

namespace clew::tools {

std::string own_program() {
  const std::string link = "/proc/self/exe";
  char path[4096];
  const ssize_t length = ::readlink(link.c_str(), path, sizeof path);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : link;
}

}  // namespace clew::tools
