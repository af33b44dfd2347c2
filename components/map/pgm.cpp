// SPDX-License-Identifier: Apache-2.0
#include "map/pgm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace clew::map {
namespace {

using core::Error;
using core::Result;

/// Reads a PGM file (netpbm.sourceforge.net/doc/pgm.html).
class PgmReader {
 public:
  PgmReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  Result<Picture> read() {
    const std::string_view kind = bytes_.substr(0, 2);
    if (kind != "P2" && kind != "P5") {
      return refuse("is no PGM picture: it does not begin with P2 or P5");
    }
    at_ = 2;
    const auto columns = header("width", 1, 65536);
    if (!columns.ok()) return columns.error();
    const auto rows = header("height", 1, 65536);
    if (!rows.ok()) return rows.error();
    const auto white = header("greatest grey", 1, 65535);
    if (!white.ok()) return white.error();
    Picture picture{*columns, *rows, static_cast<double>(*white), {}};
    const std::size_t size = static_cast<std::size_t>(*columns) * static_cast<std::size_t>(*rows);
    if (size > kMaxMapCells) {
      return refuse(fmt::format("has {} pixels; allowed: at most {}", size, kMaxMapCells));
    }
    const auto read =
        kind == "P2" ? read_text(size, *white, picture) : read_binary(size, *white, picture);
    if (!read.ok()) return read.error();
    return picture;
  }

 private:
  Error refuse(const std::string& what) const { return {what, file_, line_, 0}; }

  // To the last byte before the end of the line.
  void skip_comment() {
    while (at_ + 1 < bytes_.size() && bytes_[at_ + 1] != '\n' && bytes_[at_ + 1] != '\r') ++at_;
  }
  // The next whole number, past white space and comments; none at the end or at anything else.
  std::optional<std::int32_t> number() {
    for (; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') {
        skip_comment();
      } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
        break;
      }
      if (c == '\n') ++line_;
    }
    std::optional<std::int32_t> value;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = std::min(value.value_or(0) * 10 + (bytes_[at_] - '0'), 1'000'000);
    }
    return value;
  }
  Result<std::int32_t> header(const char* what, std::int32_t least, std::int32_t greatest) {
    const auto value = number();
    if (value.has_value() && *value >= least && *value <= greatest) return *value;
    return refuse(fmt::format("{} is {}; allowed: {} to {}", what,
                              value.has_value() ? std::to_string(*value) : "missing", least,
                              greatest));
  }
  Result<void> check_grey(std::int32_t grey, std::int32_t white, std::size_t pixel) const {
    if (grey <= white) return {};
    return refuse(fmt::format("pixel {} is {}; allowed: 0 to {}", pixel, grey, white));
  }
  Error cut_short(std::size_t pixel, std::size_t size) const {
    return refuse(fmt::format("ends at pixel {} of {}", pixel, size));
  }
  Result<void> read_text(std::size_t size, std::int32_t white, Picture& picture) {
    picture.greys.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      const auto grey = number();
      if (!grey.has_value()) return cut_short(i, size);
      CLEW_RETURN_IF_ERROR(check_grey(*grey, white, i));
      picture.greys.push_back(static_cast<std::uint16_t>(*grey));
    }
    if (number().has_value() || at_ < bytes_.size()) {
      return refuse(fmt::format("goes on behind its last pixel, the {}th", size));
    }
    return {};
  }
  // After one byte of white space, one byte a pixel, or two if one does not do, the high one first.
  Result<void> read_binary(std::size_t size, std::int32_t white, Picture& picture) {
    const std::size_t width = white < 256 ? 1 : 2;
    skip_end_of_head(size * width);
    const std::size_t there = at_ < bytes_.size() ? (bytes_.size() - at_) / width : 0;
    if (there < size) return cut_short(there, size);
    if (const std::size_t more = bytes_.size() - at_ - size * width; more > 0) {
      return refuse(fmt::format("has {} bytes behind its last pixel, the {}th", more, size));
    }
    picture.greys.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      std::int32_t grey = 0;
      for (std::size_t k = 0; k < width; ++k) {
        grey = grey * 256 + static_cast<unsigned char>(bytes_[at_++]);
      }
      CLEW_RETURN_IF_ERROR(check_grey(grey, white, i));
      picture.greys.push_back(static_cast<std::uint16_t>(grey));
    }
    return {};
  }

  // One byte of white space, or a comment and the end of its line. Where lines end in CR and LF,
  // which the format does not know, the LF is no pixel: there would be one byte too many.
  void skip_end_of_head(std::size_t data_bytes) {
    if (at_ < bytes_.size() && bytes_[at_] == '#') {
      skip_comment();
      ++at_;
    }
    const bool is_crlf = bytes_.substr(std::min(at_, bytes_.size()), 2) == "\r\n";
    at_ += is_crlf && bytes_.size() - at_ - 2 == data_bytes ? 2 : 1;
  }

  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

Result<Picture> read_pgm(std::string_view bytes, const std::string& file) {
  return PgmReader(bytes, file).read();
}

}  // namespace clew::map
