// SPDX-License-Identifier: Apache-2.0
#include "recording/begun_file.hpp"

#include <algorithm>

#include "recording/input_file.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/mcap_records.hpp"

namespace clew::bridge {
namespace {

/// Whether a file ends before its header does. An empty one does.
core::Result<bool> ends_in_header(const mcap::InputFile& file) {
  const std::uint64_t shortest = mcap::kMagic.size() + mcap::kRecordHeadBytes;
  const auto bytes = static_cast<std::size_t>(std::min(file.size(), shortest));
  mcap::ByteBuffer buffer;
  CLEW_RETURN_IF_ERROR(file.read(0, bytes, buffer));
  const std::string_view magic = mcap::kMagic;
  const std::string_view opening = buffer.view().substr(0, magic.size());
  if (opening != magic.substr(0, opening.size())) return false;
  if (bytes < shortest) return true;
  return mcap::announced_content_bytes(buffer.view().substr(magic.size())) > file.size() - shortest;
}

}  // namespace

core::Result<bool> is_only_begun(const std::string& file) {
  const auto bytes = mcap::InputFile::open(file);
  if (!bytes.ok()) return bytes.error();
  const auto in_header = ends_in_header(**bytes);
  if (!in_header.ok() || *in_header) return in_header;
  const auto reader = mcap::McapReader::open(file);
  if (!reader.ok()) return reader.error();
  return reader->tear() && reader->tear()->at_end && reader->channels().empty();
}

}  // namespace clew::bridge
