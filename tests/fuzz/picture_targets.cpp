// SPDX-License-Identifier: Apache-2.0
/// Maps and pictures: whatever the bytes, they are refused, or a picture of as many pixels as it
/// says.
#include "fuzzed_file.hpp"
#include "map/pgm.hpp"
#include "map/ros_map.hpp"
#include "target.hpp"
#include "world_import/picture_file.hpp"

namespace clew::fuzz {
namespace {

constexpr char kMapFile[] =
    "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

void read_pgm(std::string_view bytes) {
  const auto picture = map::read_pgm(bytes, "map.pgm");
  if (is_good(picture)) {
    CLEW_CHECK(picture->greys.size() == static_cast<std::size_t>(picture->columns) * picture->rows,
               "a picture of another size");
  }
  static_cast<void>(is_good(map::read_ros_map({"map.yaml", kMapFile, std::string(bytes)})));
}

void read_map_file(std::string_view text) {
  static_cast<void>(is_good(
      map::read_ros_map({"map.yaml", std::string(text), "P2 3 2 255\n0 100 205\n254 255 0\n"})));
}

void read_picture(std::string_view bytes) {
  const FuzzedFile file(bytes);
  const auto picture = world_import::read_picture(file.path());
  if (!is_good(picture)) return;
  CLEW_CHECK(picture->brightness.size() == picture->columns * picture->rows &&
                 picture->opacity.size() == picture->brightness.size(),
             "a picture of another size");
}

Seeds pgms() {
  return {"P2\n# a comment\n4 3\n255\n0 1 2 3\n100 205 254 255\n7 8 9 10\n",
          std::string("P5 4 3 255\n\x00\x01\x02\x03\x64\xcd\xfe\xff\x07\x08\x09\x0a", 23),
          std::string("P5\r\n2 2\r\n65535\r\n\x00\x01\x02\x03\x64\xcd\xfe\xff", 24)};
}

Seeds map_files() { return {kMapFile, std::string(kMapFile) + "mode: trinary\n"}; }

Seeds pictures() {
  Seeds seeds = pgms();
  for (const std::string& png : files_of("tests/fuzz/seeds", ".png", 4000)) seeds.push_back(png);
  return seeds;
}

}  // namespace

std::vector<Target> picture_targets() {
  return {{"pgm", read_pgm, pgms},
          {"map_file", read_map_file, map_files},
          {"picture", read_picture, pictures}};
}

}  // namespace clew::fuzz
