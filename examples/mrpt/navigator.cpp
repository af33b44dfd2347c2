// SPDX-License-Identifier: Apache-2.0
#include "navigator.hpp"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/kinematics/CVehicleVelCmd_DiffDriven.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/nav/holonomic/CHolonomicFullEval.h>
#include <mrpt/nav/holonomic/CHolonomicND.h>
#include <mrpt/nav/reactive/CReactiveNavigationSystem.h>
#include <stdlib.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>

#include "navigator_settings.hpp"

namespace clew_mrpt {
namespace {

using mrpt::kinematics::CVehicleVelCmd;
using mrpt::kinematics::CVehicleVelCmd_DiffDriven;
using mrpt::nav::CAbstractNavigator;

/// MRPT's clock is one for the whole process, and several navigators may be at work in it.
std::mutex& clock_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// A folder that ends with the process.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "clew-mrpt-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Where none can be made, the current one.
  std::string path() const { return path_.empty() ? "." : path_; }

 private:
  std::string path_;
};

/// The robot as MRPT sees it: what came in with the tick, and the command that came of it.
class Robot final : public mrpt::nav::CRobot2NavInterface {
 public:
  explicit Robot(double tick_s) : tick_s_(tick_s) { setMinLoggingLevel(mrpt::system::LVL_ERROR); }

  void begin(const Input& input) {
    input_ = &input;
    ++ticks_;
    // From a day that MRPT takes for one.
    constexpr double kFirst_s = 1.0e9;
    mrpt::Clock::setSimulatedTime(mrpt::Clock::fromDouble(kFirst_s + time_s()));
  }
  const Velocities& command() const { return command_; }

  bool getCurrentPoseAndSpeeds(mrpt::math::TPose2D& pose, mrpt::math::TTwist2D& velocity,
                               mrpt::system::TTimeStamp& time, mrpt::math::TPose2D& odometry,
                               std::string& frame) override {
    pose = {input_->pose[0], input_->pose[1], input_->pose[2]};
    odometry = pose;
    velocity = {input_->velocity[0] * std::cos(input_->pose[2]),
                input_->velocity[0] * std::sin(input_->pose[2]), input_->velocity[1]};
    time = mrpt::Clock::now();
    frame = "map";
    return true;
  }
  bool changeSpeeds(const CVehicleVelCmd& command) override {
    const auto* velocities = dynamic_cast<const CVehicleVelCmd_DiffDriven*>(&command);
    if (velocities == nullptr) return false;
    command_ = {velocities->lin_vel, velocities->ang_vel};
    return true;
  }
  bool changeSpeedsNOP() override { return true; }
  bool stop(bool) override {
    command_ = {0.0, 0.0};
    return true;
  }
  CVehicleVelCmd::Ptr getEmergencyStopCmd() override { return getStopCmd(); }
  CVehicleVelCmd::Ptr getStopCmd() override {
    return std::make_shared<CVehicleVelCmd_DiffDriven>();
  }
  CVehicleVelCmd::Ptr getAlignCmd(double) override { return nullptr; }
  bool senseObstacles(mrpt::maps::CSimplePointsMap& obstacles,
                      mrpt::system::TTimeStamp& time) override {
    obstacles.clear();
    for (std::size_t i = 0; i + 1 < input_->obstacles.size(); i += 2) {
      obstacles.insertPoint(static_cast<float>(input_->obstacles[i]),
                            static_cast<float>(input_->obstacles[i + 1]));
    }
    time = mrpt::Clock::now();
    return true;
  }
  double getNavigationTime() override { return time_s(); }
  void resetNavigationTimer() override {}
  // Events for people: the run has its own.
  void sendNavigationStartEvent() override {}
  void sendNavigationEndEvent() override {}
  void sendWaypointReachedEvent(int, bool) override {}
  void sendNewWaypointTargetEvent(int) override {}
  void sendNavigationEndDueToErrorEvent() override {}
  void sendWaySeemsBlockedEvent() override {}
  void sendApparentCollisionEvent() override {}
  void sendCannotGetCloserToBlockedTargetEvent() override {}

 private:
  double time_s() const { return static_cast<double>(ticks_) * tick_s_; }

  double tick_s_;
  std::uint64_t ticks_ = 0;
  const Input* input_ = nullptr;
  Velocities command_{};
};

/// MRPT's navigator, without the table of times that it would print at its end.
class QuietSystem final : public mrpt::nav::CReactiveNavigationSystem {
 public:
  explicit QuietSystem(Robot& robot) : CReactiveNavigationSystem(robot, false, false) {
    setMinLoggingLevel(mrpt::system::LVL_ERROR);
    enableTimeLog(false);
    m_timlog_delays.disable();
    m_timlog_delays.clear(true);
    m_timlog_delays.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  }
};

}  // namespace

struct Navigator::Parts {
  explicit Parts(double tick_s) : robot(tick_s), system(robot) {}

  Robot robot;
  QuietSystem system;
  std::array<double, 3> target{};
  bool has_target = false;
};

Navigator::Navigator(const NavigatorSettings& settings, double tick_s) {
  const std::lock_guard<std::mutex> lock(clock_mutex());
  mrpt::Clock::setSimulatedTime(mrpt::Clock::fromDouble(1.0e9));
  mrpt::Clock::setActiveClock(mrpt::Clock::Source::Simulated);
  parts_ = std::make_unique<Parts>(tick_s);
  // Of its methods MRPT wants every setting written: its own defaults.
  mrpt::config::CConfigFileMemory defaults;
  mrpt::nav::CHolonomicFullEval().saveConfigFile(defaults);
  mrpt::nav::CHolonomicND().saveConfigFile(defaults);
  parts_->system.loadConfigFile(
      mrpt::config::CConfigFileMemory(defaults.getContent() + '\n' + configuration(settings)));
  // It keeps tables of its paths in files: in a folder of this process's own.
  static const Folder folder;
  parts_->system.params_abstract_ptg_navigator.ptg_cache_files_directory = folder.path();
  parts_->system.initialize();
}

Navigator::~Navigator() = default;

Velocities Navigator::step(const Input& input) {
  const std::lock_guard<std::mutex> lock(clock_mutex());
  Parts& parts = *parts_;
  parts.robot.begin(input);
  // A target that was reached, or an error, is told once more in the next tick.
  const bool idle = parts.system.getCurrentState() != CAbstractNavigator::NAVIGATING;
  if (!parts.has_target || idle || parts.target != input.target) {
    parts.has_target = true;
    parts.target = input.target;
    if (parts.system.getCurrentState() == CAbstractNavigator::NAV_ERROR) {
      parts.system.resetNavError();
    }
    CAbstractNavigator::TNavigationParams order;
    order.target.target_coords = {input.target[0], input.target[1], 0.0};
    order.target.targetAllowedDistance = static_cast<float>(0.5 * input.target[2]);
    order.target.targetDesiredRelSpeed = 0.2;
    parts.system.navigate(&order);
  }
  parts.system.navigationStep();
  return parts.robot.command();
}

}  // namespace clew_mrpt
