// SPDX-License-Identifier: Apache-2.0
#include "component/component_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>

#include "component/group_participant.hpp"
#include "component/json_lines.hpp"
#include "component/process_host.hpp"
#include "component/sealed_participant.hpp"
#include "component/start_barrier.hpp"
#include "component/succession_worker.hpp"
#include "core/process_end.hpp"
#include "line/heartbeat.hpp"
#include "line/link.hpp"
#include "log/log.hpp"
#include "plugins/plugin_loader.hpp"
#include "run/limits.hpp"
#include "vendors/network_addresses.hpp"
#include "vendors/participant_factory.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;
using Allowed = std::optional<std::vector<std::string>>;

// The run is over for this component when its supervisor says so, or is gone.
class ComponentLoop {
 public:
  /// With `brings_to_rest` the robot is not left in motion when the supervisor is gone.
  ComponentLoop(Link& link, ProcessHost& host, SuccessionWorker& succession, bool brings_to_rest)
      : link_(link), host_(host), succession_(succession), brings_to_rest_(brings_to_rest) {}

  /// Returns true after an orderly end.
  bool run() {
    while (true) {
      const auto now = Clock::now();
      host_.poll(now);
      if (finish_at_ && !finished_) try_to_finish();
      if (now >= next_flush_) {
        host_.flush();
        next_flush_ = now + kFlushPeriod;
      }
      wait();
      if (lost_) {
        if (host_.has_come_to_rest() || now > rest_until_) return false;
        continue;
      }
      link_.flush();
      if (!link_.receive()) {
        if (!brings_to_rest_ || finished_) return finished_;
        lose_supervisor(now);
      }
      while (auto frame = link_.next()) handle(*frame);
    }
  }

 private:
  void lose_supervisor(Clock::time_point now) {
    lost_ = true;
    rest_until_ = now + kRestTimeout;
    host_.rest();
    host_.allow_until(UINT64_MAX);  // nobody is waited for any more
  }

  void wait() {
    auto until = next_flush_;
    if (const auto due = host_.next_due()) until = std::min(until, *due);
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - Clock::now());
    timespec timeout{0, std::max<std::int64_t>(left.count(), 0)};
    pollfd descriptor{link_.socket(), link_.poll_events(), 0};
    ::ppoll(&descriptor, lost_ ? 0 : 1, &timeout, nullptr);
  }

  void handle(const Frame& frame) {
    if (frame.type == FrameType::kGo) host_.go(Clock::now());
    if (frame.type == FrameType::kCredit) {
      if (const auto credit = frame.as<Tick>()) host_.allow_until(credit->tick);
    }
    if (frame.type == FrameType::kIntervention) {
      if (auto change = frame.as<domain::Intervention>()) {
        const std::uint64_t tick = change->tick;
        succession_.take(*std::move(change));
        link_.post(FrameType::kNoted, Tick{tick});
      }
    }
    if (frame.type == FrameType::kHold) {
      if (const auto from = frame.as<Tick>()) {
        link_.post(FrameType::kHeld, Tick{host_.hold(from->tick)});
      }
    }
    if (frame.type == FrameType::kRelease) host_.release(Clock::now());
    if (frame.type == FrameType::kPace) {
      if (const auto pace = frame.as<PaceChange>()) host_.set_pace(pace->factor, Clock::now());
    }
    if (frame.type == FrameType::kSpool) host_.spool();
    if (frame.type == FrameType::kRest) host_.rest();
    if (frame.type == FrameType::kSlow) {
      if (const auto slow = frame.as<Slow>()) host_.slow(slow->slowly);
    }
    if (frame.type == FrameType::kFinish) {
      if (const auto last = frame.as<Tick>()) finish_at_ = last->tick;
    }
  }

  void try_to_finish() {
    auto finished = host_.finished(*finish_at_);
    if (!finished) return;
    host_.flush();
    link_.post(FrameType::kFinished, std::move(*finished));
    finished_ = true;
  }

  Link& link_;
  ProcessHost& host_;
  SuccessionWorker& succession_;
  const bool brings_to_rest_;
  bool lost_ = false;  ///< the supervisor
  Clock::time_point rest_until_{};
  std::optional<std::uint64_t> finish_at_;
  bool finished_ = false;
  Clock::time_point next_flush_{};
};

Result<Assignment> take_assignment(Link& link, const std::string& name) {
  link.post(FrameType::kHello, Hello{name, ::getpid(), std::string(idl_fingerprint())});
  const auto frame = link.wait_for_frame(Clock::now() + kAssignmentTimeout);
  if (!frame.ok()) return frame.error();
  if (frame->type == FrameType::kNotice) {
    const auto text = frame->as<Text>();
    return Error{text ? text->text : "the supervisor refused"};
  }
  auto assignment = frame->as<Assignment>();
  if (frame->type != FrameType::kAssignment || !assignment) {
    return Error{"the supervisor speaks another version of clew"};
  }
  return *std::move(assignment);
}

// Before any thread is started that is to have it, too.
Result<void> take_realtime_priority(int priority) {
  const sched_param parameters{priority};
  if (priority == 0 || ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0) return {};
  return Error{fmt::format("real-time priority {}: {}; see 'ulimit -r' for what is allowed",
                           priority, std::strerror(errno))};
}

struct Prepared {
  std::vector<runtime::NodeSuccession> nodes;
  runtime::RunPlan plan;
  std::string reader;                            ///< the stage that the plan was read for
  std::shared_ptr<const runtime::RunPlan> last;  ///< after all that is known to change
};

/// What a program's failure does to its relay: it says why and ends. Where another process may take
/// its place, that is for the log only.
JsonLines::Fail end_with_program(Link& link, const runtime::GraphStage& stage) {
  const FrameType type = stage.deployment.may_restart() ? FrameType::kNotice : FrameType::kFatal;
  return [&link, type, name = stage.info->name](const Error& error) {
    link.post(type, Text{name + ": " + error.text()});
    link.flush_until(Clock::now() + kEndGrace);
    core::end_at_once(1);
  };
}

/// The stage that needs most of the plan: one that knows the world, if there is one.
std::string most_demanding(const std::vector<std::string>& names,
                           const std::vector<runtime::StageInfo>& stages) {
  for (const runtime::StageInfo& info : stages) {
    const bool own = std::find(names.begin(), names.end(), info.name) != names.end();
    if (own && info.knows_world) return info.name;
  }
  return names.front();
}

std::function<void(std::string)> say(Link& link, FrameType type) {
  return [&link, type](std::string text) { link.post(type, Text{std::move(text)}); };
}

/// The robot's process is told of its supervisor's death (SIGTERM) instead of dying with it. It
/// then has a moment to bring the robot to rest; a process that hangs dies after that.
void outlive_supervisor_for_a_moment() {
  struct sigaction action {};
  action.sa_handler = [](int) { ::alarm(static_cast<unsigned>(kRestTimeout.count()) + 1); };
  ::sigaction(SIGTERM, &action, nullptr);
}

/// Makes nodes of any kind.
runtime::MakeNode node_maker(Link& link, const RobotMaker& robots) {
  return [&link, of_robot = robots.make](const runtime::RunPlan& plan,
                                         const runtime::GraphStage& stage) {
    if (stage.deployment.ros2) {
      outlive_supervisor_for_a_moment();  // its last word to the robot comes after its line's end
      return of_robot(plan, stage);
    }
    if (stage.deployment.json_lines) {
      return make_json_lines_node(plan, stage, end_with_program(link, stage));
    }
    return runtime::make_node(plan, stage);
  };
}

Result<runtime::Node> make_node_of(const runtime::MakeNode& make, const runtime::RunPlan& plan,
                                   const std::string& stage) {
  const runtime::GraphStage* graph_stage = plan.graph.find(stage);
  if (graph_stage == nullptr) return Error{"the run's graph has no stage " + stage};
  return make(plan, *graph_stage);
}

/// A run from elsewhere starts components here, and nothing that this host does not allow.
Result<void> check_programs(const runtime::Graph& graph, const std::vector<std::string>& own,
                            const Allowed& allowed) {
  if (!allowed) return {};
  for (const std::string& stage : own) {
    const runtime::GraphStage* const found = graph.find(stage);
    if (found == nullptr || found->deployment.exec.empty()) continue;
    const std::string& program = found->deployment.exec.front();
    if (std::count(allowed->begin(), allowed->end(), program) > 0) continue;
    return Error{"this host does not start it for others; see --allow of 'clew host'", program};
  }
  return {};
}

Result<Prepared> prepare(const runtime::MakeNode& make, const Assignment& assignment,
                         const Allowed& allowed, const std::vector<runtime::StageInfo>& stages) {
  const auto plugins = assignment.bundle.find(kPluginLines);
  if (plugins != assignment.bundle.end()) {
    if (allowed) CLEW_RETURN_IF_ERROR(check_plugin_lines(plugins->second, *allowed));
    CLEW_RETURN_IF_ERROR(load_plugin_lines(plugins->second));
  }
  if (assignment.stages.empty()) return Error{"the run has assigned no stage"};
  const std::string reader = most_demanding(assignment.stages, stages);
  auto plan = runtime::read_prepared_run(assignment.bundle, stages, reader);
  if (!plan.ok()) return plan.error();
  CLEW_RETURN_IF_ERROR(check_programs(plan->graph, assignment.stages, allowed));
  auto plans = runtime::change_all(*plan, assignment.interventions, stages, reader);
  if (!plans.ok()) return plans.error();
  Prepared prepared{{}, std::move(plan).value(), reader, {}};
  for (const std::string& stage : assignment.stages) {
    auto node = make_node_of(make, prepared.plan, stage);
    if (!node.ok()) return node.error();
    auto& succession = prepared.nodes.emplace_back(std::move(node).value());
    runtime::add_successors(prepared.plan, assignment.interventions, *plans, succession, make);
  }
  prepared.last =
      plans->empty() ? std::make_shared<const runtime::RunPlan>(prepared.plan) : plans->back();
  return prepared;
}

std::function<void(std::string)> tell(Link& link, const std::string& name, const char* kind) {
  return [&link, name, kind](std::string text) {
    link.post(FrameType::kIncident, domain::Incident{0, kind, name, std::move(text)});
  };
}

NodeHost::Handlers handlers_for(Link& link) {
  return {say(link, FrameType::kNotice),
          say(link, FrameType::kFatal),
          [&link](const Progress& progress) { link.post(FrameType::kProgress, progress); },
          [&link](const Checkpoint& checkpoint) { link.post(FrameType::kCheckpoint, checkpoint); },
          [&link](const std::string& spool) { link.post_bytes(FrameType::kSamples, spool); },
          [&link](const TookOver& change) { link.post(FrameType::kTookOver, change); },
          [&link](const domain::Incident& told) { link.post(FrameType::kIncident, told); }};
}

/// The participant of the process, once it has met those of the others.
Result<std::unique_ptr<Participant>> join(const Assignment& assignment, const std::string& name,
                                          StartBarrier& barrier) {
  const auto vendor = vendor_from_name(assignment.middleware);
  if (!vendor) return Error{"unknown middleware '" + assignment.middleware + "'"};
  const auto hosts = network_of(assignment.hosts);
  if (!hosts.ok()) return hosts.error();
  auto participant = create_unsettled_participant(
      *vendor,
      {assignment.domain, name, assignment.lease_s, {}, false, assignment.security, *hosts},
      barrier);
  if (participant.ok()) {
    // Those that are late are found, too, if not as fast.
    static_cast<void>(barrier.wait_for_participants(assignment.peers, Clock::now() + kMeetTimeout));
  }
  return participant;
}

/// Takes the process's place on the wire, where the run begins or is.
Result<void> open_stages(ProcessHost& host, const Assignment& assignment, Participant& participant,
                         GroupParticipant& inside, const StartBarrier& barrier) {
  host.keep_inputs(assignment.input_histories);
  if (assignment.checkpoint) CLEW_RETURN_IF_ERROR(host.restore(*assignment.checkpoint));
  CLEW_RETURN_IF_ERROR(host.open(participant, barrier));
  if (assignment.checkpoint) {
    CLEW_RETURN_IF_ERROR(host.repeat_last_outputs(*assignment.checkpoint));
  }
  inside.start();
  if (assignment.resumes) host.go(Clock::now());
  return {};
}

Result<bool> take_part(Link& link, const Assignment& assignment, const std::string& name,
                       const Allowed& allowed, const std::vector<runtime::StageInfo>& stages,
                       const MeetRobots& meet) {
  const auto still_preparing = [&] {
    link.post(FrameType::kPreparing, Text{name + " still makes its component"});
  };
  std::optional<Heartbeat> alive;
  alive.emplace(still_preparing);
  const RobotMaker robots = meet({assignment.run_id, assignment.domain,
                                  say(link, FrameType::kNotice), say(link, FrameType::kFatal)});
  const runtime::MakeNode make = node_maker(link, robots);
  auto prepared = prepare(make, assignment, allowed, stages);
  if (!prepared.ok()) return prepared.error();
  // A heartbeat of ordinary priority would wait behind the steps, and the process be killed.
  alive.reset();
  CLEW_RETURN_IF_ERROR(take_realtime_priority(assignment.realtime_priority));
  alive.emplace(still_preparing);

  std::mutex reporting;  // the last report sent is the newest
  const auto report_missing = [&](const StartBarrier& barrier) {
    const std::lock_guard<std::mutex> lock(reporting);
    link.post(FrameType::kWaiting, Waiting{barrier.missing()});
  };
  StartBarrier barrier(name, assignment.expected,
                       {[&] { report_missing(barrier); }, tell(link, name, domain::kRefused),
                        say(link, FrameType::kFatal), tell(link, name, domain::kForeignReader)});
  barrier.demand_seals(RunKey(assignment.run_key));
  auto wire = join(assignment, name, barrier);
  if (!wire.ok()) return wire.error();
  auto group = std::make_unique<GroupParticipant>(std::move(wire).value(), assignment.stages,
                                                  assignment.expected, barrier);
  GroupParticipant& inside = *group;
  SealedParticipant participant(std::move(group), RunKey(assignment.run_key));
  ProcessHost host(std::move(prepared->nodes), assignment, prepared->plan, handlers_for(link));
  CLEW_RETURN_IF_ERROR(open_stages(host, assignment, participant, inside, barrier));
  SuccessionWorker succession(host.stages(), prepared->reader, prepared->last, stages, make,
                              say(link, FrameType::kFatal));
  alive.emplace([&] {
    link.post(FrameType::kAlive,
              Alive{host.is_stepping() || succession.is_busy(),
                    host.processor_ns() + succession.processor_ns(), host.step_times()});
  });
  report_missing(barrier);
  const bool brings_to_rest = assignment.pace == Pace::kRealtime && host.starts_ticks();
  if (brings_to_rest) outlive_supervisor_for_a_moment();
  const bool orderly = ComponentLoop(link, host, succession, brings_to_rest).run();
  robots.stand_still();
  alive.reset();  // it looks at the worker
  return orderly;
}

// Says what it waits for if that takes more than a moment.
Result<int> find_run(int domain, std::chrono::duration<double> patience) {
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(patience);
  auto socket = Link::connect(domain, std::min(deadline, Clock::now() + kSilence));
  if (socket.ok() || Clock::now() >= deadline) return socket;
  const auto wait = std::chrono::ceil<std::chrono::seconds>(deadline - Clock::now());
  logs::info("waiting up to {} s for a run on domain {}", wait.count(), domain);
  return Link::connect(domain, deadline);
}

int complain(const Error& error) {
  logs::error("{}", error.text());
  return 1;
}

}  // namespace

int run_component_process(const std::string& stage, const RunPlace& place,
                          const std::vector<runtime::StageInfo>& stages, const MeetRobots& meet) {
  const std::chrono::duration<double> patience(place.connect_timeout_s);
  const auto socket = place.line ? Result<int>(*place.line) : find_run(place.domain, patience);
  if (!socket.ok()) return complain(socket.error());
  Link link(*socket);
  const auto assignment = take_assignment(link, stage);
  if (!assignment.ok()) return complain(assignment.error());
  logs::debug("takes part in run {} on domain {}", assignment->run_id, assignment->domain);
  const auto ended = take_part(link, *assignment, stage, place.allowed, stages, meet);
  if (!ended.ok()) {
    link.post(FrameType::kFatal, Text{stage + ": " + ended.error().text()});
    link.flush_until(Clock::now() + kEndGrace);
    return complain(ended.error());
  }
  logs::debug(*ended ? "has ended with the run" : "has ended, since the run has gone");
  return *ended ? 0 : 1;
}

}  // namespace clew::bridge
