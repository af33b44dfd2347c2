// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>

#include "target.hpp"

namespace clew::fuzz {

/// Makes bad inputs of good ones: bits, bytes, numbers and pieces changed, doubled, moved, left out
/// or put in, and other inputs' pieces. The same seed gives the same inputs on every machine.
class Mutants {
 public:
  Mutants(Seeds seeds, std::uint32_t seed) : seeds_(std::move(seeds)), numbers_(seed) {}

  std::string next();

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : numbers_() % end; }
  void change(std::string& input);
  void change_number(std::string& input);
  void put_in_piece(std::string& input);

  const Seeds seeds_;
  std::mt19937 numbers_;
};

}  // namespace clew::fuzz
