// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hunt/bisect_search.hpp"
#include "hunt/tick_bisect.hpp"

namespace clew::tools {

/// What the answers are about.
struct BisectNames {
  std::string a;
  std::string b;
  bool has_property = false;
  double tick_s = 0.0;
  bool of_versions = false;  ///< b is another version of the program that runs a
};

/// One line of JSON each, or text for people.
void print_json(const hunt::BisectEnd& end, const BisectNames& names);
void print_words(const hunt::BisectEnd& end, const BisectNames& names);
void print_json(const hunt::TickBisectEnd& end, const BisectNames& names);
void print_words(const hunt::TickBisectEnd& end, const BisectNames& names);

}  // namespace clew::tools
