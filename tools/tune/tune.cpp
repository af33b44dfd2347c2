// SPDX-License-Identifier: Apache-2.0
#include "tune/tune.hpp"

#include <algorithm>

#include "tune/cma_es.hpp"
#include "tune/tune_runs.hpp"

namespace clew::tune {
namespace {

using core::Result;

constexpr double kFirstSigma = 0.3;  // of the cube's side: its middle half is likely

Settings settings_at(const Eigen::VectorXd& point, const TuneSpace& space) {
  Settings settings;
  for (std::size_t i = 0; i < space.ranges.size(); ++i) {
    settings.push_back(space.ranges[i].setting(point[static_cast<Eigen::Index>(i)]));
  }
  return settings;
}

/// Searches; none if it was interrupted.
Result<bool> search(const TuneSpace& space, const TuneOptions& options, TuneRuns& runs,
                    Tuned& tuned) {
  CmaEs strategy(space.ranges.size(), kFirstSigma, options.seed);
  std::optional<double> best;
  while (tuned.evaluations < options.evaluations) {
    const auto points = strategy.ask();
    std::vector<Settings> generation;
    for (const auto& point : points) {
      generation.push_back(settings_at(CmaEs::within_cube(point), space));
    }
    const auto made = runs.make(generation, space.tuning, best);
    if (!made.ok() || !*made) return made;
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double cost = runs.score(generation[i], space.tuning).cost;
      values.push_back(cost + CmaEs::penalty(points[i]));
      ++tuned.evaluations;
      if (best && cost >= *best) continue;
      best = cost;
      tuned.settings = generation[i];
    }
    strategy.tell(points, values);
  }
  return true;
}

/// Compares the best settings with the graph's own, run by run.
void validate(const TuneSpace& space, const TuneRuns& runs, Tuned& tuned) {
  tuned.default_tuning = runs.score({}, space.tuning);
  tuned.best_tuning = runs.score(tuned.settings, space.tuning);
  tuned.default_validation = runs.score({}, space.validation);
  tuned.best_validation = runs.score(tuned.settings, space.validation);
  std::vector<double> gains;
  for (const TuneWorld& world : space.validation.worlds) {
    for (const std::uint64_t seed : space.validation.seeds) {
      const Ran own = runs.at({}, world.name, seed);
      const Ran best = runs.at(tuned.settings, world.name, seed);
      if (own.success && !best.success) ++tuned.only_default;
      if (best.success && !own.success) ++tuned.only_best;
      gains.push_back(best.cost - own.cost);
    }
  }
  tuned.median_gain = bench::quantile(gains, 0.5);
  tuned.gain_interval = bench::quantile_interval(gains, 0.5);
}

}  // namespace

double cost_of(bool success, const std::optional<double>& path_ratio) {
  if (!success) return kFailureCost;
  return std::min(path_ratio.value_or(1.0), kFailureCost);
}

Result<Tuned> tune(const TuneSpace& space, const hunt::Workshop& workshop,
                   const TuneOptions& options) {
  auto opened = TuneRuns::open(space, workshop, options);
  if (!opened.ok()) return opened.error();
  TuneRuns runs = std::move(opened).value();
  Tuned tuned;
  auto goes_on = search(space, options, runs, tuned);
  if (goes_on.ok() && *goes_on) goes_on = runs.make({{}, tuned.settings}, space.validation, {});
  if (goes_on.ok() && *goes_on) goes_on = runs.make({{}}, space.tuning, {});
  if (!goes_on.ok()) return goes_on.error();
  if (!*goes_on) {
    Tuned interrupted;
    interrupted.interrupted_by = runs.interrupted_by();
    return interrupted;
  }
  validate(space, runs, tuned);
  return tuned;
}

}  // namespace clew::tune
