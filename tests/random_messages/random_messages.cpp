// SPDX-License-Identifier: Apache-2.0
#include "random_messages.hpp"

namespace clew::bridge {

double RandomMessages::number(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine_);
}

std::uint32_t RandomMessages::count(std::size_t last) {
  return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(last))(engine_);
}

std::string RandomMessages::text(std::size_t bound) {
  std::string text(count(bound), ' ');
  for (char& c : text) c = static_cast<char>('a' + count(25));
  return text;
}

}  // namespace clew::bridge
