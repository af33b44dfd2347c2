// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "recording/byte_buffer.hpp"

namespace clew::bridge::mcap {

/// How a chunk's records are packed. The same library version gives the same bytes.
enum class Compression { kNone, kZstd, kLz4 };

/// As it stands in a file: empty, `zstd`, `lz4`.
std::string_view compression_name(Compression compression);
std::optional<Compression> compression_from_name(std::string_view name);

/// Replaces `packed` by one frame that holds `bytes` (zstd level 3; lz4 frame format, level 0).
void compress(Compression compression, std::string_view bytes, std::string& packed);

/// Unpacks into `bytes`. Refused: a broken frame, and content that is not of `expected_bytes`;
/// never takes more memory than those.
core::Result<void> decompress(Compression compression, std::string_view packed,
                              std::size_t expected_bytes, ByteBuffer& bytes);

}  // namespace clew::bridge::mcap
