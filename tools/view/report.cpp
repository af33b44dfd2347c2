// SPDX-License-Identifier: Apache-2.0
#include "view/report.hpp"

#include <zstd.h>

#include "core/base64.hpp"

namespace clew::view {
namespace {

/// Twelve packs a recording nearly as small as it gets, at some 20 MB/s.
constexpr int kLevel = 12;
constexpr std::string_view kPlace = "<!-- recordings -->";

core::Result<std::string> packed(const std::string& bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) return core::Error{ZSTD_getErrorName(size)};
  frame.resize(size);
  return frame;
}

}  // namespace

core::Result<std::string> report(std::string_view page,
                                 const std::vector<ReportedRecording>& recordings) {
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) return core::Error{"the page has no place for recordings"};
  std::string text(page.substr(0, place));
  for (const ReportedRecording& recording : recordings) {
    std::string attribute = "data-name=\"" + core::base64(recording.name) + '"';
    for (const std::string& bytes : recording.bytes) {
      const auto frame = packed(bytes);
      if (!frame.ok()) return frame.error();
      text +=
          "<script type=\"text/plain\" " + attribute + '>' + core::base64(*frame) + "</script>\n";
      attribute = "data-further";
    }
  }
  text += page.substr(place + kPlace.size());
  return text;
}

}  // namespace clew::view
