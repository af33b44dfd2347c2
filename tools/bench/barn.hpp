// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/bench_results.hpp"
#include "bench/suite.hpp"
#include "bench/summary.hpp"
#include "core/result.hpp"

namespace clew::bench {

/// Reads the worlds of BARN (Perille, Truong, Xiao & Stone 2020), which the user has: each
/// `world_N.world` of a directory, by N, with `path_N.npy` beside it or in the folder `path_files`,
/// as the challenge's repository has them. Refused: a directory without worlds, a world without its
/// path, and what the importer refuses.
core::Result<std::vector<BarnWorld>> read_barn(const std::string& directory);

/// The score of a run by the challenge's program:
///
///     arrived * OT / clip(AT, least * OT, 8 * OT),  OT = path_m / (2 m/s)
///
/// AT is the time taken; after 100 s nobody arrives. `least` is 2, and was 4 in 2022. The program's
/// clock starts when the robot has moved 0.1 m. *Deviation:* here AT is counted from the start, so
/// a score is never better than the program's.
BarnScore barn_score(bool reached, double time_s, double path_m);

/// A row a variant: mean scores over all worlds, arrivals and collisions.
Table barn_table(const BenchResults& results);

}  // namespace clew::bench
