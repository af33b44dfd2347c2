// SPDX-License-Identifier: Apache-2.0
#include "process/supervisor.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <utility>

#include "process/domain_hold.hpp"
#include "process/foreign_observer.hpp"
#include "process/reception.hpp"
#include "process/restarts.hpp"
#include "process/run_members.hpp"
#include "process/signal_queue.hpp"
#include "process/tick_rate.hpp"
#include "recording/run_hash.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;
using runtime::GraphStage;
using std::chrono::milliseconds;

constexpr std::uint32_t kHistoryDepth = 512;
// How far the stage that starts ticks may be ahead of the slowest member and of the recording.
constexpr std::uint32_t kLead = kHistoryDepth / 4;
constexpr auto kPollPeriod = milliseconds(20);
constexpr auto kDisplayPeriod = milliseconds(100);
// No tick for so long means that a component is stuck.
constexpr auto kStallTimeout = std::chrono::seconds(10);
// A person at a debugger may take his time.
constexpr auto kPatience = std::chrono::hours(1);
constexpr double kPatientLease_s = 3600.0;

class Supervisor {
 public:
  Supervisor(const runtime::RunPlan& plan, const ProcessLayout& layout, DomainHold hold,
             SampleSink* recording, const ProgressDisplay& display)
      : plan_(plan),
        layout_(layout),
        hold_(std::move(hold)),
        reception_(hold_),
        recording_(recording),
        display_(display),
        members_(list_members(plan, layout)),
        restarts_(members_, plan.graph),
        started_at_(Clock::now()),
        patient_(!layout.external.empty() || !layout.prefix.empty()) {
    run_id_ = std::to_string(::getpid()) + '-' + std::to_string(hold_.domain());
  }

  RunReport run() {
    start_members();
    while (!over()) {
      wait_for_something();
      if (const int number = signals_.take()) {
        report_.interrupted_by = number;
        abort("interrupted by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")");
      }
      for (auto& [link, hello] : reception_.arrivals()) welcome(std::move(link), hello);
      for (Member& member : members_) serve(member);
      if (observer_) observe();
      watch();
    }
    end_processes(members_, all_finished_);
    return finish_report();
  }

 private:
  bool over() const { return !report_.aborted.empty() || all_finished_; }

  void abort(const std::string& why) {
    if (report_.aborted.empty()) report_.aborted = why;
  }

  static void log(const std::string& line) { std::fprintf(stderr, "clew: %s\n", line.c_str()); }

  // ---- start ----

  void start_members() {
    for (Member& member : members_) {
      if (member.external) {
        log("waiting for " + member.stage + "; start it with: clew component " + plan_.graph.name +
            ' ' + member.stage + " --domain " + std::to_string(hold_.domain()));
        continue;
      }
      start_child(member);
    }
    auto observer = ForeignObserver::create(plan_, assignment_for("observer", layout_.middleware));
    if (!observer.ok()) return abort(observer.error().text());
    observer_ = std::move(observer).value();
  }

  void start_child(Member& member) {
    auto child = ChildProcess::start(
        command_of(member, *plan_.graph.find(member.stage), layout_, hold_.domain(), run_id_));
    if (!child.ok()) return abort(member.stage + ": " + child.error().text());
    member.child = std::move(child).value();
    member.down = false;
  }

  Assignment assignment_for(const std::string& stage, const std::string& middleware) const {
    Assignment assignment;
    assignment.run_id = run_id_;
    assignment.middleware = middleware;
    assignment.domain = hold_.domain();
    if (patient_) assignment.lease_s = kPatientLease_s;
    assignment.spool = recording_ != nullptr;
    assignment.history_depth = kHistoryDepth;
    assignment.lead = kLead;
    fill_assignment(plan_, layout_, stage, assignment);
    return assignment;
  }

  void welcome(std::unique_ptr<Link> link, const Hello& hello) {
    const auto member =
        std::find_if(members_.begin(), members_.end(), [&](const Member& candidate) {
          return candidate.stage == hello.stage && !candidate.foreign;
        });
    if (member == members_.end() || member->link != nullptr) {
      link->send(FrameType::kNotice, Text{"this run has no place for a component " + hello.stage});
      return;
    }
    if (hello.idl_fingerprint != idl_fingerprint()) {
      const std::string what = hello.stage + " (process " + std::to_string(hello.process_id) +
                               ") was built from other IDL files: its fingerprint is " +
                               hello.idl_fingerprint + ", that of the run is " +
                               std::string(idl_fingerprint());
      link->send(FrameType::kNotice, Text{what});
      return abort(what);
    }
    const GraphStage& stage = *plan_.graph.find(hello.stage);
    Assignment assignment = assignment_for(hello.stage, middleware_of(stage, layout_));
    if (gone_) {
      assignment.resumes = true;
      if (!member->checkpoints.empty()) assignment.checkpoint = member->checkpoints.back();
    }
    link->send(FrameType::kAssignment, assignment);
    if (member->starts_ticks) link->send(FrameType::kCredit, Tick{credit_});
    if (last_tick_) link->send(FrameType::kFinish, Tick{*last_tick_});
    member->heard_at = Clock::now();
    member->link = std::move(link);
  }

  // ---- while it runs ----

  void wait_for_something() {
    std::vector<pollfd> descriptors = {{signals_.descriptor(), POLLIN, 0}};
    for (const int socket : reception_.sockets()) descriptors.push_back({socket, POLLIN, 0});
    for (const Member& member : members_) {
      if (member.link) descriptors.push_back({member.link->socket(), POLLIN, 0});
    }
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kPollPeriod.count()));
  }

  void serve(Member& member) {
    if (member.link) {
      const bool open = member.link->receive();
      while (auto frame = member.link->next()) handle(member, *frame);
      if (!open) lose(member);
    } else if (member.child && !member.down && member.child->reap()) {
      lose(member);
    }
  }

  // The line broke: the process has died, or is dying; its end says more than the line's. What it
  // sent before was read before.
  void lose(Member& member) {
    member.link.reset();
    const auto deadline = Clock::now() + kEndGrace;
    while (member.child && member.child->running() && Clock::now() < deadline) {
      if (!member.child->reap()) ::poll(nullptr, 0, 1);
    }
    std::string what = member.stage;
    if (member.child && !member.child->running()) {
      what +=
          " (process " + std::to_string(member.child->process_id()) + ") " + member.child->end();
    } else {
      what += " has left the run";
    }
    member.ready = false;
    const std::string why_not = layout_.pace == Pace::kRealtime
                                    ? "; in real time it is not restarted"
                                    : restarts_.take(member, Clock::now());
    if (!why_not.empty()) return abort(what + why_not);
    log(what + "; restarting it");
    ++report_.restarts;
  }

  void handle(Member& member, const Frame& frame) {
    member.heard_at = Clock::now();
    switch (frame.type) {
      case FrameType::kCheckpoint:
        if (auto checkpoint = frame.as<Checkpoint>()) member.keep(*std::move(checkpoint));
        break;
      case FrameType::kWaiting:
        if (const auto waiting = frame.as<Waiting>()) {
          member.missing = waiting->missing;
          member.ready = waiting->missing.empty();
        }
        break;
      case FrameType::kProgress:
        if (const auto progress = frame.as<Progress>()) note_progress(member, *progress);
        break;
      case FrameType::kSamples:
        record(frame.payload);
        break;
      case FrameType::kFinished:
        member.finished = frame.as<Finished>();
        break;
      case FrameType::kNotice:
      case FrameType::kFatal:
        if (const auto text = frame.as<Text>()) {
          frame.type == FrameType::kFatal ? abort(text->text) : log(text->text);
        }
        break;
      default:
        break;
    }
  }

  void note_progress(Member& member, const Progress& progress) {
    if (progress.ticks > member.progress.ticks) stalled_since_ = Clock::now();
    member.progress = progress;
    if (progress.ticks >= member.lost_at) member.catching_up = false;
    if (!member.starts_ticks || !progress.tally.truth) return;
    rate_.note(progress.tally.truth->tick, Clock::now());
    if (progress.tally.truth->outcome != domain::Outcome::kRunning && !last_tick_) {
      last_tick_ = progress.tally.truth->tick;
      for (Member& other : members_) {
        if (other.link) other.link->send(FrameType::kFinish, Tick{*last_tick_});
      }
    }
  }

  void record(const std::string& spool) {
    if (recording_ == nullptr) return;
    const bool whole = for_each_spooled(spool, [this](const SpooledSample& sample) {
      // A component that was restarted writes again what it wrote after its checkpoint.
      std::uint64_t& next = recorded_[static_cast<std::size_t>(sample.topic)];
      if (sample.tick < next) return;
      next = sample.tick + 1;
      const auto added = recording_->add(sample);
      if (!added.ok()) abort(added.error().text());
    });
    if (!whole) abort("a component sent a damaged spool");
  }

  void observe() {
    observer_->poll();
    for (const std::string& line : observer_->take_notices()) log(line);
    if (const auto fatal = observer_->fatal()) abort(*fatal);
    record(observer_->take_spooled());
  }

  void watch() {
    const auto now = Clock::now();
    if (!gone_) {
      if (everybody_ready()) {
        go(now);
      } else if (now - started_at_ > start_timeout()) {
        abort(
            "not everybody was there within " +
            std::to_string(static_cast<int>(plan_.graph.start_timeout_s)) + " s:" +
            missing_text(members_, observer_ ? observer_->missing() : std::vector<std::string>{}));
      }
    } else if (!last_tick_ && now - stalled_since_ > stall_timeout()) {
      abort("no tick was completed for 10 s; ticks done:" + ticks_text(members_));
    }
    if (!patient_) {
      for (const std::string& line : restarts_.kill_frozen(now)) log(line);
    }
    for (Member* member : restarts_.due(now)) start_child(*member);
    give_credit();
    if (last_tick_ && everybody_finished()) all_finished_ = true;
    if (display_ && gone_ && now - displayed_at_ >= kDisplayPeriod) {
      displayed_at_ = now;
      display_(tally(), rate_.per_s());
    }
  }

  Clock::duration start_timeout() const {
    if (patient_) return kPatience;
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(plan_.graph.start_timeout_s));
  }
  Clock::duration stall_timeout() const {
    if (patient_) return kPatience;
    const double tick_s =
        layout_.pace == Pace::kLockstep ? 0.0 : plan_.graph.tick_s / layout_.pace_factor;
    return kStallTimeout +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(2.0 * tick_s));
  }

  bool everybody_ready() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const Member& m) { return m.foreign || m.ready; }) &&
           (!observer_ || observer_->ready());
  }
  bool everybody_finished() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const Member& m) { return m.foreign || m.finished; }) &&
           (!observer_ || observer_->finished(*last_tick_));
  }

  void go(Clock::time_point now) {
    gone_ = true;
    stalled_since_ = now;
    for (Member& member : members_) {
      if (member.starts_ticks && member.link) member.link->send(FrameType::kGo, Tick{0});
    }
  }

  // The stage that starts ticks does not run away from the slowest member and the recording, so
  // that histories hold what anybody may need.
  void give_credit() {
    std::uint64_t done = UINT64_MAX;
    for (const Member& member : members_) {
      if (!member.foreign) done = std::min(done, member.progress.ticks);
    }
    if (observer_) done = std::min(done, observer_->ticks());
    if (recording_ != nullptr) done = std::min(done, recording_->complete_ticks());
    const std::uint64_t credit = done + kLead;
    if (credit < credit_ + kLead / 4) return;
    credit_ = credit;
    for (Member& member : members_) {
      if (member.starts_ticks && member.link) member.link->send(FrameType::kCredit, Tick{credit});
    }
  }

  // ---- end ----

  RunTally tally() const {
    RunTally total = total_tally(members_);
    if (observer_) total.merge(observer_->tally());
    return total;
  }

  RunReport finish_report() {
    report_.tally = tally();
    report_.ticks_per_s = rate_.per_s();
    report_.wall_s = std::chrono::duration<double>(Clock::now() - started_at_).count();
    std::map<std::string, core::Hash128> chains;
    for (const Member& member : members_) {
      if (!member.finished) continue;
      chains.insert(member.finished->chains.begin(), member.finished->chains.end());
      report_.refused_samples += member.finished->refused_samples;
    }
    if (observer_ && report_.aborted.empty()) {
      const auto foreign = observer_->chains();
      chains.insert(foreign.begin(), foreign.end());
    }
    if (layout_.hash && report_.aborted.empty()) report_.hash = run_hash(chains);
    return report_;
  }

  const runtime::RunPlan& plan_;
  const ProcessLayout& layout_;
  DomainHold hold_;
  Reception reception_;
  SampleSink* recording_;
  const ProgressDisplay& display_;
  SignalQueue signals_;
  std::vector<Member> members_;
  Restarts restarts_;
  std::unique_ptr<ForeignObserver> observer_;
  std::string run_id_;
  RunReport report_;
  const Clock::time_point started_at_;
  const bool patient_;
  std::array<std::uint64_t, domain::kTopicCount> recorded_{};  // the next tick of each topic
  TickRate rate_;
  bool gone_ = false;
  bool all_finished_ = false;
  std::uint64_t credit_ = kLead;
  std::optional<std::uint64_t> last_tick_;
  Clock::time_point stalled_since_{};
  Clock::time_point displayed_at_{};
};

}  // namespace

Result<RunReport> run_processes(const runtime::RunPlan& plan, const ProcessLayout& layout,
                                SampleSink* recording, const ProgressDisplay& display) {
  auto hold = DomainHold::take(layout.domain);
  if (!hold.ok()) return hold.error();
  return Supervisor(plan, layout, std::move(hold).value(), recording, display).run();
}

}  // namespace clew::bridge
