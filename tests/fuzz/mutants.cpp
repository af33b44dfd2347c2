// SPDX-License-Identifier: Apache-2.0
#include "mutants.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace clew::fuzz {
namespace {

constexpr const char* kNumbers[] = {
    "0",    "-1",         "1e308",  "-1e308", "1e-320", ".nan",  ".inf",  "nan",
    "0x10", "2147483648", "1e9999", "-0.0",   "077",    "12:30", "1_000", "18446744073709551616"};
constexpr const char* kWords[] = {
    "\n",      ": ",       "- ",       "[", "]",   "{",    "}",       "&a ",       "*a",
    "\t",      "'",        "\"",       "#", "|\n", "!!x ", "<<:",     "~",         "\r\n",
    "\x1b[2J", "\xc2\x9b", "\xff\xfe", ";", "=",   "%",    "../../x", "...\n---\n"};
constexpr unsigned char kBytes[] = {0, 1, 0x7f, 0x80, 0xff, '0', ' ', '\n'};

template <typename List>
const auto& any_of(const List& list, std::size_t number) {
  return list[number % std::size(list)];
}

}  // namespace

std::string Mutants::next() {
  std::string input = any_of(seeds_, numbers_());
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(input);
  return input;
}

void Mutants::change(std::string& input) {
  const std::size_t at = below(input.size());
  const std::size_t count = std::min(input.size() - at, 1 + below(16));
  switch (below(9)) {
    case 0:
      if (!input.empty()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
      break;
    case 1:
      if (!input.empty()) input[at] = static_cast<char>(any_of(kBytes, numbers_()));
      break;
    case 2:
      input.erase(at, count);
      break;
    case 3:
      input.insert(below(input.size()), input.substr(at, count));
      break;
    case 4:
      input.insert(at, any_of(kWords, numbers_()));
      break;
    case 5:
      std::fill_n(input.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(count, 8),
                  static_cast<char>(any_of(kBytes, numbers_())));
      break;
    case 6:
      input.resize(below(4) == 0 ? at : input.size());
      break;
    case 7:
      put_in_piece(input);
      break;
    default:
      change_number(input);
  }
}

/// Of another seed.
void Mutants::put_in_piece(std::string& input) {
  const std::string& other = any_of(seeds_, numbers_());
  const std::size_t from = below(other.size());
  input.replace(below(input.size()), below(64), other.substr(from, 1 + below(64)));
}

/// The first one behind some place, if the input has numbers that one can read.
void Mutants::change_number(std::string& input) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto start = input.begin() + static_cast<std::ptrdiff_t>(below(input.size()));
  const auto first = std::find_if(start, input.end(), is_digit);
  const auto last = std::find_if_not(first, input.end(), is_digit);
  input.replace(first, last, any_of(kNumbers, numbers_()));
}

}  // namespace clew::fuzz
