// SPDX-License-Identifier: Apache-2.0
#include "recording/piece_files.hpp"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace clew::bridge {
namespace {

constexpr std::string_view kTemporary = ".tmp~";

std::string without_temporary(const std::string& path) {
  const std::size_t end = kTemporary.size();
  const bool temporary = path.size() > end && path.compare(path.size() - end, end, kTemporary) == 0;
  return temporary ? path.substr(0, path.size() - end) : path;
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::string named_piece(const std::filesystem::path& first, std::uint64_t piece) {
  if (piece == 0) return first.string();
  const std::string name =
      first.stem().string() + '_' + std::to_string(piece) + first.extension().string();
  return (first.parent_path() / name).string();
}

/// A file under its own name, or that under which it grows. Empty: neither.
std::string standing(const std::string& named) {
  if (exists(named)) return named;
  const std::string growing = mcap::OutputFile::temporary_name(named);
  return exists(growing) ? growing : std::string();
}

}  // namespace

std::string piece_path(const std::string& path, std::uint64_t piece) {
  const std::string whole = without_temporary(path);
  return piece == 0 ? whole : named_piece(mcap::OutputFile::file_of(whole), piece);
}

std::string existing_piece(const std::string& path, std::uint64_t piece) {
  const std::string there = standing(piece_path(path, piece));
  if (!there.empty()) return there;
  const std::string beside_link = named_piece(without_temporary(path), piece);
  return exists(beside_link) ? beside_link : std::string();
}

std::string next_existing_piece(const std::string& path, std::uint64_t piece) {
  for (; piece < kMaxPieces; ++piece) {
    if (std::string found = standing(piece_path(path, piece)); !found.empty()) return found;
  }
  return {};
}

core::Result<mcap::OutputFile> kept_piece(const std::string& path) {
  const std::string growing = mcap::OutputFile::temporary_name(path);
  if (exists(path) && std::rename(path.c_str(), growing.c_str()) != 0) {
    return core::Error{"cannot be renamed to " + growing, path};
  }
  auto file = mcap::OutputFile::go_on(path);
  if (file.ok()) file->keep(true);
  return file;
}

core::Result<mcap::OutputFile> new_piece(const std::string& path, bool overwrite,
                                         bool over_growing) {
  if (exists(path)) {
    if (!overwrite) return core::Error{"exists; it is overwritten only with --force", path};
    // Who reads what there is so far takes a file of that name for the new one.
    CLEW_RETURN_IF_ERROR(mcap::OutputFile::remove(path));
  }
  return mcap::OutputFile::create(path, over_growing);
}

core::Result<void> check_no_pieces(const std::string& path) {
  const std::string found = next_existing_piece(path, 1);
  if (found.empty()) return {};
  return core::Error{"exists; --force overwrites it", found};
}

core::Result<void> remove_pieces(const std::string& path) {
  for (std::uint64_t piece = 1; piece < kMaxPieces; ++piece) {
    const std::string found = standing(piece_path(path, piece));
    if (found.empty()) return {};
    CLEW_RETURN_IF_ERROR(mcap::OutputFile::remove(found));
  }
  return {};
}

}  // namespace clew::bridge
