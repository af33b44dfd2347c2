// SPDX-License-Identifier: Apache-2.0
#include "recording/piece_files.hpp"

#include <filesystem>
#include <system_error>

#include "recording/output_file.hpp"

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

}  // namespace

std::string piece_path(const std::string& path, std::uint64_t piece) {
  const std::filesystem::path whole = without_temporary(path);
  if (piece == 0) return whole.string();
  const std::string name =
      whole.stem().string() + '_' + std::to_string(piece) + whole.extension().string();
  return (whole.parent_path() / name).string();
}

std::string existing_piece(const std::string& path, std::uint64_t piece) {
  const std::string named = piece_path(path, piece);
  if (exists(named)) return named;
  const std::string growing = mcap::OutputFile::temporary_name(named);
  return exists(growing) ? growing : std::string();
}

core::Result<void> clear_pieces(const std::string& path, bool overwrite) {
  for (std::uint64_t piece = 1; piece < kMaxPieces; ++piece) {
    const std::string found = existing_piece(path, piece);
    if (found.empty()) return {};
    if (!overwrite) return core::Error{"exists; --force overwrites it", found};
    std::error_code error;
    std::filesystem::remove(found, error);
    if (error) return core::Error{"cannot be removed: " + error.message(), found};
  }
  return {};
}

}  // namespace clew::bridge
