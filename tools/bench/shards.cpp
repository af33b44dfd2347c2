// SPDX-License-Identifier: Apache-2.0
#include "bench/shards.hpp"

#include <algorithm>
#include <charconv>

namespace clew::bench {
namespace {

constexpr std::size_t kUnitsEach = 4;   // below that a shard or worker may stand idle for long
constexpr std::size_t kLeastRuns = 16;  // below that the survey of a world costs more than its runs

/// The first run of piece `number`: run r is in piece r * pieces / runs.
std::size_t first_of(std::size_t number, std::size_t pieces, std::size_t runs) {
  return (number * runs + pieces - 1) / pieces;
}

std::size_t rounded_up(std::size_t dividend, std::size_t divisor) {
  return (dividend + divisor - 1) / divisor;
}

}  // namespace

core::Result<Shard> read_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = has_slash ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  const bool is_read = has_slash && count.ec == std::errc() && count.ptr == end;
  if (is_read && shard.number >= 1 && shard.number <= shard.count && shard.count <= kMostShards) {
    return shard;
  }
  return core::Error{"found '" + text + "'; expected I/N, N from 1 to " +
                         std::to_string(kMostShards) + " and I from 1 to N, as 2/4",
                     "--shard"};
}

Shards::Shards(const BenchPlan& plan, std::size_t count)
    : count_(count),
      worlds_(plan.worlds.size()),
      runs_(plan.variants.size() * plan.seeds.size()),
      pieces_(count == 1 ? 1 : std::min(rounded_up(kUnitsEach * count, worlds_), runs_)) {}

std::size_t Shards::of(std::size_t world, std::size_t run) const {
  return (world * pieces_ + run * pieces_ / runs_) % count_ + 1;
}

std::vector<Unit> Shards::units_of(std::size_t number, std::size_t workers) const {
  std::vector<Unit> units;
  for (std::size_t dealt = number - 1; dealt < worlds_ * pieces_; dealt += count_) {
    const std::size_t piece = dealt % pieces_;
    units.push_back(
        {dealt / pieces_, first_of(piece, pieces_, runs_), first_of(piece + 1, pieces_, runs_)});
  }
  if (workers == 1 || units.empty()) return units;
  const std::size_t wanted = rounded_up(kUnitsEach * workers, units.size());
  std::vector<Unit> smaller;
  for (const Unit& unit : units) {
    const std::size_t runs = unit.end - unit.first;
    const std::size_t cuts = std::clamp<std::size_t>(runs / kLeastRuns, 1, wanted);
    for (std::size_t i = 0; i < cuts; ++i) {
      smaller.push_back({unit.world, unit.first + first_of(i, cuts, runs),
                         unit.first + first_of(i + 1, cuts, runs)});
    }
  }
  return smaller;
}

}  // namespace clew::bench
