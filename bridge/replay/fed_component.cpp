// SPDX-License-Identifier: Apache-2.0
#include "replay/fed_component.hpp"

#include <fmt/format.h>

#include <utility>

#include "run/limits.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/shutdown.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using domain::Topic;

ProcessLayout layout_of(const WireSettings& settings) {
  ProcessLayout layout;
  layout.program = settings.program;
  layout.middleware = settings.middleware;
  return layout;
}

}  // namespace

FedComponent::FedComponent(const runtime::RunPlan& plan, const runtime::GraphStage& stage,
                           WireSettings settings, std::uint64_t first_compared,
                           std::function<void()> on_arrival,
                           std::function<void(const std::string&)> log)
    : plan_(plan),
      stage_(stage),
      settings_(std::move(settings)),
      environment_(settings_.domain, settings_.lease_s, settings_.run_id),
      log_(std::move(log)),
      comparison_(stage.info->name, stage.ports, first_compared, std::move(on_arrival)) {
  member_.stage = stage.info->name;
  member_.stages = {member_.stage};
  member_.third_party = is_third_party(stage);
  member_.starts_ticks = stage.ports.delayed_inputs.any();
}

Result<void> FedComponent::open(Participant& participant, StartBarrier& barrier) {
  std::vector<ExpectedEndpoint> expected;
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    const std::string name(domain::topic_name(topic));
    if (ports().outputs[index]) expected.push_back({name, true, stage(), member_.third_party});
    if (ports().all_inputs()[index])
      expected.push_back({name, false, stage(), member_.third_party});
  }
  barrier.expect(expected);
  return comparison_.open(participant, barrier, settings_.history_depth);
}

Result<void> FedComponent::start(bool by_us, const std::string& prefix) {
  if (!environment_.failure().empty()) return Error{environment_.failure()};
  if (!by_us) {
    log_(how_to_start(plan_, stage_, settings_.program, settings_.domain, environment_));
    return {};
  }
  ProcessLayout layout = layout_of(settings_);
  if (!prefix.empty()) layout.prefix[stage()] = prefix;
  auto child = ChildProcess::start(command_of(member_, plan_, layout, environment_));
  if (!child.ok()) return Error{stage() + ": " + child.error().text()};
  member_.child = std::move(child).value();
  return {};
}

Assignment FedComponent::assignment() const {
  Assignment assignment;
  assignment.run_id = settings_.run_id;
  assignment.run_key = settings_.run_key.secret();
  assignment.stages = {stage()};
  assignment.bundle = bundle_for(plan_, stage_);
  assignment.middleware = middleware_of(stage_, layout_of(settings_));
  assignment.domain = settings_.domain;
  assignment.lease_s = settings_.lease_s;
  assignment.hash = false;
  assignment.history_depth = static_cast<std::uint32_t>(settings_.history_depth);
  assignment.lead = 0;
  assignment.interventions = settings_.interventions;
  assignment.peers = {kReplayName};
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    const std::string name(domain::topic_name(topic));
    if (ports().outputs[index]) assignment.expected.push_back({name, false, kReplayName, false});
    if (!ports().all_inputs()[index]) continue;
    const runtime::GraphStage* writer = plan_.graph.writer_of(topic);
    assignment.expected.push_back({name, true, writer->info->name, is_third_party(*writer)});
  }
  return assignment;
}

Result<void> FedComponent::welcome(std::unique_ptr<Link>& link, const Hello& hello) {
  if (member_.link != nullptr || member_.left_at || member_.third_party || hello.stage != stage()) {
    return Error{"this replay has no place for a component " + hello.stage};
  }
  if (hello.idl_fingerprint != idl_fingerprint()) {
    return Error{"it was built from other IDL files than this replay"};
  }
  link->post(FrameType::kAssignment, assignment());
  member_.link = std::move(link);
  return {};
}

std::vector<std::string> FedComponent::missing() const {
  std::vector<std::string> missing = member_.missing;
  if (!member_.third_party && !member_.link) missing.push_back(stage() + " has not reported");
  return missing;
}

Result<void> FedComponent::handle(const Frame& frame, Time now) {
  member_.note(frame, now);
  if (frame.type == FrameType::kNotice || frame.type == FrameType::kFatal) {
    const auto text = frame.as<Text>();
    if (text && frame.type == FrameType::kFatal) return Error{text->text};
    if (text) log_(text->text);
  } else if (frame.type == FrameType::kIncident) {
    if (const auto told = frame.as<domain::Incident>()) log_(told->text);
  }
  return {};
}

// The line broke: the process has died, or is dying; its end says more than the line's.
Error FedComponent::lost() const {
  const bool told = member_.child && !member_.child->running();
  return {fmt::format(
      "{} {} at tick {}", stage(),
      told ? fmt::format("(process {}) {}", member_.child->process_id(), member_.child->end())
           : "has left",
      next_compared())};
}

Result<void> FedComponent::serve(Time now) {
  CLEW_RETURN_IF_ERROR(comparison_.compare());
  if (member_.link) {
    member_.link->flush();
    const bool open = member_.link->receive();
    while (const auto frame = member_.link->next()) CLEW_RETURN_IF_ERROR(handle(*frame, now));
    if (open) return {};
    member_.link.reset();
    member_.left_at = now;
  }
  if (finished() && !member_.third_party) return {};
  if (member_.child) member_.child->reap();
  const bool ended = member_.child && !member_.child->running();
  const bool left = member_.left_at && (!member_.child || now - *member_.left_at >= kEndGrace);
  if (ended || left) return lost();
  return {};
}

void FedComponent::go() {
  if (member_.starts_ticks && member_.link) member_.link->post(FrameType::kGo, Tick{0});
}

Result<void> FedComponent::feed(const RecordedTick& recorded) {
  if (recorded.tick() != next_tick_) {
    return Error{fmt::format("has no sample of tick {} for {}; the next is of tick {}", next_tick_,
                             stage(), recorded.tick())};
  }
  for (Topic topic : domain::kAllTopics) {
    if (!ports().all_inputs()[index_of(topic)] || recorded.has(topic)) continue;
    return Error{fmt::format("has no sample of '{}' of tick {}, which {} needs",
                             domain::topic_name(topic), recorded.tick(), stage())};
  }
  ++next_tick_;
  comparison_.expect(recorded);
  // Drive begins a tick when it may and has the command of the one before.
  if (member_.starts_ticks && member_.link) {
    member_.link->post(FrameType::kCredit, Tick{next_tick_});
  }
  return {};
}

void FedComponent::finish() {
  if (!member_.link) return;
  // Without a tick there is nothing to confirm.
  if (next_tick_ == 0) {
    member_.finished.emplace();
  } else {
    member_.link->post(FrameType::kFinish, Tick{next_tick_ - 1});
  }
}

void FedComponent::end(bool orderly) {
  std::vector<Member> members;
  members.push_back(std::move(member_));
  end_processes(members, orderly);
}

}  // namespace clew::bridge
