// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_plan.hpp"
#include "hunt/case_run.hpp"
#include "hunt/parameter_range.hpp"

namespace clew::hunt {

/// All runs among which failures are sought.
struct HuntSpace {
  GraphChoice graph;
  std::vector<ParameterRange> ranges;
  std::vector<bench::BenchWorld> worlds;             ///< each as it is
  std::vector<const trap_worlds::Family*> families;  ///< any world of each
  bool moves_start = true;                           ///< else each world's own start and heading
  double robot_radius_m = 0.0;

  std::size_t sources() const { return worlds.size() + families.size(); }
};

/// A point of that space. Shares are from 0 to 1.
struct Candidate {
  std::size_t source = 0;        ///< a world, or after those a family
  std::uint64_t world_seed = 1;  ///< of a family's world, with its number
  int number = 0;
  std::optional<std::array<double, 2>> place;  ///< none: the world's own start
  std::optional<double> heading;               ///< none: the world's own
  std::uint64_t seed = 1;
  std::vector<double> parameters;

  bool is_same_world(const Candidate& other) const {
    return source == other.source && world_seed == other.world_seed && number == other.number;
  }
};

/// Worlds of a family differ in depth by their number, of this many.
inline constexpr int kDepths = 16;

/// A candidate by chance, a function of (seed, index).
Candidate draw_candidate(const HuntSpace& space, std::uint64_t seed, std::uint64_t index);

/// A neighbour of another candidate, by chance in the same way: one to three of start, heading,
/// noise, depth, the world itself and the parameters differ.
Candidate mutate_candidate(const Candidate& parent, const HuntSpace& space, std::uint64_t seed,
                           std::uint64_t index);

/// The run that a candidate stands for. `world_file` of it is the world's name.
core::Result<RunCase> realise(const Candidate& candidate, const HuntSpace& space,
                              const runtime::ConfigSource& configs);

}  // namespace clew::hunt
