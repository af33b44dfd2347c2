// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clew::core {

/// Whether the quoted text that begins at `begin` is closed again: yaml-cpp takes the end of the
/// file for a closing quote. True if none begins there.
bool has_closing_quote(std::string_view yaml, std::size_t begin);

/// A long list of a YAML file, `key: [[1, 2], [3, 4]]` with the key at the beginning of a line,
/// that holds nothing but numbers and lists of them.
struct NumberList {
  std::size_t begin = 0;  ///< of its bracket
  std::size_t end = 0;    ///< behind its bracket
  int line = 0;           ///< of its bracket, from 1
  int column = 0;
};

/// All that have this many characters or more. Finds none where line breaks or marks of an encoding
/// would count otherwise for a YAML parser, and none that holds anything to think about: a comment,
/// a quote, a word.
std::vector<NumberList> find_number_lists(std::string_view yaml, std::size_t least_length);

/// The text with these lists emptied. All that is left stands in its line and column.
std::string without_number_lists(std::string_view yaml, const std::vector<NumberList>& lists);

/// Passes through a list from its second character on: visits `open(line, column)`,
/// `number(line, column, text)` and `close()`; the last close is that of the list itself.
template <typename Visitor>
void visit_number_list(std::string_view yaml, const NumberList& list, Visitor& visitor) {
  int line = list.line;
  std::size_t line_begin = list.begin - static_cast<std::size_t>(list.column - 1);
  for (std::size_t i = list.begin + 1; i < list.end;) {
    const char c = yaml[i];
    const int column = static_cast<int>(i - line_begin) + 1;
    if (c == '\n') {
      ++line;
      line_begin = i + 1;
    } else if (c == '[') {
      visitor.open(line, column);
    } else if (c == ']') {
      visitor.close();
    } else if (c != ' ' && c != ',') {
      const std::size_t end = std::min(yaml.find_first_of(" ,]\n", i), yaml.size());
      visitor.number(line, column, yaml.substr(i, end - i));
      i = end;
      continue;
    }
    ++i;
  }
}

}  // namespace clew::core
