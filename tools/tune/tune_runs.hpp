// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bench/line_file.hpp"
#include "tune/tune.hpp"

namespace clew::tune {

/// As --set takes them.
using Settings = std::vector<std::string>;

struct Ran {
  bool success = false;
  double cost = kFailureCost;
};

/// All runs of a search, each made once: in worker processes, and written down, so that a search
/// that was interrupted does not make them again.
class TuneRuns {
 public:
  /// Takes what options.directory holds. Refused: results that were made with something else (which
  /// is named), and a file that is none of results. What is given must outlive this.
  static core::Result<TuneRuns> open(const TuneSpace& space, const hunt::Workshop& workshop,
                                     const TuneOptions& options);

  /// Makes those that are missing, all settings in all worlds. False if it was interrupted.
  core::Result<bool> make(const std::vector<Settings>& all, const TuneWorlds& worlds,
                          std::optional<double> best_cost);

  /// Of runs that were made.
  Ran at(const Settings& settings, const std::string& world, std::uint64_t seed) const;
  Score score(const Settings& settings, const TuneWorlds& worlds) const;

  /// The signal; 0 if there was none.
  int interrupted_by() const { return interrupted_by_; }

 private:
  /// A run, by what decides it: settings, world and seed.
  using Key = std::tuple<std::string, std::string, std::uint64_t>;
  struct Order;

  TuneRuns(const TuneSpace& space, const hunt::Workshop& workshop, const TuneOptions& options,
           bench::LineFile file)
      : space_(space), workshop_(workshop), options_(options), file_(std::move(file)) {}
  core::Result<void> take_found();
  core::Result<void> take(const std::string& line, int number);
  std::vector<Order> missing(const std::vector<Settings>& all, const TuneWorlds& worlds) const;
  core::Result<std::string> run(const Order& order) const;

  const TuneSpace& space_;
  const hunt::Workshop& workshop_;
  const TuneOptions& options_;
  bench::LineFile file_;
  std::map<Key, Ran> ran_;
  int interrupted_by_ = 0;
};

}  // namespace clew::tune
