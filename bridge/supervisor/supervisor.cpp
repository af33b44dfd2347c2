// SPDX-License-Identifier: Apache-2.0
#include "supervisor/supervisor.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <utility>

#include "line/acceptor.hpp"
#include "line/domain_lock.hpp"
#include "recording/run_hash.hpp"
#include "run/limits.hpp"
#include "run/signal_queue.hpp"
#include "run/tick_rate.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/member.hpp"
#include "supervisor/recorder_client.hpp"
#include "supervisor/restart_policy.hpp"
#include "supervisor/shutdown.hpp"
#include "supervisor/third_party_observer.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Result;
using std::chrono::milliseconds;

class Supervisor {
 public:
  Supervisor(const runtime::RunPlan& plan, const ProcessLayout& layout, DomainLock hold,
             const std::optional<RecordingOrder>& recording, const ProgressDisplay& display,
             const ProcessStart& start)
      : plan_(plan),
        layout_(layout),
        domain_lock_(std::move(hold)),
        acceptor_(domain_lock_),
        display_(display),
        members_(list_members(plan, layout)),
        launcher_(plan, layout, domain_lock_.domain(), spooling_for(recording)),
        restart_policy_(members_, plan.graph),
        started_at_(Clock::now()),
        credit_(start.next_tick + kLead) {
    for (Member& member : members_) member.begin(start);
    if (recording) {
      path_ = recording->path;
      recorder_.emplace(*recording, launcher_.recorder_command(), layout.pace == Pace::kRealtime);
    }
  }

  RunReport run() {
    start_members();
    while (!over()) {
      wait_for_something();
      if (const int number = signals_.take()) {
        report_.interrupted_by = number;
        abort("interrupted by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")");
      }
      for (auto& [link, hello] : acceptor_.arrivals()) welcome(std::move(link), hello);
      for (Member& member : members_) serve(member);
      if (observer_) observe();
      if (recorder_) serve_recorder();
      watch();
    }
    end_processes(members_, all_finished_);
    if (recorder_) finish_recording();
    return finish_report();
  }

 private:
  bool over() const { return !report_.aborted.empty() || all_finished_; }

  void abort(const std::string& why) {
    if (report_.aborted.empty()) report_.aborted = why;
  }

  static void log(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) std::fprintf(stderr, "clew: %s\n", line.c_str());
  }

  // ---- start ----

  void start_members() {
    if (recorder_) {
      const auto started = recorder_->start(started_at_);
      if (!started.ok()) return abort(started.error().text());
    }
    for (Member& member : members_) {
      member.external ? log({launcher_.how_to_start(member)}) : start_child(member);
    }
    auto observer =
        ThirdPartyObserver::create(plan_, launcher_.assignment_for("observer", layout_.middleware));
    if (!observer.ok()) return abort(observer.error().text());
    observer_ = std::move(observer).value();
  }

  void start_child(Member& member) {
    const auto started = launcher_.start(member);
    if (!started.ok()) abort(started.error().text());
  }

  void welcome(std::unique_ptr<Link> link, const Hello& hello) {
    if (recorder_ && hello.stage == kRecorderName) {
      return recorder_->welcome(std::move(link), Clock::now());
    }
    const auto admitted = launcher_.admit(hello, members_);
    if (!admitted.ok()) {
      link->send(FrameType::kNotice, Text{admitted.error().text()});
      return abort(admitted.error().text());
    }
    Member* member = *admitted;
    if (member == nullptr) {
      link->send(FrameType::kNotice, Text{"this run has no place for a component " + hello.stage});
      return;
    }
    Assignment assignment = launcher_.assignment_for(*member);
    assignment.resumes = gone_;
    link->send(FrameType::kAssignment, assignment);
    if (member->starts_ticks) link->send(FrameType::kCredit, Tick{credit_});
    if (last_tick_) link->send(FrameType::kFinish, Tick{*last_tick_});
    member->joined_at = Clock::now();
    member->heard_at = member->joined_at;
    member->link = std::move(link);
  }

  // ---- while it runs ----

  void wait_for_something() {
    std::vector<pollfd> descriptors = {{signals_.descriptor(), POLLIN, 0}};
    for (const int socket : acceptor_.sockets()) descriptors.push_back({socket, POLLIN, 0});
    for (const Member& member : members_) {
      if (member.link) descriptors.push_back({member.link->socket(), POLLIN, 0});
    }
    if (recorder_) {
      if (const auto descriptor = recorder_->descriptor()) descriptors.push_back(*descriptor);
    }
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kPollPeriod.count()));
  }

  void serve(Member& member) {
    if (member.link) {
      const bool open = member.link->receive();
      while (auto frame = member.link->next()) handle(member, *std::move(frame));
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
                                    : restart_policy_.take(member, Clock::now());
    if (!why_not.empty()) return abort(what + why_not);
    log({what + "; restarting it"});
    ++report_.restarts;
  }

  void handle(Member& member, Frame frame) {
    member.heard_at = Clock::now();
    member.note(frame, member.heard_at);
    switch (frame.type) {
      case FrameType::kProgress:
        if (const auto progress = frame.as<Progress>()) note_progress(member, *progress);
        break;
      case FrameType::kSamples:
        // Its progress was reported before: all of this is older.
        if (recorder_) recorder_->add(std::move(frame.payload), member.progress.ticks);
        break;
      case FrameType::kNotice:
      case FrameType::kFatal:
        if (const auto text = frame.as<Text>()) {
          frame.type == FrameType::kFatal ? abort(text->text) : log({text->text});
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
    if (!member.starts_ticks || !progress.statistics.truth) return;
    rate_.note(progress.statistics.truth->tick, Clock::now());
    if (progress.statistics.truth->outcome != domain::Outcome::kRunning && !last_tick_) {
      last_tick_ = progress.statistics.truth->tick;
      for (Member& other : members_) {
        if (other.link) other.link->send(FrameType::kFinish, Tick{*last_tick_});
      }
    }
  }

  void observe() {
    observer_->poll();
    log(observer_->take_notices());
    if (const auto fatal = observer_->fatal()) abort(*fatal);
    std::string spool = observer_->take_spooled();
    if (recorder_) recorder_->add(std::move(spool), observer_->ticks());
  }

  void serve_recorder() {
    recorder_->serve(Clock::now());
    log(recorder_->take_lines());
    // Nothing can go on before it has read again what was there.
    if (!recorder_->ready()) stalled_since_ = Clock::now();
    if (!recorder_->account() || told_of_recording_) return;
    told_of_recording_ = true;
    const std::string what = complaint(*recorder_->account());
    if (what.empty()) return;
    layout_.on_record_error == OnRecordError::kStop ? abort(what) : log({what});
  }

  void watch() {
    const auto now = Clock::now();
    if (!gone_) {
      if (everybody_ready()) {
        go(now);
      } else if (now - started_at_ > launcher_.start_timeout()) {
        abort_start();
      }
    } else if (now - stalled_since_ > stall_timeout()) {
      abort("no tick was completed for 10 s; ticks done:" + ticks_text(members_) +
            (observer_ ? observer_->ticks_text() : ""));
    }
    if (!launcher_.patient()) {
      log(restart_policy_.kill_frozen(now));
      if (layout_.pace != Pace::kRealtime) log(restart_policy_.kill_lonely(now));
    }
    for (Member* member : restart_policy_.due(now)) start_child(*member);
    give_credit();
    if (last_tick_ && everybody_finished()) all_finished_ = true;
    if (display_ && gone_ && now - displayed_at_ >= kDisplayPeriod) {
      displayed_at_ = now;
      display_(statistics(), rate_.per_s());
    }
  }

  void abort_start() {
    std::vector<std::string> missing;
    if (observer_) missing = observer_->missing();
    if (recorder_ && !recorder_->ready()) missing.push_back("the recorder has not reported");
    abort(fmt::format("not everybody was there within {} s:{}", plan_.graph.start_timeout_s,
                      missing_text(members_, missing)));
  }

  Clock::duration stall_timeout() const {
    if (launcher_.patient()) return launcher_.start_timeout();
    const double tick_s =
        layout_.pace == Pace::kLockstep ? 0.0 : plan_.graph.tick_s / layout_.pace_factor;
    return kStallTimeout +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(2.0 * tick_s));
  }

  bool everybody_ready() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const Member& m) { return m.third_party || m.ready; }) &&
           (!observer_ || observer_->ready()) && (!recorder_ || recorder_->ready());
  }
  bool everybody_finished() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const Member& m) { return m.third_party || m.finished; }) &&
           (!observer_ || observer_->finished(*last_tick_));
  }

  void go(Clock::time_point now) {
    gone_ = true;
    stalled_since_ = now;
    for (Member& member : members_) {
      if (member.starts_ticks && member.link) member.link->send(FrameType::kGo, Tick{0});
    }
  }

  // The stage that starts ticks does not run away from the slowest member, so that histories hold
  // what anybody may need, nor from the recorder.
  void give_credit() {
    std::uint64_t done = UINT64_MAX;
    for (const Member& member : members_) {
      if (!member.third_party) done = std::min(done, member.progress.ticks);
    }
    if (observer_) done = std::min(done, observer_->ticks());
    std::uint64_t credit = done + kLead;
    if (recorder_) credit = std::min(credit, recorder_->credit());
    if (credit < credit_ + kLead / 4) return;
    credit_ = credit;
    for (Member& member : members_) {
      if (member.starts_ticks && member.link) member.link->send(FrameType::kCredit, Tick{credit});
    }
  }

  // ---- end ----

  // It may still die and come back. A second signal ends the patience with it.
  void finish_recording() {
    recorder_->end(report_.aborted);
    while (!recorder_->account() && signals_.take() == 0) {
      wait_for_something();
      for (auto& [link, hello] : acceptor_.arrivals()) welcome(std::move(link), hello);
      serve_recorder();
    }
    report_.recording = recorder_->account().value_or(
        RecordingAccount{"the recorder did not end in time", {}, 0, false});
    report_.restarts += recorder_->restarts();
    if (!report_.recording->failure.empty() || report_.recording->nothing) return;
    const auto named = mcap::OutputFile::give_name(path_);
    if (!named.ok()) report_.recording->failure = named.error().text();
  }

  RunStatistics statistics() const {
    RunStatistics total = total_statistics(members_);
    if (observer_) total.merge(observer_->statistics());
    return total;
  }

  RunReport finish_report() {
    report_.statistics = statistics();
    report_.ticks_per_s = rate_.per_s();
    report_.wall_s = std::chrono::duration<double>(Clock::now() - started_at_).count();
    auto chains = all_chains(members_);
    report_.refused_samples = total_refused_samples(members_);
    if (observer_) {
      // What it refuses its readers do, too, but the run may be over before they have said so.
      report_.refused_samples = std::max(report_.refused_samples, observer_->refused_samples());
      if (report_.aborted.empty()) chains.merge(observer_->chains());
    }
    if (layout_.hash && report_.aborted.empty()) report_.hash = run_hash(chains);
    return report_;
  }

  const runtime::RunPlan& plan_;
  const ProcessLayout& layout_;
  DomainLock domain_lock_;
  Acceptor acceptor_;
  const ProgressDisplay& display_;
  SignalQueue signals_;
  std::vector<Member> members_;
  Launcher launcher_;
  RestartPolicy restart_policy_;
  std::optional<RecorderClient> recorder_;
  std::string path_;  ///< of the recording
  bool told_of_recording_ = false;
  std::unique_ptr<ThirdPartyObserver> observer_;
  RunReport report_;
  const Clock::time_point started_at_;
  TickRate rate_;
  bool gone_ = false;
  bool all_finished_ = false;
  std::uint64_t credit_;
  std::optional<std::uint64_t> last_tick_;
  Clock::time_point stalled_since_{};
  Clock::time_point displayed_at_{};
};

}  // namespace

Result<RunReport> run_processes(const runtime::RunPlan& plan, const ProcessLayout& layout,
                                const std::optional<RecordingOrder>& recording,
                                const ProgressDisplay& display, const ProcessStart& start) {
  auto hold = DomainLock::take(layout.domain);
  if (!hold.ok()) return hold.error();
  return Supervisor(plan, layout, std::move(hold).value(), recording, display, start).run();
}

}  // namespace clew::bridge
