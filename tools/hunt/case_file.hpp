// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/yaml_reader.hpp"
#include "hunt/case_run.hpp"

namespace clew::hunt {

/// A case as a file, `clew-case/1`: a property, a run in which to test it, and how the run ended
/// when the file was written. The world is a file beside it.
struct CaseFile {
  std::string about;
  std::string property;
  GraphChoice graph;
  std::string world;  ///< a path from the case file's folder
  std::uint64_t seed = 1;
  std::string outcome;  ///< as it was; empty: not stated
  std::string hash;     ///< the same
};

std::string case_text(const CaseFile& file);

/// Refused, with the place: what is no case file, unknown and missing keys, values out of range.
core::Result<CaseFile> parse_case(const std::string& text, const std::string& file);

/// Whether a file's text says that it is a case; a world says that it is none.
bool is_case(const std::string& text, const std::string& file);

/// The run of a case file that lies at `path`, its world read.
core::Result<RunCase> run_of(const CaseFile& file, const std::string& path);

/// The command line that runs a case again, `world` being where its world lies.
std::string command_line(const GraphChoice& graph, const std::string& world, std::uint64_t seed);

}  // namespace clew::hunt
