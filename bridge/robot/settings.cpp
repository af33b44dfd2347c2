// SPDX-License-Identifier: Apache-2.0
#include "robot/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/angle.hpp"
#include "core/nearest_name.hpp"
#include "dds/rtps_ports.hpp"
#include "ros2/names.hpp"

namespace clew::robot {
namespace {

using core::Error;
using core::Result;

/// Reads one setting after the other, and keeps the first error.
class Texts {
 public:
  explicit Texts(const std::map<std::string, std::string>& texts) : texts_(texts) {}

  const std::string* find(const std::string& key) const {
    const auto found = texts_.find(key);
    return found == texts_.end() ? nullptr : &found->second;
  }
  std::string word(const std::string& key, const std::string& otherwise) const {
    const std::string* const text = find(key);
    return text == nullptr ? otherwise : *text;
  }
  void number(const std::string& key, double least, double most, double& value) {
    const std::string* const text = find(key);
    if (text == nullptr) return;
    double read = 0.0;
    const char* const end = text->data() + text->size();
    const auto [stop, error] = std::from_chars(text->data(), end, read);
    if (error == std::errc() && stop == end && read >= least && read <= most) {
      value = read;
    } else {
      refuse(key, *text, fmt::format("{} to {}", least, most));
    }
  }
  /// Whether the word is `yes`, of the two that are allowed; `no` if it is not given.
  bool either(const std::string& key, const std::string& no, const std::string& yes) {
    const std::string text = word(key, no);
    if (text != no && text != yes) refuse(key, text, no + ", " + yes);
    return text == yes;
  }
  void check(const std::string& key, const Result<void>& good) {
    if (!good.ok()) refuse(key + ": " + good.error().message);
  }
  void refuse(const std::string& key, const std::string& found, const std::string& allowed) {
    refuse(fmt::format("{} is '{}'; allowed: {}", key, found, allowed));
  }
  void refuse(std::string why) {
    if (!error_) error_ = Error{std::move(why)};
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  const std::map<std::string, std::string>& texts_;
  std::optional<Error> error_;
};

void read_network(Texts& texts, const ros2::Variables& variable, Settings& settings) {
  const auto network = ros2::read_ros_network(variable);
  if (!network.ok()) return texts.refuse(network.error().text());
  settings.network = *network;
  double domain = settings.network.domain;
  texts.number("domain", 0.0, 99.0, domain);
  settings.network.domain = static_cast<int>(domain);
  if (domain != std::floor(domain)) {
    texts.refuse("domain", texts.word("domain", ""), "a whole number from 0 to 99");
  }
  texts.check(texts.find("domain") == nullptr ? "ROS_DOMAIN_ID" : "domain",
              bridge::check_domain(settings.network.domain));
}

void read_names(Texts& texts, Settings& settings) {
  const std::string node_namespace = texts.word("namespace", "");
  texts.check("namespace", ros2::check_namespace(node_namespace));
  const ros2::Names names(node_namespace, {});
  settings.node_namespace = names.node_namespace();
  const auto topic = [&](const std::string& key) {
    const std::string name = texts.word(key, key);
    const auto good = ros2::check_topic_name(name);
    texts.check(key, good);
    return good.ok() ? names.topic(name) : name;
  };
  settings.scan_topic = topic("scan");
  settings.odometry_topic = topic("odom");
  settings.command_topic = topic("cmd_vel");
  texts.check("node", ros2::check_topic_name(settings.node_name));
}

void read_laser(Texts& texts, Settings& settings) {
  const std::vector<std::string> keys = {"laser_x_m", "laser_y_m", "laser_heading_deg"};
  const bool any = std::any_of(keys.begin(), keys.end(),
                               [&](const std::string& key) { return texts.find(key) != nullptr; });
  if (!any) return;
  core::Pose2 laser;
  double heading_deg = 0.0;
  texts.number(keys[0], -10.0, 10.0, laser.x_m);
  texts.number(keys[1], -10.0, 10.0, laser.y_m);
  texts.number(keys[2], -360.0, 360.0, heading_deg);
  laser.heading_rad = core::wrap_angle_rad(core::radians(heading_deg));
  settings.laser = laser;
}

}  // namespace

const std::vector<std::string>& setting_names() {
  static const std::vector<std::string> kNames = {
      "domain",    "namespace", "node",           "distro",    "middleware",
      "scan",      "odom",      "cmd_vel",        "command",   "timeout_s",
      "give_up_s", "laser_x_m", "brake_margin_m", "laser_y_m", "laser_heading_deg"};
  return kNames;
}

Result<Settings> read_settings(const std::map<std::string, std::string>& given,
                               const ros2::Variables& variable, const std::string& node) {
  for (const auto& [key, value] : given) {
    const auto& known = setting_names();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return Error{core::unknown_name("key of ros2", key, known)};
  }
  Texts texts(given);
  Settings settings;
  settings.node_name = texts.word("node", node);
  read_network(texts, variable, settings);
  read_names(texts, settings);
  settings.distro =
      texts.either("distro", "jazzy", "humble") ? ros2::Distro::kHumble : ros2::Distro::kJazzy;
  settings.vendor = texts.either("middleware", "cyclonedds", "fastdds")
                        ? bridge::Vendor::kFastDds
                        : bridge::Vendor::kCycloneDds;
  settings.stamped = texts.either("command", "twist", "twist_stamped");
  texts.number("timeout_s", 0.05, 10.0, settings.timeout_s);
  texts.number("give_up_s", 0.1, 3600.0, settings.give_up_s);
  texts.number("brake_margin_m", 0.0, 1.0, settings.brake_margin_m);
  read_laser(texts, settings);
  if (texts.error()) return *texts.error();
  return settings;
}

}  // namespace clew::robot
