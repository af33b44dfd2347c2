// SPDX-License-Identifier: Apache-2.0
#include "text_rules.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <string>

namespace clew::structure {
namespace {

constexpr std::size_t kMostLines = 400;
constexpr std::size_t kMostGraphLines = 60;
constexpr std::size_t kMostBodyLines = 50;
constexpr std::size_t kMostClassLines = 250;
constexpr std::size_t kLicenceWithin = 3;  // after the line that names an interpreter

/// A call of a function whose last bits differ between processors.
const std::string kTranscendental =
    R"((a?(sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt|erfc?|)"
    R"([lt]gamma)[fl]?\s*\()";

struct Rule {
  std::regex pattern;
  std::string what;
};

const std::vector<Rule>& rules_of_components() {
  static const std::vector<Rule> rules = {
      {std::regex(R"(<(chrono|ctime|time\.h|sys/time\.h)>|\bstd::chrono\b|\bstd::(time|clock)\b|)"
                  R"(\b(clock_gettime|gettimeofday)\b)"),
       "a clock; time comes with the tick"},
      {std::regex(R"(<(thread|mutex|condition_variable|future|atomic)>|)"
                  R"(\b(sleep_for|sleep_until|usleep|nanosleep)\b)"),
       "a thread, a lock or a sleep; a step runs where it is called"},
      {std::regex(R"(<random>|\bstd::(s?rand|mt19937\w*|random_device)\b)"),
       "randomness without a key; use core/random.hpp"},
      {std::regex(R"(<(fstream|iostream|filesystem|unistd\.h)>|\b(fopen|getenv)\b)"),
       "a file, a stream or the environment; texts are arguments"},
      {std::regex(R"(<unordered_(map|set)>|\bstd::unordered_)"),
       "a container whose order differs between libraries"},
  };
  return rules;
}

/// The line without comments, texts and single characters.
std::string code_of(const std::string& line) {
  static const std::regex kCharacter(R"('(\\.|[^'\\])')");
  static const std::regex kText(R"("(\\.|[^"\\])*")");
  static const std::regex kComment(R"(//.*)");
  std::string code = std::regex_replace(line, kCharacter, "''");
  code = std::regex_replace(code, kText, "\"\"");
  return std::regex_replace(code, kComment, "");
}

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

bool is_code(const SourceFile& file) {
  static const std::set<std::string> kExtensions = {".cpp", ".hpp", ".c", ".h",
                                                    ".py",  ".mjs", ".ts"};
  return kExtensions.count(file.extension()) > 0;
}

bool is_c_or_cpp(const SourceFile& file) {
  static const std::set<std::string> kExtensions = {".cpp", ".hpp", ".c", ".h"};
  return kExtensions.count(file.extension()) > 0;
}

/// Whether the line ends with the brace that opens the body of a function, or a block within one.
bool opens_body(const std::string& line) {
  static const std::regex kBody(
      R"((\)|\}|\b(const|noexcept|override)|->\s*[\w:<>&*, ]+)\s*\{\s*$)");
  static const std::regex kNoFunction(R"(^\s*(namespace|class|struct|union|enum|extern)\b)");
  if (line.find('{') == std::string::npos) return false;
  const std::string code = code_of(line);
  return std::regex_search(code, kBody) && !std::regex_search(code, kNoFunction);
}

/// The line that closes the body opened in line `open`. clang-format indents a body by two from the
/// brace that closes it, whatever its head looks like.
std::size_t closing_line(const SourceFile& file, std::size_t open) {
  if (open + 1 == file.lines.size()) return open;
  const std::size_t indent = file.lines[open + 1].find_first_not_of(' ');
  if (indent == std::string::npos || indent < 2) return open;
  for (std::size_t i = open + 1; i < file.lines.size(); ++i) {
    const std::string& line = file.lines[i];
    if (line.find_first_not_of(' ') == indent - 2 && line[indent - 2] == '}') return i;
  }
  return open;
}

bool needs_licence(const SourceFile& file) {
  static const std::set<std::string> kOthers = {".cmake", ".idl", ".sh"};
  return is_code(file) || kOthers.count(file.extension()) > 0 || file.stem() == "CMakeLists";
}

std::vector<std::string> check_transcendentals(const SourceFile& file) {
  static const std::regex kOfTheLibrary(R"((\bstd|(^|[^\w])):{2})" + kTranscendental);
  // Outside core an unqualified name is the C library's.
  static const std::regex kUnqualified(R"((^|[^\w:.>]))" + kTranscendental);
  const bool in_core = begins_with(file.path, "components/core/");
  std::vector<std::string> found;
  if (file.path == "components/core/math.cpp") return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string code = code_of(file.lines[i]);
    if (std::regex_search(code, kOfTheLibrary) ||
        (!in_core && std::regex_search(code, kUnqualified))) {
      found.push_back(
          violation(file, i + 1, "a transcendental of the C library; use core/math.hpp"));
    }
  }
  return found;
}

}  // namespace

std::vector<std::string> check_determinism(const SourceFile& file) {
  if (!begins_with(file.path, "components/") || !is_code(file)) return {};
  std::vector<std::string> found = check_transcendentals(file);
  if (begins_with(file.path, "components/runtime/")) return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string code = code_of(file.lines[i]);
    for (const Rule& rule : rules_of_components()) {
      if (std::regex_search(code, rule.pattern)) {
        found.push_back(violation(file, i + 1, rule.what));
      }
    }
  }
  return found;
}

std::vector<std::string> check_shape(const SourceFile& file) {
  static const std::set<std::string> kJunkDrawers = {"util",    "utils",  "utilities", "helper",
                                                     "helpers", "common", "misc"};
  std::vector<std::string> found;
  auto names = file.path_parts();
  names.back() = file.stem();
  for (const std::string& name : names) {
    if (kJunkDrawers.count(name) > 0) {
      found.push_back(violation(file, 1, "'" + name + "' says nothing about what is in it"));
    }
  }
  const std::size_t lines = file.lines.size();
  if (is_code(file) && lines > kMostLines) {
    found.push_back(violation(file, lines, "over 400 lines: two files"));
  }
  if (begins_with(file.path, "configs/graphs/") && lines > kMostGraphLines) {
    found.push_back(violation(file, lines, "a graph of over 60 lines"));
  }
  if (needs_licence(file) &&
      std::none_of(
          file.lines.begin(),
          file.lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines, kLicenceWithin)),
          [](const std::string& line) {
            return line.find("SPDX-License-Identifier: Apache-2.0") != std::string::npos;
          })) {
    found.push_back(violation(file, 1, "no SPDX-License-Identifier: Apache-2.0"));
  }
  return found;
}

std::vector<std::string> check_functions(const SourceFile& file) {
  std::vector<std::string> found;
  if (!is_c_or_cpp(file)) return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (!opens_body(file.lines[i])) continue;
    const std::size_t close = closing_line(file, i);
    if (close > i + 1 + kMostBodyLines) {
      found.push_back(violation(file, i + 1,
                                "a body of " + std::to_string(close - i - 1) + " lines, over " +
                                    std::to_string(kMostBodyLines) + ": two functions"));
    }
    i = close;
  }
  return found;
}

std::vector<std::string> check_classes(const SourceFile& file) {
  static const std::regex kHead(R"(^\s*(template <.*>\s*)?(class|struct)\s+[\w:]+[^;()]*\{\s*$)");
  std::vector<std::string> found;
  if (!is_c_or_cpp(file)) return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string& head = file.lines[i];
    if (!std::regex_search(head, kHead)) continue;
    // clang-format puts the closing brace below the head.
    const std::string closing = std::string(head.find_first_not_of(' '), ' ') + "};";
    std::size_t close = i;
    while (close < file.lines.size() && file.lines[close] != closing) ++close;
    if (close - i <= kMostClassLines + 1) continue;
    found.push_back(violation(file, i + 1,
                              "a class of " + std::to_string(close - i - 1) + " lines, over " +
                                  std::to_string(kMostClassLines) + ": two classes"));
  }
  return found;
}

std::vector<std::string> check_units(const SourceFile& file) {
  static const std::regex kJoined(R"(\bk[A-Z]\w*?[a-z](Deg|Hz|M|Mps|Ms|Ns|Rad|Radps|S)\b)");
  std::vector<std::string> found;
  if (!is_c_or_cpp(file)) return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(file.lines[i], match, kJoined)) continue;
    found.push_back(
        violation(file, i + 1, match.str() + ": a unit stands behind _, as in kWidth_rad"));
  }
  return found;
}

std::vector<std::string> check_time_outs(const SourceFile& file) {
  static const std::regex kWritten(R"(\b(hours|minutes|seconds|milliseconds)\([1-9])");
  static const std::regex kElsewhere(
      "bridge/(dds|domains|robot|ros2)/.*|bridge/gateway/web_limits.hpp");
  std::vector<std::string> found;
  const std::string home = "bridge/run/limits.hpp";
  if (file.path.rfind("bridge/", 0) != 0 || file.path == home) return found;
  if (std::regex_match(file.path, kElsewhere)) return found;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (!std::regex_search(file.lines[i], kWritten)) continue;
    found.push_back(violation(file, i + 1, "a time-out; they stand in " + home));
  }
  return found;
}

}  // namespace clew::structure
