// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"

namespace clew::bridge {

/// More files than this a recording is not cut into: the last one takes the rest.
inline constexpr std::uint64_t kMaxPieces = 500;

/// The file of a recording that is split: `a.mcap`, `a_1.mcap`, `a_2.mcap`, ... Its first file is
/// named by `path`, under its own name or the one that it grows under; so are the others, but
/// without the latter's ending.
std::string piece_path(const std::string& path, std::uint64_t piece);

/// Piece `piece` as it is there: under its own name, or that under which it grows. Empty: neither.
std::string existing_piece(const std::string& path, std::uint64_t piece);

/// Makes room for the pieces behind the first one. Refused if one is there, unless `overwrite`.
core::Result<void> clear_pieces(const std::string& path, bool overwrite);

}  // namespace clew::bridge
