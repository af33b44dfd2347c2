// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_text.hpp"

namespace clew::core {
namespace {

constexpr int kMostNested = 16;

bool is_digit(char c) { return '0' <= c && c <= '9'; }

/// Behind the number that begins at `i`; `i` itself if none does.
std::size_t end_of_number(std::string_view yaml, std::size_t i) {
  const auto at = [&](std::size_t place) { return place < yaml.size() ? yaml[place] : '\0'; };
  std::size_t next = i;
  if (at(next) == '+' || at(next) == '-') ++next;
  if (!is_digit(at(next)) && !(at(next) == '.' && is_digit(at(next + 1)))) return i;
  while (is_digit(at(next)) || std::string_view("+-.eE").find(at(next)) != std::string_view::npos) {
    ++next;
  }
  const bool ends = std::string_view(" ,]\n").find(at(next)) != std::string_view::npos;
  return ends ? next : i;
}

/// Behind the list that begins at `begin`; 0 if it holds anything but numbers.
std::size_t end_of_list(std::string_view yaml, std::size_t begin) {
  enum class Before { kOpened, kComma, kValue } before = Before::kOpened;
  int nested = 1;
  for (std::size_t i = begin + 1; i < yaml.size();) {
    const char c = yaml[i];
    if (c == ' ' || c == '\n') {
      ++i;
    } else if (c == ']') {
      if (before == Before::kOpened) return 0;
      ++i;
      before = Before::kValue;
      if (--nested == 0) return i;
    } else if (before == Before::kValue) {
      if (c != ',') return 0;
      ++i;
      before = Before::kComma;
    } else if (c == '[') {
      if (++nested > kMostNested) return 0;
      ++i;
      before = Before::kOpened;
    } else {
      const std::size_t end = end_of_number(yaml, i);
      if (end == i) return 0;
      i = end;
      before = Before::kValue;
    }
  }
  return 0;
}

/// Where the list of a line `key: [` begins, from its first character on; npos if it is another.
std::size_t begin_of_list(std::string_view line) {
  std::size_t i = 0;
  while (i < line.size() && (('a' <= line[i] && line[i] <= 'z') || line[i] == '_')) ++i;
  if (i == 0 || i >= line.size() || line[i] != ':') return std::string_view::npos;
  const std::size_t begin = line.find_first_not_of(' ', i + 1);
  const bool is_list = begin != std::string_view::npos && begin > i + 1 && line[begin] == '[';
  return is_list ? begin : std::string_view::npos;
}

}  // namespace

bool has_closing_quote(std::string_view yaml, std::size_t begin) {
  if (begin >= yaml.size() || (yaml[begin] != '"' && yaml[begin] != '\'')) return true;
  const char quote = yaml[begin];
  for (std::size_t i = begin + 1; i < yaml.size(); ++i) {
    if (quote == '"' && yaml[i] == '\\') {
      ++i;
    } else if (yaml[i] == quote) {
      const bool doubled = quote == '\'' && i + 1 < yaml.size() && yaml[i + 1] == quote;
      if (!doubled) return true;
      ++i;
    }
  }
  return false;
}

std::vector<NumberList> find_number_lists(std::string_view yaml, std::size_t least_length) {
  std::vector<NumberList> lists;
  if (yaml.size() < least_length) return lists;
  // Other line breaks than '\n', zeros, and the mark at the beginning of an encoded file.
  if (yaml.find('\r') != std::string_view::npos || yaml.find('\0') != std::string_view::npos ||
      static_cast<unsigned char>(yaml[0]) >= 0x80U) {
    return lists;
  }
  int line = 1;
  for (std::size_t at = 0; at < yaml.size();) {
    const std::size_t line_end = std::min(yaml.find('\n', at), yaml.size());
    const std::size_t begin = begin_of_list(yaml.substr(at, line_end - at));
    const std::size_t end = begin == std::string_view::npos ? 0 : end_of_list(yaml, at + begin);
    if (end < at + begin + least_length || end == 0) {
      at = line_end + 1;
      ++line;
      continue;
    }
    lists.push_back({at + begin, end, line, static_cast<int>(begin) + 1});
    line += static_cast<int>(std::count(yaml.begin() + static_cast<std::ptrdiff_t>(at),
                                        yaml.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = std::min(yaml.find('\n', end), yaml.size()) + 1;
    ++line;
  }
  return lists;
}

std::string without_number_lists(std::string_view yaml, const std::vector<NumberList>& lists) {
  std::string text;
  std::size_t copied = 0;
  for (const NumberList& list : lists) {
    text += yaml.substr(copied, list.begin + 1 - copied);
    const std::string_view inside = yaml.substr(list.begin + 1, list.end - list.begin - 2);
    text.append(static_cast<std::size_t>(std::count(inside.begin(), inside.end(), '\n')), '\n');
    const std::size_t line_end = std::min(yaml.find('\n', list.end), yaml.size());
    const std::string_view behind = yaml.substr(list.end, line_end - list.end);
    // What stands behind it in its last line keeps its column.
    if (behind.find_first_not_of(' ') != std::string_view::npos) {
      const std::size_t last_line = inside.rfind('\n');
      text.append(
          last_line == std::string_view::npos ? inside.size() : inside.size() - last_line - 1, ' ');
    }
    copied = list.end - 1;
  }
  text += yaml.substr(copied);
  return text;
}

}  // namespace clew::core
