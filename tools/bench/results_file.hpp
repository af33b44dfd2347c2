// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::bench {

/// The results of a bench, JSON lines: what they depend on in the first line, then one run a line,
/// in the order in which they ended. A line is appended with one write, so a process that is killed
/// leaves at most one torn line, the last, which is dropped when the file is opened again.
class ResultsFile {
 public:
  /// Opens or makes a file, and holds it against other processes. Refused: a file that another
  /// bench has open, one made with another configuration (which is named), one that is no results
  /// file, and one that cannot be written. `restart` drops what is there.
  static core::Result<ResultsFile> open(const std::string& path,
                                        const std::map<std::string, std::string>& configuration,
                                        bool restart);

  ResultsFile(ResultsFile&& other) noexcept;
  ResultsFile& operator=(ResultsFile&&) = delete;
  ~ResultsFile();

  /// The lines of runs, those that were found first.
  const std::vector<std::string>& lines() const { return lines_; }

  core::Result<void> append(const std::string& line);

 private:
  ResultsFile(std::string path, int file) : path_(std::move(path)), file_(file) {}
  core::Result<void> take_in(const std::string& text,
                             const std::map<std::string, std::string>& configuration);
  core::Result<void> write_line(const std::string& line);
  core::Error failed(const std::string& what) const;

  std::string path_;
  int file_;
  std::vector<std::string> lines_;
};

}  // namespace clew::bench
