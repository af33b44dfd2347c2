// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "bench/bench_order.hpp"
#include "bench/line_file.hpp"

namespace clew::bench {

constexpr char kResultsFile[] = "results.jsonl";
constexpr char kTimingFile[] = "timing.jsonl";
/// Of a configuration: which shard the results are.
constexpr char kShardKey[] = "shard";

/// What results depend on, named.
using Configuration = std::map<std::string, std::string>;

/// The first line of a file of results.
struct ResultsHeader {
  BenchOrder order;
  Configuration configuration;

  std::string text() const;
};

/// Reads the first line of a file of results; `path` and line 1 are named in a refusal.
core::Result<ResultsHeader> read_header(const std::string& line, const std::string& path);

/// What one configuration has and the other has not, in words; empty if they are the same.
std::string difference(const Configuration& made_with, const Configuration& now);

/// The results of a bench, JSON lines: what they depend on in the first line, then one run a line,
/// in the order in which they ended.
class ResultsFile {
 public:
  /// Called with each line of a run that is there already, and its number in the file.
  using Take = std::function<core::Result<void>(const std::string& line, int number)>;

  /// Opens or makes a file, and holds it against other processes. Refused: a file that another
  /// bench has open, one made with another configuration (which is named), one that is no results
  /// file, and one that cannot be written. `restart` drops what is there. Waits so many seconds for
  /// a bench that has the file.
  static core::Result<ResultsFile> open(const std::string& path, const ResultsHeader& header,
                                        bool restart, const Take& take, double patience_s = 0.0);

  core::Result<void> append(const std::string& line) { return file_.append(line); }

 private:
  explicit ResultsFile(LineFile file) : file_(std::move(file)) {}
  core::Result<void> take_in(const ResultsHeader& header, const Take& take);

  LineFile file_;
};

}  // namespace clew::bench
