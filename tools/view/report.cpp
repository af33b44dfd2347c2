// SPDX-License-Identifier: Apache-2.0
#include "view/report.hpp"

#include <zstd.h>

#include <cstdint>

namespace clew::view {
namespace {

/// Twelve packs a recording nearly as small as it gets, at some 20 MB/s.
constexpr int kLevel = 12;
constexpr std::string_view kPlace = "<!-- recordings -->";

core::Result<std::string> packed(const std::string& bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) return core::Error{ZSTD_getErrorName(size), {}, 0, 0};
  frame.resize(size);
  return frame;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t there = bytes.size() - i < 3 ? bytes.size() - i : 3;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k > there ? '=' : kLetters[(group >> (18 - 6 * k)) & 63U];
    }
  }
  return text;
}

core::Result<std::string> report(std::string_view page, const std::vector<ReportedFile>& files) {
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos)
    return core::Error{"the page has no place for recordings", {}, 0, 0};
  std::string text(page.substr(0, place));
  for (const ReportedFile& file : files) {
    const auto bytes = packed(file.bytes);
    if (!bytes.ok()) return bytes.error();
    text += "<script type=\"text/plain\" data-name=\"" + base64(file.name) + "\">";
    text += base64(*bytes) + "</script>\n";
  }
  text += page.substr(place + kPlace.size());
  return text;
}

}  // namespace clew::view
