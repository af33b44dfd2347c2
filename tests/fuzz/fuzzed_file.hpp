// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace clew::fuzz {

/// Bytes as a file that can be opened by its path: in memory, and gone with the object.
class FuzzedFile {
 public:
  FuzzedFile(const std::uint8_t* bytes, std::size_t size);
  ~FuzzedFile();
  FuzzedFile(const FuzzedFile&) = delete;
  FuzzedFile& operator=(const FuzzedFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace clew::fuzz
