// SPDX-License-Identifier: Apache-2.0
#include "world_import/picture_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "map/pgm.hpp"

namespace clew::world_import {
namespace {

using core::Error;
using core::Result;

constexpr std::string_view kPngMagic{"\x89PNG\r\n\x1a\n", 8};

Result<GreyPicture> read_png(const std::string& bytes, const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    return Error{image.message, path};
  }
  GreyPicture picture{image.width, image.height, {}, {}};
  const std::size_t size = picture.columns * picture.rows;
  if (size > map::kMaxMapCells) {
    png_image_free(&image);
    return Error{fmt::format("has {} pixels; allowed: at most {}", size, map::kMaxMapCells), path};
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) {
    return Error{image.message, path};
  }
  picture.brightness.reserve(size);
  picture.opacity.reserve(size);
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const int sum = pixels[i] + pixels[i + 1] + pixels[i + 2];
    picture.brightness.push_back(static_cast<float>(sum) / (3.0F * 255.0F));
    picture.opacity.push_back(static_cast<float>(pixels[i + 3]) / 255.0F);
  }
  return picture;
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return Error{"is a directory", path};
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (!file || !(bytes << file.rdbuf())) {
    const int number = errno;
    return Error{number == 0 ? "is empty" : std::generic_category().message(number), path};
  }
  return bytes.str();
}

Result<GreyPicture> read_picture(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  if (bytes->compare(0, kPngMagic.size(), kPngMagic) == 0) return read_png(*bytes, path);
  if (bytes->compare(0, 1, "P") != 0) {
    return Error{"is no picture that is read here: allowed are PGM (P2, P5) and PNG", path};
  }
  const auto pgm = map::read_pgm(*bytes, path);
  if (!pgm.ok()) return pgm.error();
  GreyPicture picture{static_cast<std::size_t>(pgm->columns),
                      static_cast<std::size_t>(pgm->rows),
                      {},
                      std::vector<float>(pgm->greys.size(), 1.0F)};
  picture.brightness.reserve(pgm->greys.size());
  for (const std::uint16_t grey : pgm->greys) {
    picture.brightness.push_back(static_cast<float>(grey / pgm->white));
  }
  return picture;
}

}  // namespace clew::world_import
