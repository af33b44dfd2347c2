// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace clew::bench {

/// What was asked for, in the words of the command line: enough to ask for it again.
struct BenchOrder {
  std::string suite;                ///< a name or a path
  std::vector<std::string> graphs;  ///< in place of the suite's
  std::vector<std::string> with;
  std::vector<std::string> set;
  std::vector<std::string> vary;  ///< `PATH=VALUE,VALUE,...`
  std::vector<std::string> plugins;
  bool coverage = false;  ///< count what decided
  std::string data = {};  ///< a directory of worlds that the suite needs; else empty

  /// The words after `clew bench`.
  std::vector<std::string> words() const;
};

}  // namespace clew::bench
