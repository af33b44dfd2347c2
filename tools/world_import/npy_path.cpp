// SPDX-License-Identifier: Apache-2.0
#include "world_import/npy_path.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <regex>

#include "world_import/picture_file.hpp"

namespace clew::world_import {
namespace {

using core::Error;
using core::Result;
using core::Vec2;

constexpr std::string_view kMagic{"\x93NUMPY", 6};
constexpr std::size_t kMostPoints = 1'000'000;

struct Header {
  std::string type;  ///< `i8`
  std::size_t rows = 0;
  std::size_t data_offset = 0;
};

Result<Header> read_header(const std::string& bytes, const std::string& path) {
  if (bytes.compare(0, kMagic.size(), kMagic) != 0 || bytes.size() < 12) {
    return Error{"is no array of NumPy", path};
  }
  const bool is_first_version = bytes[6] == 1;
  std::size_t length = 0;
  std::memcpy(&length, bytes.data() + 8, is_first_version ? 2 : 4);
  const std::size_t begin = is_first_version ? 10 : 12;
  if (length > bytes.size() - begin) return Error{"ends in its header", path};
  const std::string text = bytes.substr(begin, length);
  static const std::regex kType(R"('descr':\s*'<([if][48])')");
  static const std::regex kOrder(R"('fortran_order':\s*False)");
  static const std::regex kShape(R"('shape':\s*\(\s*(\d{1,7}),\s*2\s*,?\s*\))");
  std::smatch type;
  std::smatch shape;
  if (!std::regex_search(text, type, kType) || !std::regex_search(text, kOrder) ||
      !std::regex_search(text, shape, kShape)) {
    return Error{"found " + text.substr(0, 80) +
                     "; expected N x 2 numbers, int or float of 4 or 8 bytes, in C order",
                 path};
  }
  return Header{type[1], std::stoul(shape[1]), begin + length};
}

template <typename Number>
double number_at(const char* from) {
  Number number{};
  std::memcpy(&number, from, sizeof number);
  return static_cast<double>(number);
}

double value_at(const std::string& type, const char* from) {
  if (type == "i8") return number_at<std::int64_t>(from);
  if (type == "i4") return number_at<std::int32_t>(from);
  if (type == "f8") return number_at<double>(from);
  return static_cast<double>(number_at<float>(from));
}

}  // namespace

Result<std::vector<Vec2>> read_npy_points(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  const auto header = read_header(*bytes, path);
  if (!header.ok()) return header.error();
  const std::size_t width = header->type[1] == '8' ? 8 : 4;
  if (header->rows > kMostPoints ||
      bytes->size() - header->data_offset != header->rows * 2 * width) {
    return Error{fmt::format("has {} bytes for {} points", bytes->size() - header->data_offset,
                             header->rows),
                 path};
  }
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < header->rows; ++i) {
    const char* from = bytes->data() + header->data_offset + 2 * i * width;
    points.emplace_back(value_at(header->type, from), value_at(header->type, from + width));
  }
  return points;
}

std::vector<Vec2> barn_path_places(const std::vector<Vec2>& cells) {
  constexpr double kCell_m = 0.15;
  const Vec2 origin(-4.575, 5.075);
  std::vector<Vec2> places;
  for (const Vec2& cell : cells) places.push_back(origin + kCell_m * cell);
  return places;
}

double length_m(const std::vector<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace clew::world_import
