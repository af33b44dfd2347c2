// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hunt/candidate.hpp"
#include "hunt/property.hpp"

namespace clew::hunt {

struct HuntOptions {
  std::size_t runs = 200;
  std::uint64_t seed = 1;
  std::size_t jobs = 1;  ///< worker processes; changes no result
  /// Called after each run. May be null.
  std::function<void(std::size_t done, std::size_t failed)> progress;
};

/// A run of a hunt.
struct HuntRun {
  std::size_t index = 0;              ///< from 0
  std::optional<std::size_t> parent;  ///< the run that it was made of; none: drawn by chance
  Candidate candidate;
  std::string world;  ///< its name
  Verdict verdict;
  std::string outcome;
  std::string hash;
  std::string refused;  ///< why it could not be run, by parameters that do not fit; empty: it was
  std::string line;     ///< all of it, one line of JSON, without anything of the machine

  bool failed() const { return verdict.holds == false; }
};

struct HuntEnd {
  int interrupted_by = 0;     ///< a signal; the runs before it are there
  std::vector<HuntRun> runs;  ///< by index

  std::size_t failures() const;
  std::size_t held() const;
  std::size_t refusals() const;
  std::size_t undecided() const { return runs.size() - failures() - held() - refusals(); }
};

/// Searches a space for runs in which a property fails.
///
/// The first third of the runs is drawn by chance. Then the search is guided: three of four runs
/// are neighbours of near misses, the runs in which the property held with the least robustness,
/// the best of each world, so that one world does not take them all; the rest goes on by chance. It
/// is a (mu + lambda) evolution strategy by mutation alone (Beyer & Schwefel 2002, "Evolution
/// strategies: a comprehensive introduction"), on the robustness as in falsification of temporal
/// logic (Fainekos & Pappas 2009). *Deviation:* failures are not parents, since more of what has
/// been found tells nothing new. Runs go by generations of 16 whatever the number of jobs, so the
/// same seed gives the same runs.
core::Result<HuntEnd> hunt(const HuntSpace& space, const Property& property,
                           const Workshop& workshop, const HuntOptions& options);

/// Writes each failure as a case, `DIR/cases/NNNNN/case.yaml` with `world.yaml` beside it, and all
/// runs as `DIR/runs.jsonl`. The cases' paths, in the order of the runs.
core::Result<std::vector<std::string>> write_hunt(const HuntEnd& end, const HuntSpace& space,
                                                  const Property& property,
                                                  const Workshop& workshop,
                                                  const std::string& directory);

}  // namespace clew::hunt
