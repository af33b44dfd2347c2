// SPDX-License-Identifier: Apache-2.0
/// Writes what fuzzing begins with, a folder for each target, and prints the targets' names:
/// `fuzz_seeds DIRECTORY`.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "target.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds DIRECTORY\n", stderr);
    return 2;
  }
  for (const auto& target : clew::fuzz::all_targets()) {
    const auto folder = std::filesystem::path(argv[1]) / target.name;
    std::filesystem::create_directories(folder);
    std::size_t number = 0;
    for (const std::string& seed : target.seeds()) {
      std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
    }
    std::puts(target.name);
  }
  return 0;
}
