// SPDX-License-Identifier: Apache-2.0
#include "train/training_groups.hpp"

#include <limits>

#include "control/infrared/infrared_expert.hpp"
#include "core/random.hpp"
#include "domain/motion_conversion.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/tick_reader.hpp"
#include "runtime/run_plan.hpp"
#include "sense/infrared.hpp"
#include "stages/all.hpp"
#include "wire/codec.hpp"
#include "world/world.hpp"

namespace clew::train {
namespace {

using control::FourInfrareds;
using core::Error;
using core::Result;
using domain::Topic;

constexpr char kTrainer[] = "clew train neuro-fuzzy";

constexpr double kRadius_m = 0.15;                    // of the robot, disc-015
constexpr std::uint32_t kPlaceRandomComponent = 102;  // apart from those of the stages
constexpr std::uint32_t kTriesAPlace = 100;

/// The expert's opinion, and what of it is ahead's and back's, by which Table I goes, and what is
/// the sides'.
TrainingGroup opinion_on(const control::InfraredReadings& readings,
                         const control::InfraredDistances& distances_m) {
  control::InfraredDistances free_beside = distances_m;
  free_beside[control::kLeft] = std::numeric_limits<double>::infinity();
  free_beside[control::kRight] = std::numeric_limits<double>::infinity();
  const control::WheelSpeeds whole = control::expert_opinion({}, distances_m);
  const control::WheelSpeeds ahead = control::expert_opinion({}, free_beside);
  return {readings,
          whole,
          {ahead.left_mps, ahead.right_mps, whole.left_mps - ahead.left_mps,
           whole.right_mps - ahead.right_mps}};
}

/// Puts the robot at random free places of a world, and asks the expert.
Result<void> ask_expert(const world::World& world, std::uint64_t places, const core::Random& random,
                        std::vector<TrainingGroup>& groups) {
  const sense::Infrared sensor({}, kRadius_m);
  const auto infrareds = FourInfrareds::create(sensor.layout(), kTrainer);
  if (!infrareds.ok()) return infrareds.error();
  const core::Vec2 size = world.bounds_max() - world.bounds_min();
  domain::Scan scan;
  std::uint64_t found = 0;
  for (std::uint32_t i = 0; i < places * kTriesAPlace && found < places; ++i) {
    const core::Pose2 pose{world.bounds_min().x() + size.x() * random.uniform(3 * i),
                           world.bounds_min().y() + size.y() * random.uniform(3 * i + 1),
                           core::wrap_angle_rad(2.0 * core::kPi * random.uniform(3 * i + 2))};
    if (world.clearance_m(pose.position(), 2.0 * kRadius_m, 0.0) <= kRadius_m) continue;
    ++found;
    sensor.measure(world, pose, 0.0, random, scan);
    groups.push_back(opinion_on(infrareds->readings(scan), infrareds->distances_m(scan)));
  }
  if (found == places) return {};
  return Error{"too little free space to put the robot at " + std::to_string(places) +
               " random places"};
}

/// A command as wheel speeds: eq. 1 of Wang, Yang & Meng turned around.
control::WheelSpeeds wheel_speeds(const domain::Motion& motion, double tick_s,
                                  double wheel_base_m) {
  if (motion.kind == domain::CommandKind::kWheelSpeeds) return {motion.left_mps, motion.right_mps};
  const domain::Velocities velocities = domain::to_velocities(motion, tick_s, wheel_base_m);
  const double difference_mps = 0.5 * wheel_base_m * velocities.turn_rate_radps;
  return {velocities.speed_mps - difference_mps, velocities.speed_mps + difference_mps};
}

Result<void> check_topics(const bridge::RunRecording& recording) {
  for (const Topic topic : {Topic::kScan, Topic::kCommand}) {
    if (recording.description().schemas.count(topic) != 0) continue;
    return Error{
        "has no " + std::string(domain::topic_name(topic)) + "; training needs scan and command",
        recording.path()};
  }
  return {};
}

Result<void> read_groups(const bridge::RunRecording& recording, const runtime::RunPlan& plan,
                         double wheel_base_m, std::vector<TrainingGroup>& groups) {
  const auto infrareds = FourInfrareds::create(plan.setup.behaviour.scan, kTrainer);
  if (!infrareds.ok()) {
    return Error{infrareds.error().message, recording.path()};
  }
  runtime::TopicSet topics;
  topics.set(index_of(Topic::kScan));
  topics.set(index_of(Topic::kCommand));
  bridge::TickReader reader(recording, topics);
  bridge::Codec<domain::Scan> scans;
  bridge::Codec<domain::Command> commands;
  domain::Scan scan;
  domain::Command command;
  for (;;) {
    const auto tick = reader.next();
    if (!tick.ok()) return tick.error();
    if (*tick == nullptr) return {};
    if (!(*tick)->has(Topic::kScan) || !(*tick)->has(Topic::kCommand)) continue;
    CLEW_RETURN_IF_ERROR(scans.decode((*tick)->cdr(Topic::kScan), scan));
    CLEW_RETURN_IF_ERROR(commands.decode((*tick)->cdr(Topic::kCommand), command));
    if (command.motion.kind == domain::CommandKind::kGiveUp) continue;
    groups.push_back({infrareds->readings(scan),
                      wheel_speeds(command.motion, plan.setup.behaviour.tick_s, wheel_base_m),
                      {}});
  }
}

}  // namespace

Result<ShownGroups> groups_of_expert(const NeuroFuzzyRecipe& recipe,
                                     const runtime::ConfigPath& path) {
  ShownGroups shown;
  shown.origin = "  places: " + std::to_string(recipe.places) + "\n  worlds:\n";
  for (std::size_t i = 0; i < recipe.worlds.size(); ++i) {
    const auto file = path.find("worlds", recipe.worlds[i]);
    if (!file.ok()) return file.error();
    const auto world = world::World::parse(file->text, file->file);
    if (!world.ok()) return world.error();
    const core::Random random({recipe.seed, 0, kPlaceRandomComponent, i});
    const auto asked = ask_expert(*world, recipe.places, random, shown.groups);
    if (!asked.ok()) return Error{asked.error().message, file->file};
    shown.origin += "    - " + recipe.worlds[i] + '\n';
  }
  return shown;
}

Result<ShownGroups> groups_of_recording(const NeuroFuzzyRecipe& recipe, const std::string& file) {
  const auto recording = bridge::RunRecording::open(file);
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(bridge::check_message_types(*recording));
  CLEW_RETURN_IF_ERROR(check_topics(*recording));
  const auto plan = bridge::recorded_plan(*recording, stages::all());
  if (!plan.ok()) return plan.error();
  ShownGroups shown;
  CLEW_RETURN_IF_ERROR(read_groups(*recording, *plan, recipe.wheel_base_m, shown.groups));
  const auto survey = recording->survey_samples();
  if (!survey.ok()) return survey.error();
  shown.origin = "  recording: \"" + survey->hash.hex() + "\"  # the hash that its run printed\n";
  return shown;
}

}  // namespace clew::train
