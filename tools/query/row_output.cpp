// SPDX-License-Identifier: Apache-2.0
#include "query/row_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/quoted.hpp"

namespace clew::query {
namespace {

using core::Result;

std::string text_of(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "";
}

nlohmann::ordered_json json_of(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

/// How wide a text of UTF-8 is on a terminal, as far as one character takes one place.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// What would break a line of the table becomes a space.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

}  // namespace

Result<void> TableOutput::begin(const std::vector<std::string>& columns) {
  rows_.push_back(columns);
  is_number_.assign(columns.size(), true);
  return {};
}

Result<void> TableOutput::row(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (std::holds_alternative<std::string>(cells[i])) is_number_[i] = false;
    texts.push_back(on_one_line(text_of(cells[i])));
  }
  rows_.push_back(std::move(texts));
  return {};
}

void TableOutput::end() const {
  std::vector<std::size_t> widths(is_number_.size());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (is_number_[i] ? padding + row[i] : row[i] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    print_(line + '\n');
  }
}

Result<void> JsonOutput::begin(const std::vector<std::string>& columns) {
  columns_ = columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) ==
        columns.begin() + static_cast<std::ptrdiff_t>(i)) {
      continue;
    }
    return core::Error{"two columns are called '" + columns[i] + "'; name one otherwise, with AS",
                       "--json"};
  }
  return {};
}

Result<void> JsonOutput::row(const std::vector<Cell>& cells) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < cells.size(); ++i) object[columns_[i]] = json_of(cells[i]);
  print_(object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
  return {};
}

Result<void> CsvOutput::begin(const std::vector<std::string>& columns) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i)
    line += (i == 0 ? "" : ",") + core::csv_field(columns[i]);
  print_(line + '\n');
  return {};
}

Result<void> CsvOutput::row(const std::vector<Cell>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += (i == 0 ? "" : ",") + core::csv_field(text_of(cells[i]));
  }
  print_(line + '\n');
  return {};
}

}  // namespace clew::query
