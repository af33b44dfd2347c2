// SPDX-License-Identifier: Apache-2.0
/// What must not stand in a file, whatever it includes: the rules of determinism and of shape.
#pragma once

#include <string>
#include <vector>

#include "source_tree.hpp"

namespace clew::structure {

/// Components have no clock, thread, randomness, file or unordered container of their own; runtime
/// reads the graphs' files. Transcendentals come from core, whose bits are the same everywhere.
std::vector<std::string> check_determinism(const SourceFile& file);

/// No file is a junk drawer, none is over 400 lines, a graph is at most 60, and each names its
/// licence.
std::vector<std::string> check_shape(const SourceFile& file);

/// No body of a function in C or C++ is over 50 lines, as clang-format lays them out.
std::vector<std::string> check_functions(const SourceFile& file);

/// No class is over 250 lines from brace to brace.
std::vector<std::string> check_classes(const SourceFile& file);

/// A constant's unit is spelt as a field's is: kWidth_rad, not joined to the name.
std::vector<std::string> check_units(const SourceFile& file);

/// The time-outs of a run stand in bridge/run/limits.hpp, each with its reason.
std::vector<std::string> check_time_outs(const SourceFile& file);

}  // namespace clew::structure
