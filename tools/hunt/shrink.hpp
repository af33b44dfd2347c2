// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "hunt/case_run.hpp"
#include "hunt/property.hpp"
#include "world/world_file.hpp"

namespace clew::hunt {

struct ShrinkOptions {
  std::size_t most_runs = 1000;
  /// Called after each run, with what is left in the world. May be null.
  std::function<void(std::size_t runs, std::size_t left)> progress;
};

/// What of a world is left, or was there: walls, polygons, circles, moving obstacles, subgoals.
std::size_t parts_of(const world::WorldFile& world);

/// A case that fails, made smaller.
struct Shrunk {
  enum class End {
    kHolds,        ///< the property held in the case as it was given: there is nothing to shrink
    kUndecided,    ///< it depends on a value that the run does not have
    kMinimal,      ///< nothing can be taken away any more
    kOutOfRuns,    ///< smaller, but most_runs was not enough to prove that it is minimal
    kInterrupted,  ///< by a signal
  };
  End end = End::kHolds;
  RunCase which;        ///< the smallest that was found; as given, if there is nothing to shrink
  std::string outcome;  ///< of it
  std::string hash;
  std::size_t parts_before = 0;
  std::size_t parts_after = 0;
  std::size_t runs = 0;
};

/// Makes a failing case smaller as long as the property fails in it with the same outcome, and the
/// world is as solvable as it was: first obstacles are taken away (minimise), and moving ones stand
/// still; then the start goes forward along the way that the robot took, walls become shorter,
/// polygons lose corners, the bounds close in, numbers become round and the seed 1; over again
/// until nothing changes. So the result is 1-minimal: no obstacle can be missed.
core::Result<Shrunk> shrink(const RunCase& which, const Property& property,
                            const Workshop& workshop, const ShrinkOptions& options);

}  // namespace clew::hunt
