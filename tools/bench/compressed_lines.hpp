// SPDX-License-Identifier: Apache-2.0
/// Files of lines in zstd's format, `NAME.zst` in the place of NAME.
#pragma once

#include <memory>
#include <streambuf>
#include <string>

#include "core/result.hpp"

namespace clew::bench {

constexpr char kCompressedEnding[] = ".zst";

/// Reads a compressed file as a stream of bytes.
class CompressedInput : public std::streambuf {
 public:
  explicit CompressedInput(const std::string& path);
  ~CompressedInput() override;
  CompressedInput(const CompressedInput&) = delete;
  CompressedInput& operator=(const CompressedInput&) = delete;

  bool is_open() const;
  /// What is wrong with the file, as far as it was read; empty: nothing.
  const std::string& damage() const { return damage_; }

 protected:
  int_type underflow() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string damage_;
};

/// Puts `path.zst` in the place of `path`.
core::Result<void> compress_file(const std::string& path);
/// Puts `path` in the place of `path.zst`.
core::Result<void> expand_file(const std::string& path);

}  // namespace clew::bench
