// SPDX-License-Identifier: Apache-2.0
#include "robot/robot_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "ros2/names.hpp"

namespace clew::robot {
namespace {

/// Odometry that is kept: seconds of the fastest robot.
constexpr std::size_t kMostPoses = 256;
constexpr auto kLookPeriod = std::chrono::milliseconds(20);
/// How often the last command is said, and how long after another.
constexpr int kLastWords = 5;
constexpr auto kLastWordsPeriod = std::chrono::milliseconds(40);
constexpr ros2::QosProfile kTransformReader{false, false, 100};
constexpr ros2::QosProfile kStaticTransformReader{true, true, 100};

/// The pose between two, `part` of the way from a to b.
core::Pose2 between(const core::Pose2& a, const core::Pose2& b, double part) {
  const double turn_rad = core::wrap_angle_rad(b.heading_rad - a.heading_rad);
  return {a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          core::wrap_angle_rad(a.heading_rad + part * turn_rad)};
}

/// Where `pose` is in the frame of `base`, both given in one and the same frame.
core::Pose2 relative_to(const core::Pose2& base, const core::Pose2& pose) {
  const double c = core::cos(base.heading_rad);
  const double s = core::sin(base.heading_rad);
  const core::Vec2 way = pose.position() - base.position();
  return {c * way.x() + s * way.y(), c * way.y() - s * way.x(),
          core::wrap_angle_rad(pose.heading_rad - base.heading_rad)};
}

/// Where `pose`, given in the frame of `base`, is in the frame that `base` is given in.
core::Pose2 placed_on(const core::Pose2& base, const core::Pose2& pose) {
  const double c = core::cos(base.heading_rad);
  const double s = core::sin(base.heading_rad);
  return {base.x_m + c * pose.x_m - s * pose.y_m, base.y_m + s * pose.x_m + c * pose.y_m,
          core::wrap_angle_rad(base.heading_rad + pose.heading_rad)};
}

ros2::Time later(const ros2::Time& stamp, double seconds) {
  constexpr std::int64_t kSecond_ns = 1000000000;
  const std::int64_t sum_ns = std::int64_t{stamp.sec} * kSecond_ns + stamp.nanosec +
                              static_cast<std::int64_t>(std::llround(seconds * 1e9));
  // Stamps before zero are none.
  const std::int64_t ns = std::max<std::int64_t>(sum_ns, 0);
  return {static_cast<std::int32_t>(ns / kSecond_ns), static_cast<std::uint32_t>(ns % kSecond_ns)};
}

}  // namespace

/// Hands samples on that may come in, and are messages.
template <typename Message>
class RobotLink::Inlet : public bridge::SampleListener {
 public:
  explicit Inlet(RobotLink& link) : link_(link) {}

  void on_sample(std::string_view cdr, const bridge::RemoteEndpoint* writer) override {
    if (writer == nullptr || !link_.node_->may_take(*writer)) return;
    Message message;
    if (!ros2::decode(cdr, message).ok()) return;
    const std::lock_guard<std::mutex> lock(link_.mutex_);
    link_.take(std::move(message), writer->guid, Time::clock::now());
  }

 private:
  RobotLink& link_;
};

RobotLink::RobotLink(const Settings& settings, double patience_s)
    : settings_(settings),
      patience_s_(patience_s),
      scan_(settings.timeout_s),
      odometry_message_(settings.timeout_s) {}

core::Result<std::unique_ptr<RobotLink>> RobotLink::create(const Settings& settings,
                                                           const std::string& origin,
                                                           double tick_s) {
  std::unique_ptr<RobotLink> self(
      new RobotLink(settings, std::max(settings.timeout_s, 2.0 * tick_s)));
  ros2::NodeConfig config;
  config.vendor = settings.vendor;
  config.network = settings.network;
  config.distro = settings.distro;
  config.name = settings.node_name;
  config.node_namespace = settings.node_namespace;
  config.origin.id = origin;
  auto node = ros2::Node::create(config);
  if (!node.ok()) return node.error();
  self->node_ = std::move(node).value();
  CLEW_RETURN_IF_ERROR(self->open());
  self->watchdog_ = std::thread([link = self.get()] { link->watch(); });
  return self;
}

core::Result<void> RobotLink::open() {
  const auto listen = [&](auto type, const std::string& topic,
                          const ros2::QosProfile& profile) -> core::Result<void> {
    using Message = typename decltype(type)::element_type;
    auto listener = std::make_unique<Inlet<Message>>(*this);
    auto reader = node_->create_reader<Message>(topic, profile, *listener);
    if (!reader.ok()) return reader.error();
    listeners_.push_back(std::move(listener));
    readers_.push_back(std::move(reader).value());
    return {};
  };
  using ros2::kSensorReaderProfile;
  const auto scan = std::shared_ptr<ros2::LaserScan>();
  const auto odometry = std::shared_ptr<ros2::Odometry>();
  const auto transforms = std::shared_ptr<ros2::TFMessage>();
  CLEW_RETURN_IF_ERROR(listen(scan, settings_.scan_topic, kSensorReaderProfile));
  CLEW_RETURN_IF_ERROR(listen(odometry, settings_.odometry_topic, kSensorReaderProfile));
  CLEW_RETURN_IF_ERROR(listen(transforms, "/tf", kTransformReader));
  CLEW_RETURN_IF_ERROR(listen(transforms, "/tf_static", kStaticTransformReader));
  const auto write = [&](auto& publisher) -> core::Result<void> {
    using Publisher = typename std::decay_t<decltype(publisher)>::value_type;
    auto created = Publisher::create(*node_, settings_.command_topic, ros2::kDefaultProfile);
    if (!created.ok()) return created.error();
    publisher.emplace(std::move(created).value());
    return {};
  };
  CLEW_RETURN_IF_ERROR(settings_.stamped ? write(twist_stamped_) : write(twist_));
  return node_->announce();
}

RobotLink::~RobotLink() {
  if (watchdog_.joinable()) {
    if (!stands_still_) stand_still();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    ending_.notify_one();
    watchdog_.join();
  }
  readers_.clear();
}

void RobotLink::watch() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_.wait_for(lock, kLookPeriod, [&] { return ends_; })) {
    const Time now = Time::clock::now();
    if (commanded_ && seconds_between(*commanded_, now) > patience_s_) publish({}, now);
  }
}

void RobotLink::take(ros2::LaserScan scan, const std::string& writer, Time now) {
  if (!scan_.listens_to(writer, now) || !ros2::check_fan(scan).ok()) return;
  if (!ros2::measured_anything(scan)) return;
  // Nobody knows where it was measured.
  if (mount_ && !mount_of(scan.header.frame_id)) return;
  scan_.take(std::move(scan), writer, now);
  note_mount();
}

void RobotLink::take(ros2::Odometry odometry, const std::string& writer, Time now) {
  if (!odometry_message_.listens_to(writer, now)) return;
  const double stamp_s = ros2::to_seconds(odometry.header.stamp);
  if (!ros2::to_pose2(odometry.pose.pose).ok()) return;
  const ros2::Odometry message = odometry;
  if (!odometry_message_.take(std::move(odometry), writer, now)) return;
  odometry_ = odometry_input_.next(message).value();
  // A clock that was set back, or another robot's.
  if (!past_.empty() && stamp_s <= past_.back().first) past_.clear();
  past_.emplace_back(stamp_s, odometry_.pose_odom_robot);
  if (past_.size() > kMostPoses) past_.pop_front();
  note_mount();
}

void RobotLink::take(const ros2::TFMessage& transforms, const std::string& /*writer*/,
                     Time /*now*/) {
  transforms_.add(transforms);
  note_mount();
}

std::optional<Mount> RobotLink::mount_of(const std::string& frame) const {
  if (settings_.laser) return Mount{*settings_.laser, false};
  if (!odometry_message_.is_there()) return std::nullopt;
  return transforms_.mount(odometry_message_.message().child_frame_id, frame);
}

void RobotLink::note_mount() {
  if (!scan_.is_there()) return;
  if (const auto mount = mount_of(scan_.message().header.frame_id)) mount_ = mount;
}

std::string RobotLink::missing() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string text;
  const auto lacks = [&](bool is_there, const std::string& what) {
    if (!is_there) text += (text.empty() ? "" : ", ") + what;
  };
  lacks(scan_.is_there(), settings_.scan_topic);
  lacks(odometry_message_.is_there(), settings_.odometry_topic);
  lacks(node_->is_read(settings_.command_topic), "a reader of " + settings_.command_topic);
  if (text.empty() && !mount_) {
    text = fmt::format(
        "where '{}' is on '{}' in /tf_static and /tf (or give laser_x_m, laser_y_m "
        "and laser_heading_deg)",
        scan_.message().header.frame_id, odometry_message_.message().child_frame_id);
  }
  return text;
}

core::Result<void> RobotLink::wait_until_there(Time deadline) const {
  std::string lacks = missing();
  while (!lacks.empty() && Time::clock::now() < deadline) {
    std::this_thread::sleep_for(kLookPeriod);
    lacks = missing();
  }
  if (lacks.empty()) return {};
  return core::Error{
      fmt::format("the robot is not there: ROS domain {} on {} lacks {}", settings_.network.domain,
                  settings_.network.on_network ? "the network" : "127.0.0.1", lacks)};
}

std::optional<core::Pose2> RobotLink::pose_at(double stamp_s) const {
  if (past_.empty() || stamp_s < past_.front().first) return std::nullopt;
  const auto after = std::upper_bound(
      past_.begin(), past_.end(), stamp_s,
      [](double stamp, const std::pair<double, core::Pose2>& one) { return stamp < one.first; });
  if (after == past_.end()) return past_.back().second;
  const auto& [after_s, pose_after] = *after;
  const auto& [before_s, pose_before] = *(after - 1);
  return between(pose_before, pose_after, (stamp_s - before_s) / (after_s - before_s));
}

RobotView RobotLink::look(Time now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  RobotView view;
  view.odometry = odometry_;
  view.covariance_fault = odometry_input_.covariance_fault();
  view.odometry_age_s = odometry_message_.age_s(now);
  view.scan = scan_.message();
  view.scan_age_s = scan_.age_s(now);
  const Mount& laser = mount_.value();
  view.pose_robot_laser = laser.pose_robot_laser;
  if (laser.upside_down) {
    view.scan.angle_min = -view.scan.angle_min;
    view.scan.angle_max = -view.scan.angle_max;
    view.scan.angle_increment = -view.scan.angle_increment;
  }
  view.pose_odom_at_scan = pose_at(ros2::to_seconds(view.scan.header.stamp));
  return view;
}

core::Pose2 RobotView::laser_seen_from(const core::Pose2& pose_odom_robot) const {
  if (!pose_odom_at_scan) return pose_robot_laser;
  return placed_on(relative_to(pose_odom_robot, *pose_odom_at_scan), pose_robot_laser);
}

void RobotLink::command(const domain::Velocities& velocities, Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  commanded_ = now;
  publish(stands_still_ ? domain::Velocities{} : velocities, now);
}

void RobotLink::stand_still() {
  for (int i = 0; i < kLastWords; ++i) {
    if (i > 0) std::this_thread::sleep_for(kLastWordsPeriod);
    const std::lock_guard<std::mutex> lock(mutex_);
    stands_still_ = true;
    publish({}, Time::clock::now());
  }
}

void RobotLink::publish(const domain::Velocities& velocities, Time now) {
  ros2::Twist twist;
  twist.linear.x = velocities.speed_mps;
  twist.angular.z = velocities.turn_rate_radps;
  if (twist_) return twist_->publish(twist);
  // In the robot's own time, whatever clock it has: controllers drop commands that look old.
  const ros2::Odometry& odometry = odometry_message_.message();
  ros2::TwistStamped stamped;
  stamped.header.frame_id = odometry.child_frame_id;
  stamped.header.stamp = later(odometry.header.stamp, odometry_message_.age_s(now));
  stamped.twist = twist;
  twist_stamped_->publish(stamped);
}

}  // namespace clew::robot
