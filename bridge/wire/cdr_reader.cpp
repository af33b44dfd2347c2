// SPDX-License-Identifier: Apache-2.0
#include "wire/cdr_reader.hpp"

#include <fmt/format.h>

namespace clew::bridge {

namespace {

/// A fault in words, if it has a path.
template <typename... Parts>
std::string in_words(const domain::FieldPath& path, const char* format, const Parts&... parts) {
  return path.text() + fmt::format(fmt::runtime(format), parts...);
}
template <typename... Parts>
std::string in_words(const domain::NoPath&, const Parts&...) {
  return {};
}

}  // namespace

template <typename Path>
void BasicCdrReader<Path>::read_text(std::string& text, std::size_t bound, const Path& path) {
  std::uint32_t length = 0;
  read_bytes<sizeof length>(&length, sizeof length, path);
  if (!ok()) return;
  if (length > bound + 1) return fail_long(path, length - 1, "bytes", bound);
  if (length > bytes_.size() - position_) return fail_short(path);
  const std::string_view content = bytes_.substr(position_, length);
  if (content.find('\0') != length - 1) {
    fault_ = in_words(path, " has no zero byte at its end, or one before it");
    return;
  }
  text.assign(content.data(), length - 1);
  position_ += length;
}

template <typename Path>
void BasicCdrReader<Path>::fail_short(const Path& path) {
  if (ok()) fault_ = "too short for its content; it ends in " + in_words(path, "");
}

template <typename Path>
void BasicCdrReader<Path>::fail_long(const Path& path, std::uint32_t found, const char* unit,
                                     std::size_t bound) {
  if (ok()) fault_ = in_words(path, " is {} {} long; allowed: at most {}", found, unit, bound);
}

template <typename Path>
void BasicCdrReader<Path>::refuse(const Path& path, std::uint32_t found,
                                  const std::string& allowed) {
  if (!value_fault_) value_fault_ = in_words(path, " is {}; allowed: {}", found, allowed);
}

template class BasicCdrReader<domain::FieldPath>;
template class BasicCdrReader<domain::NoPath>;

}  // namespace clew::bridge
