// SPDX-License-Identifier: Apache-2.0
/// One target under libFuzzer: the environment's CLEW_FUZZ_TARGET says which.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "target.hpp"

namespace {

const clew::fuzz::Target& chosen_target() {
  static const clew::fuzz::Target chosen = [] {
    const char* name = std::getenv("CLEW_FUZZ_TARGET");
    for (const auto& target : clew::fuzz::all_targets()) {
      if (name != nullptr && std::string(name) == target.name) return target;
    }
    std::fprintf(stderr, "CLEW_FUZZ_TARGET is '%s'; fuzz_seeds names the targets\n",
                 name == nullptr ? "" : name);
    std::exit(2);
  }();
  return chosen;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  chosen_target().read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
