// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace clew::fuzz {

/// Bytes as a file that can be opened by its path: in memory, and gone with the object.
class FuzzedFile {
 public:
  explicit FuzzedFile(std::string_view bytes);
  ~FuzzedFile();
  FuzzedFile(const FuzzedFile&) = delete;
  FuzzedFile& operator=(const FuzzedFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace clew::fuzz
