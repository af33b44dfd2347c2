// SPDX-License-Identifier: Apache-2.0
#include "fuzzed_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include "core/check.hpp"

namespace clew::fuzz {

FuzzedFile::FuzzedFile(std::string_view bytes)
    : descriptor_(::memfd_create("fuzzed", MFD_CLOEXEC)) {
  CLEW_CHECK(descriptor_ >= 0, "no file in memory can be made");
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    CLEW_CHECK(count > 0, "the memory is full");
    written += static_cast<std::size_t>(count);
  }
}

FuzzedFile::~FuzzedFile() { ::close(descriptor_); }

}  // namespace clew::fuzz
