// SPDX-License-Identifier: Apache-2.0
#include "vendors/memory_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace clew::bridge {

// The path goes by the number of this process, since those who read it are others.
MemoryFile::MemoryFile(const std::string& name, const std::string& text)
    : descriptor_(::memfd_create(name.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  const bool written =
      descriptor_ >= 0 &&
      ::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fchmod(descriptor_, S_IRUSR) == 0 &&
      ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE) ==
          0;
  if (!written) failure_ = fmt::format("{} cannot be written: {}", name, std::strerror(errno));
  path_ = fmt::format("/proc/{}/fd/{}", ::getpid(), descriptor_);
}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace clew::bridge
