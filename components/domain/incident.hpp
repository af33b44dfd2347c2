// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/terminal_text.hpp"

namespace clew::domain {

// Kinds of incidents.
inline constexpr const char* kRefused = "refused";  ///< a process, an endpoint, a sample
inline constexpr const char* kForeignReader = "foreign_reader";  ///< nothing waits for it

/// What befalls a run from outside of its graph, or what its processes notice of each other. It is
/// a fact of the wall clock: it says what happened to a run, not what the run is. So it is no
/// sample, and in no hash.
struct Incident {
  std::uint64_t tick = 0;  ///< about when: told before this tick began, as far as was known
  std::string kind;
  std::string stage;  ///< or the group of stages, or `run`: who tells it
  std::string text;
};

template <typename V>
void visit_fields(V& v, Incident& i) {
  v(i.tick, i.kind, i.stage, i.text);
}

/// What a stranger says is no longer than this in an incident.
inline constexpr std::size_t kMostIncidentBytes = 400;

/// A text that may hold what strangers say, as a line of bounded length that steers no terminal.
inline std::string as_one_line(std::string text) {
  text = core::terminal_text(text);
  if (text.size() <= kMostIncidentBytes) return text;
  std::size_t end = kMostIncidentBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;  // of UTF-8
  return text.substr(0, end) + "...";
}

}  // namespace clew::domain
