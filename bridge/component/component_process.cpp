// SPDX-License-Identifier: Apache-2.0
#include "component/component_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "component/node_host.hpp"
#include "component/start_barrier.hpp"
#include "line/heartbeat.hpp"
#include "line/link.hpp"
#include "run/limits.hpp"
#include "vendors/participant_factory.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;

Result<Frame> receive_frame(Link& link, Clock::time_point deadline) {
  while (true) {
    if (auto frame = link.next()) return *std::move(frame);
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd descriptor{link.socket(), POLLIN, 0};
    if (left.count() <= 0 || ::poll(&descriptor, 1, static_cast<int>(left.count())) == 0) {
      return Error{"the supervisor does not answer", {}, 0, 0};
    }
    if (!link.receive()) return Error{"the supervisor has gone", {}, 0, 0};
  }
}

// The run is over for this component when its supervisor says so, or is gone.
class ComponentLoop {
 public:
  ComponentLoop(Link& link, NodeHost& host) : link_(link), host_(host) {}

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
      if (!link_.receive()) return finished_;
      while (auto frame = link_.next()) handle(*frame);
    }
  }

 private:
  void wait() {
    auto until = next_flush_;
    if (const auto due = host_.next_due()) until = std::min(until, *due);
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - Clock::now());
    timespec timeout{0, std::max<std::int64_t>(left.count(), 0)};
    pollfd descriptor{link_.socket(), POLLIN, 0};
    ::ppoll(&descriptor, 1, &timeout, nullptr);
  }

  void handle(const Frame& frame) {
    if (frame.type == FrameType::kGo) host_.go(Clock::now());
    if (frame.type == FrameType::kCredit) {
      if (const auto credit = frame.as<Tick>()) host_.allow_until(credit->tick);
    }
    if (frame.type == FrameType::kFinish) {
      if (const auto last = frame.as<Tick>()) finish_at_ = last->tick;
    }
  }

  void try_to_finish() {
    auto finished = host_.finished(*finish_at_);
    if (!finished) return;
    host_.flush();
    finished_ = link_.send(FrameType::kFinished, std::move(*finished));
  }

  Link& link_;
  NodeHost& host_;
  std::optional<std::uint64_t> finish_at_;
  bool finished_ = false;
  Clock::time_point next_flush_{};
};

Result<Assignment> take_assignment(Link& link, const std::string& stage) {
  link.send(FrameType::kHello, Hello{stage, ::getpid(), std::string(idl_fingerprint())});
  const auto frame = receive_frame(link, Clock::now() + kAssignmentTimeout);
  if (!frame.ok()) return frame.error();
  if (frame->type == FrameType::kNotice) {
    const auto text = frame->as<Text>();
    return Error{text ? text->text : "the supervisor refused", {}, 0, 0};
  }
  auto assignment = frame->as<Assignment>();
  if (frame->type != FrameType::kAssignment || !assignment) {
    return Error{"the supervisor speaks another version of clew", {}, 0, 0};
  }
  return *std::move(assignment);
}

// Before any thread is started that is to have it, too.
Result<void> take_realtime_priority(int priority) {
  const sched_param parameters{priority};
  if (priority == 0 || ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0) return {};
  return Error{fmt::format("real-time priority {}: {}; 'ulimit -r' tells what is allowed", priority,
                           std::strerror(errno)),
               {},
               0,
               0};
}

struct Prepared {
  runtime::Node node;
  runtime::RunPlan plan;
};

Result<Prepared> prepare(Link& link, const Assignment& assignment, const std::string& stage,
                         const std::vector<runtime::StageInfo>& stages) {
  const Heartbeat alive(link, stage + " still makes its component");
  auto plan = runtime::read_prepared_run(assignment.bundle, stages, stage);
  if (!plan.ok()) return plan.error();
  const runtime::GraphStage* graph_stage = plan->graph.find(stage);
  if (graph_stage == nullptr) return Error{"the run's graph has no stage " + stage, {}, 0, 0};
  auto node = runtime::make_node(*plan, *graph_stage);
  if (!node.ok()) return node.error();
  return Prepared{std::move(node).value(), std::move(plan).value()};
}

Result<bool> take_part(Link& link, const Assignment& assignment, const std::string& stage,
                       const std::vector<runtime::StageInfo>& stages) {
  auto prepared = prepare(link, assignment, stage, stages);
  if (!prepared.ok()) return prepared.error();
  CLEW_RETURN_IF_ERROR(take_realtime_priority(assignment.realtime_priority));

  const auto say = [&link](FrameType type) {
    return [&link, type](std::string text) { link.send(type, Text{std::move(text)}); };
  };
  std::mutex reporting;  // the last report sent is the newest
  const auto report_missing = [&](const StartBarrier& barrier) {
    const std::lock_guard<std::mutex> lock(reporting);
    link.send(FrameType::kWaiting, Waiting{barrier.missing()});
  };
  StartBarrier barrier(
      stage, assignment.expected,
      {[&] { report_missing(barrier); }, say(FrameType::kNotice), say(FrameType::kFatal)});
  const auto vendor = vendor_from_name(assignment.middleware);
  if (!vendor) return Error{"unknown middleware '" + assignment.middleware + "'", {}, 0, 0};
  auto participant =
      create_participant(*vendor, {assignment.domain, stage, assignment.lease_s}, barrier);
  if (!participant.ok()) return participant.error();
  NodeHost host(
      std::move(prepared->node), assignment, prepared->plan,
      {say(FrameType::kNotice), say(FrameType::kFatal),
       [&link](const Progress& progress) { link.send(FrameType::kProgress, progress); },
       [&link](const Checkpoint& checkpoint) { link.send(FrameType::kCheckpoint, checkpoint); },
       [&link](const std::string& spool) { link.send_bytes(FrameType::kSamples, spool); }});
  if (assignment.checkpoint) CLEW_RETURN_IF_ERROR(host.restore(*assignment.checkpoint));
  CLEW_RETURN_IF_ERROR(host.open(**participant, barrier));
  if (assignment.checkpoint) host.repeat_last_outputs(*assignment.checkpoint);
  if (assignment.resumes) host.go(Clock::now());
  report_missing(barrier);
  return ComponentLoop(link, host).run();
}

// Says what it waits for if that takes more than a moment.
Result<int> find_run(const std::string& stage, int domain, Clock::duration patience) {
  const auto deadline = Clock::now() + patience;
  auto socket = Link::connect(domain, std::min(deadline, Clock::now() + kSilence));
  if (socket.ok() || Clock::now() >= deadline) return socket;
  const auto wait = std::chrono::ceil<std::chrono::seconds>(deadline - Clock::now());
  std::fprintf(stderr, "clew component %s: waiting up to %d s for a run on domain %d\n",
               stage.c_str(), static_cast<int>(wait.count()), domain);
  return Link::connect(domain, deadline);
}

int complain(const std::string& stage, const Error& error) {
  std::fprintf(stderr, "clew component %s: %s\n", stage.c_str(), error.text().c_str());
  return 1;
}

}  // namespace

int run_component_process(const std::string& stage, int domain, double connect_timeout_s,
                          const std::vector<runtime::StageInfo>& stages) {
  const auto patience = std::chrono::duration<double>(connect_timeout_s);
  const auto socket =
      find_run(stage, domain, std::chrono::duration_cast<Clock::duration>(patience));
  if (!socket.ok()) return complain(stage, socket.error());
  Link link(*socket);
  const auto assignment = take_assignment(link, stage);
  if (!assignment.ok()) return complain(stage, assignment.error());
  const auto ended = take_part(link, *assignment, stage, stages);
  if (!ended.ok()) {
    link.send(FrameType::kFatal, Text{stage + ": " + ended.error().text()});
    return complain(stage, ended.error());
  }
  return *ended ? 0 : 1;
}

}  // namespace clew::bridge
