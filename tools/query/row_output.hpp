// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "query/database.hpp"

namespace clew::query {

/// Takes a piece of text for standard output.
using Print = std::function<void(const std::string& text)>;

/// A table for people, numbers to the right; all rows are held until the end.
class TableOutput : public RowSink {
 public:
  explicit TableOutput(Print print) : print_(std::move(print)) {}

  core::Result<void> begin(const std::vector<std::string>& columns) override;
  core::Result<void> row(const std::vector<Cell>& cells) override;
  void end() const;

 private:
  Print print_;
  std::vector<std::vector<std::string>> rows_;  ///< the columns' names first
  std::vector<bool> is_number_;                 ///< of each column, so far
};

/// A line of JSON a row. Refused: two columns of one name.
class JsonOutput : public RowSink {
 public:
  explicit JsonOutput(Print print) : print_(std::move(print)) {}

  core::Result<void> begin(const std::vector<std::string>& columns) override;
  core::Result<void> row(const std::vector<Cell>& cells) override;

 private:
  Print print_;
  std::vector<std::string> columns_;
};

/// RFC 4180, with a header; null is an empty field.
class CsvOutput : public RowSink {
 public:
  explicit CsvOutput(Print print) : print_(std::move(print)) {}

  core::Result<void> begin(const std::vector<std::string>& columns) override;
  core::Result<void> row(const std::vector<Cell>& cells) override;

 private:
  Print print_;
};

}  // namespace clew::query
