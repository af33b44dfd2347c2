// SPDX-License-Identifier: Apache-2.0
#include "convert/cdr_reader.hpp"

#include <fmt/format.h>

namespace clew::bridge {

void CdrReader::read_text(std::string& text, std::size_t bound, const domain::FieldPath& path) {
  std::uint32_t length = 0;
  read_bytes(&length, sizeof length, sizeof length, path);
  if (!ok()) return;
  if (length > bound + 1) return fail_long(path, length - 1, "bytes", bound);
  if (length > bytes_.size() - position_) return fail_short(path);
  const std::string_view content = bytes_.substr(position_, length);
  if (content.find('\0') != length - 1) {
    fault_ = fmt::format("{} has no zero byte at its end, or one before it", path.text());
    return;
  }
  text.assign(content.data(), length - 1);
  position_ += length;
}

void CdrReader::fail_short(const domain::FieldPath& path) {
  if (ok()) fault_ = fmt::format("too short for its content; it ends in {}", path.text());
}

void CdrReader::fail_long(const domain::FieldPath& path, std::uint32_t found, const char* unit,
                          std::size_t bound) {
  if (!ok()) return;
  fault_ = fmt::format("{} is {} {} long; allowed: at most {}", path.text(), found, unit, bound);
}

void CdrReader::refuse(const domain::FieldPath& path, std::uint32_t found,
                       const std::string& allowed) {
  if (!value_fault_.empty()) return;
  value_fault_ = fmt::format("{} is {}; allowed: {}", path.text(), found, allowed);
}

}  // namespace clew::bridge
