// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_order.hpp"

#include <utility>

namespace clew::bench {

std::vector<std::string> BenchOrder::words() const {
  std::vector<std::string> words = {suite};
  const std::pair<const char*, const std::vector<std::string>*> options[] = {
      {"--graph", &graphs}, {"--with", &with},      {"--set", &set},
      {"--vary", &vary},    {"--plugin", &plugins},
  };
  for (const auto& [option, values] : options) {
    for (const std::string& value : *values) {
      words.push_back(option);
      words.push_back(value);
    }
  }
  if (coverage) words.emplace_back("--coverage");
  if (!data.empty()) words.insert(words.end(), {"--data", data});
  return words;
}

}  // namespace clew::bench
