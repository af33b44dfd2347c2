// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "recording/output_file.hpp"

namespace clew::bridge {

/// More files than this a recording is not cut into: the last one takes the rest.
inline constexpr std::uint64_t kMaxPieces = 10000;

/// The file of a recording that is split: `a.mcap`, `a_1.mcap`, `a_2.mcap`, ... Its first file is
/// named by `path`, under its own name or the one that it grows under; so are the others, but
/// without the latter's ending. The others lie beside the file that a symbolic link leads to.
std::string piece_path(const std::string& path, std::uint64_t piece);

/// Piece `piece` as it is there: under its own name, or that under which it grows; or, where `path`
/// is a symbolic link, under its own name beside the link. Empty: none of them.
std::string existing_piece(const std::string& path, std::uint64_t piece);

/// The first piece from `piece` on that is there, whatever lacks before it. Empty: none.
std::string next_existing_piece(const std::string& path, std::uint64_t piece);

/// Opens a piece as one that its recorder was cut off in, which keeps what it has: under the name
/// that it grows under, which it gets back if it had its own.
core::Result<mcap::OutputFile> kept_piece(const std::string& path);

/// Makes a piece. Refused: a file of its name that is there, unless `overwrite`, and one of the
/// name that it grows under, unless `over_growing`.
core::Result<mcap::OutputFile> new_piece(const std::string& path, bool overwrite,
                                         bool over_growing);

/// Refused if any piece behind the first one is there.
core::Result<void> check_no_pieces(const std::string& path);

/// Removes the pieces behind the first one, up to a number that is not there. Refused: one that
/// another process is writing.
core::Result<void> remove_pieces(const std::string& path);

}  // namespace clew::bridge
