// SPDX-License-Identifier: Apache-2.0
#include "bench/estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bench/run_order.hpp"
#include "bench/world_bench.hpp"

namespace clew::bench {

using core::Result;

namespace {

constexpr std::size_t kMostSampled = 32;

double since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Of `count` numbers every one once, neighbours far apart: steps of the golden section.
std::size_t step_of(std::size_t count) {
  auto step = static_cast<std::size_t>(0.618034 * static_cast<double>(count));
  step = std::max<std::size_t>(step, 1);
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

/// Seconds of a run without the survey of its world; none if it was interrupted.
Result<std::optional<double>> time_run(const BenchPlan& plan, std::size_t index,
                                       const RunOrder& order, const runtime::ConfigPath& configs,
                                       const std::vector<runtime::StageInfo>& stages) {
  const auto [world, run] = order.in_world(index);
  const std::size_t seeds = plan.seeds.size();
  WorldBench bench(plan, world, configs, stages);
  const auto line = bench.run(plan.variants[run / seeds], plan.seeds[run % seeds]);
  if (!line.ok()) return line.error();
  if (!*line) return std::optional<double>();
  return std::optional<double>(nlohmann::json::parse(**line).at("wall_s").get<double>());
}

}  // namespace

Result<Estimate> estimate_cost(const BenchPlan& plan, const runtime::ConfigPath& configs,
                               const std::vector<runtime::StageInfo>& stages, double most_s) {
  const RunOrder order(plan);
  const std::size_t count = order.size();
  const std::size_t step = step_of(count);
  const auto started = std::chrono::steady_clock::now();
  Estimate estimate;
  double sum_s = 0.0;
  double squares_s2 = 0.0;
  std::size_t index = 0;
  while (estimate.sampled < std::min(count, kMostSampled) && since(started) < most_s) {
    const auto run_s = time_run(plan, index, order, configs, stages);
    if (!run_s.ok()) return run_s.error();
    if (!*run_s) return Estimate{};
    ++estimate.sampled;
    sum_s += **run_s;
    squares_s2 += **run_s * **run_s;
    estimate.longest_s = std::max(estimate.longest_s, **run_s);
    index = (index + step) % count;
  }
  const double n = static_cast<double>(estimate.sampled);
  estimate.spent_s = since(started);
  estimate.run_s = sum_s / n;
  estimate.survey_s = std::max(0.0, estimate.spent_s - sum_s) / n;
  const double variance_s2 = std::max(0.0, squares_s2 / n - estimate.run_s * estimate.run_s);
  if (estimate.run_s > 0.0) estimate.error_share = std::sqrt(variance_s2 / n) / estimate.run_s;
  return estimate;
}

double total_s(const BenchPlan& plan, const Estimate& estimate, std::size_t surveys) {
  return estimate.run_s * static_cast<double>(plan.runs()) +
         estimate.survey_s * static_cast<double>(surveys);
}

}  // namespace clew::bench
