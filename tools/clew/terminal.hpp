// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::tools {

/// Whether a file is a terminal that knows how to clear a line: no pipe, and not TERM=dumb.
bool is_terminal(int file);

/// Whether it shows colours, too: not if the environment has NO_COLOR.
bool shows_colour(int file);

enum class Tone { kGood, kDoubtful, kBad };

/// A word of a result: green, yellow or red where standard output shows colours.
std::string in_colour(const std::string& word, Tone tone);

/// Whether standard error is such a terminal, and `-q` does not forbid to show on it how far the
/// command is.
bool shows_progress();

}  // namespace clew::tools
