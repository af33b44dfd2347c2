// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <sstream>
#include <string>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/print_text.hpp"
#include "core/math.hpp"
#include "dds/rtps_ports.hpp"
#include "domains/bridge_process.hpp"
#include "line/command_desk.hpp"
#include "log/log.hpp"
#include "ros2/ros2_bridge.hpp"
#include "runtime/config_source.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct Ros2Options {
  std::string run;
  std::optional<int> ros_domain;
  std::string middleware = "cyclonedds";
  std::string distro = "jazzy";
  std::string node_namespace;
  std::string node = "clew";
  std::vector<std::string> remap;
  bool takes_goals = false;
  std::optional<double> goal_heading_rad;
};

core::Error named(const char* option, const core::Error& error) {
  return {error.message, option, 0, 0};
}

/// A run that is named by its domain: another one than that of ROS.
core::Result<void> check_run(const ros2::BridgeOptions& options) {
  // Whatever looks like a number was meant as one: 5.0, -3, 1e2.
  const bool is_number = options.run.find_first_of("0123456789") != std::string::npos &&
                         options.run.find_first_not_of("0123456789.+-eE") == std::string::npos;
  if (is_number && !bridge::is_domain_number(options.run)) {
    return core::Error{"found '" + options.run + "'; allowed: a domain's number, or a run's name",
                       "--domain"};
  }
  if (!is_number) return {};
  const int domain = std::stoi(options.run);
  if (auto good = bridge::check_domain(domain); !good.ok()) return named("--domain", good.error());
  if (options.network.domain != domain) return {};
  return core::Error{
      fmt::format("domain {} is the run's own: ROS needs another one; give "
                  "--ros-domain or ROS_DOMAIN_ID",
                  domain)};
}

core::Result<ros2::BridgeOptions> read_options(const Ros2Options& typed) {
  ros2::BridgeOptions options;
  options.run = typed.run;
  options.takes_goals = typed.takes_goals;
  options.goal_heading_tolerance_rad = typed.goal_heading_rad;
  if (const auto rad = typed.goal_heading_rad; rad && !(*rad > 0.0 && *rad <= core::kPi)) {
    return core::Error{fmt::format("found {}; allowed: above 0 and at most pi, in radians", *rad),
                       "--goal-heading"};
  }
  const auto network = ros2::read_ros_network(ros2::variable_of_process);
  if (!network.ok()) return network.error();
  options.network = *network;
  if (typed.ros_domain) options.network.domain = *typed.ros_domain;
  if (auto good = bridge::check_domain(options.network.domain); !good.ok()) {
    return named(typed.ros_domain ? "--ros-domain" : "ROS_DOMAIN_ID", good.error());
  }
  CLEW_RETURN_IF_ERROR(check_run(options));
  const auto vendor = bridge::vendor_from_name(typed.middleware);
  if (!vendor) {
    return core::Error{"found '" + typed.middleware + "'; allowed: cyclonedds, fastdds",
                       "--middleware"};
  }
  options.vendor = *vendor;
  const auto distro = ros2::distro_from_name(typed.distro);
  if (!distro.ok()) return named("--ros-distro", distro.error());
  options.distro = *distro;
  if (auto good = ros2::check_namespace(typed.node_namespace); !good.ok()) {
    return named("--namespace", good.error());
  }
  options.node_namespace = typed.node_namespace;
  if (auto good = ros2::check_topic_name(typed.node);
      !good.ok() || typed.node.find('/') != std::string::npos) {
    return core::Error{"'" + typed.node + "' is no node's name: allowed are letters, digits and _",
                       "--node"};
  }
  options.node_name = typed.node;
  for (const std::string& text : typed.remap) {
    auto rule = ros2::parse_remap_rule(text);
    if (!rule.ok()) return named("--remap", rule.error());
    options.remap.push_back(std::move(rule).value());
  }
  return options;
}

int ros2_command(const Ros2Options& typed) {
  const auto options = read_options(typed);
  if (!options.ok()) return complain(options.error());
  const auto ended = ros2::run_ros2_bridge(*options, stages::all());
  return ended.ok() ? *ended : complain(ended.error(), kExitFailed);
}

struct DomainsOptions {
  std::string file;
  double status_s = 0.0;
  bool json = false;
};

int domains_command(const DomainsOptions& options) {
  const auto resource = runtime::ConfigPath::from_environment().find("bridges", options.file);
  if (!resource.ok()) return complain(resource.error());
  const auto file = domains::read_bridge_file(*resource);
  if (!file.ok()) return complain(file.error());
  domains::BridgeProcess process;
  process.status_s = options.status_s;
  process.tell = [](const std::string& what) { logs::info("{}", what); };
  process.report = [&](const domains::DomainBridge& bridge) {
    if (options.json) {
      fmt::print("{}", passages_json(bridge));
    } else {
      std::istringstream lines(passages_text(bridge));
      for (std::string line; std::getline(lines, line);)
        fmt::print("{}\n", core::terminal_text(line));
    }
    std::fflush(stdout);
  };
  const auto ended = domains::run_bridge_process(*file, process);
  return ended.ok() ? kExitGood : complain(ended.error(), kExitFailed);
}

void add_domains(CLI::App& bridge, int& status) {
  const auto options = std::make_shared<DomainsOptions>();
  CLI::App* app = bridge.add_subcommand(
      "domains", "Pass topics from DDS domain to DDS domain, of runs, of ROS or of anybody");
  app->add_option("file", options->file, "clew-bridge/1: the domains, and which topics go where")
      ->required();
  app->add_option("--status", options->status_s,
                  "s between reports of what has passed (at the end only)")
      ->check(number_between(0.1, 86400.0));
  app->add_flag("--json", options->json, "report as JSON, an object a line");
  app->callback([options, &status] { status = domains_command(*options); });
}

}  // namespace

void add_bridge(CLI::App& main, int& status) {
  CLI::App* bridge = main.add_subcommand(
      "bridge", "Connect a live run with other systems, or DDS domains with each other");
  bridge->require_subcommand(1);
  add_domains(*bridge, status);
  const auto options = std::make_shared<Ros2Options>();
  CLI::App* app = bridge->add_subcommand("ros2", "Show a live run to ROS 2");
  app->add_option("--domain", options->run, "the run: its DDS domain, or its name")->required();
  app->add_option("--ros-domain", options->ros_domain, "that of ROS; else ROS_DOMAIN_ID, else 0");
  app->add_option("--namespace", options->node_namespace, "of the node, as robot1");
  app->add_option("--node", options->node, "its name")->capture_default_str();
  app->add_option("--remap", options->remap, "FROM:=TO, a topic's other name; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--ros-distro", options->distro, "jazzy or humble")->capture_default_str();
  app->add_option("--middleware", options->middleware, "towards ROS: cyclonedds or fastdds")
      ->capture_default_str();
  app->add_flag(
      "--take-goals", options->takes_goals,
      "what is published on goal_pose or, as a path, on waypoints, by one node at a time, is "
      "the run's new goal");
  app->add_option("--goal-heading", options->goal_heading_rad,
                  "arrival is within so many radians of a goal's orientation, too; else with any "
                  "heading");
  app->callback([options, &status] { status = ros2_command(*options); });
}

}  // namespace clew::tools
