// SPDX-License-Identifier: Apache-2.0
#include "export/rosbag2_export.hpp"

#include "replay/recorded_plan.hpp"
#include "replay/tick_reader.hpp"
#include "ros2/bag_output.hpp"
#include "ros2/run_publisher.hpp"

namespace clew::exports {
namespace {

constexpr char kNodeName[] = "clew";
constexpr double kReportPeriod_s = 1.0;

/// As the samples of a tick follow from each other.
constexpr domain::Topic kCausalOrder[] = {domain::Topic::kState,    domain::Topic::kOdometry,
                                          domain::Topic::kTarget,   domain::Topic::kScan,
                                          domain::Topic::kLandmark, domain::Topic::kEvent,
                                          domain::Topic::kGuidance, domain::Topic::kCommand};

core::Result<void> publish_all(const bridge::RunRecording& recording, ros2::BagOutput& bag,
                               ros2::RunPublisher& publisher) {
  const double tick_s = recording.description().tick_s;
  runtime::TopicSet topics;
  for (const auto& [topic, schema] : recording.description().schemas) topics.set(index_of(topic));
  bridge::TickReader reader(recording, topics);
  double reported_s = 0.0;
  while (true) {
    const auto tick = reader.next();
    if (!tick.ok()) return tick.error();
    if (*tick == nullptr) break;
    const double now_s = static_cast<double>((*tick)->tick()) * tick_s;
    bag.set_time(bridge::tick_to_ns((*tick)->tick(), tick_s));
    for (const domain::Topic topic : kCausalOrder) {
      if (!(*tick)->has(topic)) continue;
      bridge::Sample sample;
      sample.topic = topic;
      sample.cdr = (*tick)->cdr(topic);
      publisher.add(sample);
    }
    if (now_s < reported_s + kReportPeriod_s) continue;
    reported_s = now_s;
    publisher.add_report(0.0, 0);
  }
  publisher.end("the recording is over");
  return {};
}

}  // namespace

core::Result<void> export_rosbag2(const bridge::RunRecording& recording,
                                  const Rosbag2Options& options,
                                  const std::vector<runtime::StageInfo>& stages) {
  const auto plan = bridge::described_plan(recording, stages);
  if (!plan.ok()) return plan.error();
  auto bag = ros2::BagOutput::create(options.directory, options.force);
  if (!bag.ok()) return bag.error();
  auto publisher =
      ros2::RunPublisher::create(**bag, ros2::Names(options.node_namespace, {}), kNodeName, *plan);
  if (!publisher.ok()) return publisher.error();
  (*publisher)->begin();
  CLEW_RETURN_IF_ERROR(publish_all(recording, **bag, **publisher));
  return (*bag)->finish();
}

}  // namespace clew::exports
