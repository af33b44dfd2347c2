// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <optional>

#include "fleet/output_folder.hpp"
#include "fleet/robot_run.hpp"
#include "fleet/tick_crew.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "run/limits.hpp"

namespace clew::fleet {
namespace {

using core::Result;
using core::Vec2;
using Clock = std::chrono::steady_clock;

std::string other_hash(const core::Hash128& found, const core::Hash128& in_fleet) {
  return "by itself it does something else than in the fleet (hash " + found.hex() +
         " instead of " + in_fleet.hex() + "); this is a fault of clew";
}

/// A fleet under way.
class FleetLoop {
 public:
  FleetLoop(const FleetPlan& plan, const FleetOptions& options)
      : plan_(plan), options_(options), crew_(options.threads) {}

  Result<FleetReport> run() {
    const auto began = Clock::now();
    CLEW_RETURN_IF_ERROR(make_robots());
    step_all();
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      report_.robots.push_back(
          {plan_.robots()[i].entry.name, runs_[i]->statistics(), runs_[i]->hash(), {}, {}});
      const auto& truth = runs_[i]->statistics().truth;
      if (!truth) continue;
      report_.ticks = std::max(report_.ticks, truth->tick);
      report_.sim_time_s = std::max(report_.sim_time_s, truth->sim_time_s);
    }
    report_.hash = hash();
    runs_.clear();
    if (options_.again) {
      run_again();
    } else if (!options_.record.empty()) {
      record();
    }
    report_.wall_s = std::chrono::duration<double>(Clock::now() - began).count();
    return report_;
  }

 private:
  Result<void> make_robots() {
    for (const RobotPlan& robot : plan_.robots()) {
      auto run = RobotRun::create(robot.plan, nullptr);
      if (!run.ok()) return run.error();
      runs_.push_back(std::move(run).value());
      ways_.emplace_back();
      ways_.back().reserve(robot.plan.setup.max_ticks + 1);
    }
    return {};
  }

  void step_all() {
    const std::function<void(std::size_t)> step = [this](std::size_t i) {
      place_others(i);
      runs_[i]->step();
    };
    auto displayed_at = Clock::now();
    std::size_t ended = 0;
    while (ended < runs_.size()) {
      if (const int signal = options_.interrupted(); signal != 0) return note_interrupt(signal);
      crew_->each(runs_.size(), step);
      ++steps_;
      for (std::size_t i = 0; i < runs_.size(); ++i) note_place(i);
      note_gaps();
      ended = static_cast<std::size_t>(
          std::count_if(runs_.begin(), runs_.end(), [](const auto& r) { return r->has_ended(); }));
      if (options_.display && Clock::now() - displayed_at >= bridge::kDisplayPeriod) {
        displayed_at = Clock::now();
        options_.display(steps_ - 1, ended);
      }
    }
  }

  void note_interrupt(int signal) {
    report_.interrupted_by = signal;
    report_.aborted = fmt::format("interrupted by signal {} ({})", signal, ::strsignal(signal));
  }

  /// Where robot `i` has the others in this tick: where they were at the end of the one before.
  void place_others(std::size_t i) {
    std::size_t obstacle = plan_.moving_before_others();
    for (std::size_t j = 0; j < runs_.size(); ++j) {
      if (j == i) continue;
      const Vec2 place = steps_ == 0 ? plan_.robots()[j].entry.start.position() : ways_[j].back();
      plan_.robots()[i].world->place_moving(obstacle++, place);
    }
  }

  void note_place(std::size_t i) {
    if (runs_[i]->next_tick() < steps_) return;  // its run has ended before
    const auto& truth = *runs_[i]->statistics().truth;
    ways_[i].emplace_back(truth.x_m, truth.y_m);
  }

  void note_gaps() {
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double gap_m =
            core::length(ways_[i].back() - ways_[j].back()) - radius_m(i) - radius_m(j);
        report_.least_gap_m = std::min(report_.least_gap_m, gap_m);
        if (gap_m < 0.0) ++report_.contacts;
      }
    }
  }

  double radius_m(std::size_t i) const {
    return plan_.robots()[i].plan.setup.behaviour.robot.radius_m;
  }

  core::Hash128 hash() const {
    std::string lines;
    for (const RobotReport& robot : report_.robots) {
      lines += robot.name + ' ' + robot.hash.hex() + '\n';
    }
    return core::hash128(lines);
  }

  void record() {
    crew_->each(report_.robots.size(), [this](std::size_t i) {
      RobotReport& robot = report_.robots[i];
      const auto recorded = record(i);
      if (recorded.ok()) {
        robot.recording = recording_of(options_.record, plan_.robots()[i].entry);
      } else {
        robot.failure = recorded.error().text();
      }
    });
    if (interrupted_ != 0) note_interrupt(interrupted_);
    note_failures();
  }

  void note_failures() {
    for (const RobotReport& robot : report_.robots) {
      if (robot.failure.empty() || !report_.aborted.empty()) continue;
      report_.aborted = "robot " + robot.name + ": " + robot.failure;
    }
  }

  /// A fleet that was interrupted has no end that a second run could come to.
  void run_again() {
    if (!report_.aborted.empty()) return;
    std::vector<RobotAlone> robots;
    for (std::size_t i = 0; i < report_.robots.size(); ++i) {
      auto plan = plan_.alone(i, ways_of_others(i));
      if (!plan.ok()) {
        report_.robots[i].failure = plan.error().text();
        return note_failures();
      }
      robots.push_back({report_.robots[i].name, std::move(plan).value(),
                        options_.record.empty()
                            ? std::string()
                            : recording_of(options_.record, plan_.robots()[i].entry)});
    }
    crew_.reset();  // processes begin as copies of this one: by then it has no other threads
    const AloneResults results = options_.again(robots);
    for (std::size_t i = 0; i < report_.robots.size(); ++i) note_again(results, robots[i], i);
    if (results.interrupted_by != 0) note_interrupt(results.interrupted_by);
    note_failures();
  }

  void note_again(const AloneResults& results, const RobotAlone& alone, std::size_t i) {
    RobotReport& robot = report_.robots[i];
    const Result<core::Hash128>& hash = results.hashes[i];
    if (!hash.ok()) {
      robot.failure = hash.error().text();
    } else if (*hash != robot.hash) {
      robot.failure = other_hash(*hash, robot.hash);
    } else {
      robot.recording = alone.recording;
    }
  }

  /// Runs robot `i` again, by itself among the others as they moved.
  Result<void> record(std::size_t i) {
    const std::string path = recording_of(options_.record, plan_.robots()[i].entry);
    auto plan = plan_.alone(i, ways_of_others(i));
    if (!plan.ok()) return plan.error();
    auto sink = bridge::RecordingSink::create(*plan, path, options_.force);
    if (!sink.ok()) return sink.error();
    auto run = RobotRun::create(*plan, sink->get());
    if (!run.ok()) return run.error();
    const std::size_t ticks = ways_[i].size();
    while ((*run)->next_tick() < ticks && (*run)->failure().empty() && !interrupted_again()) {
      (*run)->step();
    }
    const bool cut_off = (*run)->next_tick() < ticks || !(*run)->has_ended();
    const auto account =
        (*sink)->close({cut_off ? "the fleet was interrupted" : (*run)->failure(), false});
    if (!(*run)->failure().empty()) return core::Error{(*run)->failure()};
    if ((*run)->next_tick() < ticks) return {};
    if (const std::string what = bridge::complaint(account); !what.empty()) {
      return core::Error{what};
    }
    if ((*run)->hash() == report_.robots[i].hash) return {};
    return core::Error{other_hash((*run)->hash(), report_.robots[i].hash)};
  }

  /// While recordings are written, by several threads.
  bool interrupted_again() {
    if (const int signal = options_.interrupted(); signal != 0) interrupted_ = signal;
    return interrupted_ != 0;
  }

  std::vector<OtherRobot> ways_of_others(std::size_t i) const {
    std::vector<OtherRobot> others;
    for (std::size_t j = 0; j < ways_.size(); ++j) {
      if (j == i) continue;
      OtherRobot& other = others.emplace_back();
      other.radius_m = plan_.robots()[j].seen_radius_m;
      for (std::size_t tick = 0; tick < ways_[j].size(); ++tick) {
        // A robot that stands takes no room.
        if (tick > 0 && ways_[j][tick] == ways_[j][tick - 1]) continue;
        other.path.push_back({static_cast<double>(tick) * plan_.tick_s(), ways_[j][tick]});
      }
      if (other.path.empty()) {
        other.path.push_back({0.0, plan_.robots()[j].entry.start.position()});
      }
    }
    return others;
  }

  const FleetPlan& plan_;
  const FleetOptions& options_;
  std::optional<TickCrew> crew_;
  std::vector<std::unique_ptr<RobotRun>> runs_;
  std::vector<std::vector<Vec2>> ways_;  ///< of each robot, a place a tick
  std::uint64_t steps_ = 0;              ///< ticks that have been, with tick 0
  FleetReport report_;
  std::atomic<int> interrupted_{0};  ///< the signal that came while recordings were written
};

/// What stands against recordings, before anything runs; makes their folder.
Result<void> check_recordings(const FleetPlan& plan, const FleetOptions& options) {
  if (options.record.empty() && !options.again) return {};
  if (const auto ticks = plan.check_ticks(kMostRecordedPlaces); !ticks.ok()) {
    core::Error error = ticks.error();
    error.message += ", if they are recorded, or run as processes";
    return error;
  }
  if (options.record.empty()) return {};
  if (const auto folder = make_folder(options.record); !folder.ok()) return folder.error();
  for (const RobotPlan& robot : plan.robots()) {
    CLEW_RETURN_IF_ERROR(check_new_file(recording_of(options.record, robot.entry), options.force));
  }
  return {};
}

}  // namespace

bool FleetReport::all_reached() const {
  return std::all_of(robots.begin(), robots.end(), [](const RobotReport& robot) {
    const auto& truth = robot.statistics.truth;
    return truth && truth->outcome == domain::Outcome::kReached;
  });
}

std::string recording_of(const std::string& folder, const RobotEntry& robot) {
  return folder + '/' + robot.name + ".mcap";
}

Result<FleetReport> run_fleet(const FleetPlan& plan, const FleetOptions& options) {
  CLEW_RETURN_IF_ERROR(check_recordings(plan, options));
  return FleetLoop(plan, options).run();
}

}  // namespace clew::fleet
