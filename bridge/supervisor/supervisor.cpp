// SPDX-License-Identifier: Apache-2.0
#include "supervisor/supervisor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "recorder/recorder_process.hpp"
#include "recording/run_hash.hpp"
#include "run/limits.hpp"
#include "supervisor/shutdown.hpp"

namespace clew::bridge {

using Clock = std::chrono::steady_clock;

Supervisor::Supervisor(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain,
                       const std::optional<RecordingOrder>& recording, const ProcessStart& start,
                       Outside outside, Time now)
    : plan_(plan),
      layout_(layout),
      outside_(std::move(outside)),
      members_(list_members(plan, layout)),
      launcher_(plan, layout, domain, spooling_for(recording, outside_.watch != nullptr),
                outside_.start),
      restart_policy_(members_, plan.graph),
      started_at_(now),
      credit_(start.next_tick + kLead) {
  for (Member& member : members_) member.begin(start);
  if (const auto found = start.checkpoints.find(kObserverName); found != start.checkpoints.end()) {
    observed_before_ = found->second;
  }
  const bool drops = layout.pace == Pace::kRealtime || keeps_own_pace(members_);
  if (!recording) return;
  recording_.emplace(*recording, launcher_.recorder_command(), layout.on_record_error, drops);
  recording_->add(start.spooled, start.next_tick);
}

void Supervisor::abort(const std::string& why) {
  if (report_.aborted.empty()) report_.aborted = why;
}

void Supervisor::log(const std::vector<std::string>& lines) const {
  for (const std::string& line : lines) outside_.log(line);
}

// ---- start ----

void Supervisor::start() {
  if (recording_) {
    const auto started = recording_->start(started_at_);
    if (!started.ok()) return abort(started.error().text());
  }
  for (Member& member : members_) {
    if (member.external) {
      log({launcher_.how_to_start(member)});
    } else {
      start_child(member);
    }
  }
  Assignment assignment = launcher_.assignment_for(kObserverName, layout_.middleware);
  assignment.checkpoint = std::move(observed_before_);
  auto observer = ThirdPartyObserver::create(plan_, std::move(assignment));
  if (!observer.ok()) return abort(observer.error().text());
  observer_ = std::move(observer).value();
}

void Supervisor::start_child(Member& member) {
  const auto started = launcher_.start(member);
  if (!started.ok()) abort(started.error().text());
}

// It reads why as soon as it can; if it never does, nothing is lost.
void Supervisor::refuse(Link& link, const std::string& why) const {
  link.post(FrameType::kNotice, Text{why});
}

void Supervisor::welcome(std::unique_ptr<Link> link, const Hello& hello, Time now) {
  if (recording_ && hello.stage == kRecorderName) return recording_->welcome(std::move(link), now);
  const auto admitted = launcher_.admit(hello, members_);
  if (!admitted.ok()) {
    refuse(*link, admitted.error().text());
    Member* const place = find_member(members_, hello.stage);
    // Another one of our own program would be no better; a person may come with a newer one.
    if (place != nullptr && place->child) return abort(admitted.error().text());
    return log({admitted.error().text()});
  }
  Member* member = *admitted;
  if (member == nullptr) {
    return refuse(*link, "this run has no place for a component " + hello.stage);
  }
  Assignment assignment = launcher_.assignment_for(*member);
  assignment.resumes = gone_;
  link->post(FrameType::kAssignment, std::move(assignment));
  if (member->starts_ticks) link->post(FrameType::kCredit, Tick{credit_});
  if (last_tick_) link->post(FrameType::kFinish, Tick{*last_tick_});
  member->joined_at = now;
  member->heard_at = now;
  member->link = std::move(link);
}

// ---- while it runs ----

std::vector<pollfd> Supervisor::descriptors() const {
  std::vector<pollfd> descriptors;
  for (const Member& member : members_) {
    if (member.link) {
      descriptors.push_back({member.link->socket(), member.link->poll_events(), 0});
    }
  }
  if (recording_) {
    if (const auto descriptor = recording_->descriptor()) descriptors.push_back(*descriptor);
  }
  return descriptors;
}

void Supervisor::turn(Time now) {
  for (Member& member : members_) serve(member, now);
  if (observer_) observe(now);
  turn_recording(now);
  watch(now);
}

void Supervisor::interrupt(int number) {
  report_.interrupted_by = number;
  abort("interrupted by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")");
}

void Supervisor::serve(Member& member, Time now) {
  if (member.link) {
    member.link->flush();
    const bool open = member.link->receive();
    while (auto frame = member.link->next()) handle(member, *std::move(frame), now);
    if (!open) {
      member.link.reset();
      member.ready = false;
      member.left_at = now;
    }
  }
  if (!member.link && !member.down && has_ended(member, now)) lose(member, now);
}

// The line broke: the process has died, or is dying, and its end says more than the line's.
bool Supervisor::has_ended(Member& member, Time now) {
  if (member.child) {
    member.child->reap();
    if (!member.child->running()) return true;
  }
  return member.left_at && (!member.child || now - *member.left_at >= kEndGrace);
}

void Supervisor::lose(Member& member, Time now) {
  std::string what = member.stage;
  if (member.child && !member.child->running()) {
    what += " (process " + std::to_string(member.child->process_id()) + ") " + member.child->end();
  } else {
    what += " has left the run";
    if (member.child) member.child->signal(SIGKILL);
  }
  member.left_at.reset();
  member.ready = false;
  member.busy = false;
  const std::string why_not = layout_.pace == Pace::kRealtime ? "; in real time it is not restarted"
                                                              : restart_policy_.take(member, now);
  if (!why_not.empty()) return abort(what + why_not);
  log({what + "; restarting it"});
  ++report_.restarts;
}

void Supervisor::handle(Member& member, Frame frame, Time now) {
  member.heard_at = now;
  member.note(frame, now);
  if (frame.type == FrameType::kProgress) {
    if (const auto progress = frame.as<Progress>()) note_progress(member, *progress, now);
  } else if (frame.type == FrameType::kSamples) {
    // Its progress was reported before: all of this is older.
    hand_on(std::move(frame.payload), member.progress.ticks);
  } else if (frame.type == FrameType::kNotice) {
    if (const auto text = frame.as<Text>()) log({text->text});
  } else if (frame.type == FrameType::kFatal) {
    if (const auto text = frame.as<Text>()) abort(text->text);
  }
}

void Supervisor::note_progress(Member& member, const Progress& progress, Time now) {
  if (progress.ticks > member.progress.ticks) stalled_since_ = now;
  member.progress = progress;
  if (progress.ticks >= member.lost_at) member.catching_up = false;
  if (member.starts_ticks) note_truth(progress.statistics, now);
}

void Supervisor::note_truth(const RunStatistics& statistics, Time now) {
  if (!statistics.truth) return;
  rate_.note(statistics.truth->tick, now);
  if (statistics.truth->outcome == domain::Outcome::kRunning || last_tick_) return;
  last_tick_ = statistics.truth->tick;
  for (Member& other : members_) {
    if (other.link) other.link->post(FrameType::kFinish, Tick{*last_tick_});
  }
}

/// What a third party's line would tell.
void Supervisor::note_observed(Time now) {
  for (Member& member : members_) {
    if (!member.third_party) continue;
    if (observer_->ticks() > member.progress.ticks) stalled_since_ = now;
    member.progress.ticks = observer_->ticks();
    if (!member.starts_ticks) continue;
    note_truth(observer_->statistics(), now);
    if (!last_tick_ && observer_->ticks() > plan_.graph.max_ticks + 1) {
      abort(fmt::format("{} has no outcome after tick {}, which is max_ticks", member.stage,
                        plan_.graph.max_ticks));
    }
  }
}

void Supervisor::observe(Time now) {
  const auto fatal = observer_->fatal();
  observer_->poll();
  log(observer_->take_notices());
  if (fatal) abort(*fatal);
  hand_on(observer_->take_spooled(), observer_->ticks());
  note_observed(now);
}

void Supervisor::turn_recording(Time now) {
  if (!recording_) return;
  recording_->serve(now);
  log(recording_->take_lines());
  // Nothing can go on before it has read again what was there.
  if (!recording_->ready()) stalled_since_ = now;
  if (!recording_->failure().empty()) abort(recording_->failure());
}

void Supervisor::watch(Time now) {
  if (gone_) {
    watch_stall(now);
  } else {
    watch_start(now);
  }
  if (!launcher_.patient()) {
    const bool realtime = layout_.pace == Pace::kRealtime;
    log(restart_policy_.kill_frozen(now, realtime ? kRealtimeFrozenAfter : kFrozenAfter));
    if (!realtime) log(restart_policy_.kill_lonely(now));
  }
  for (Member* member : restart_policy_.due(now)) start_child(*member);
  give_credit();
  if (last_tick_ && everybody_finished()) all_finished_ = true;
  if (outside_.display && gone_ && now - displayed_at_ >= kDisplayPeriod) {
    displayed_at_ = now;
    outside_.display(statistics(), rate_.per_s());
  }
}

void Supervisor::watch_start(Time now) {
  if (everybody_ready()) {
    go(now);
  } else if (now - started_at_ > launcher_.start_timeout()) {
    abort_start();
  }
}

// Everybody reports, and nothing goes on: something was lost between them. The components go back
// together, since each that is known to the others only by half is then new to all. If that does
// not help at the same tick, nothing will.
void Supervisor::watch_stall(Time now) {
  const auto stalled = now - stalled_since_;
  if (stalled > stall_timeout()) {
    return abort(fmt::format(
        "no tick was completed for {} s; ticks done:{}",
        std::chrono::duration_cast<std::chrono::seconds>(stall_timeout()).count(), ticks_done()));
  }
  std::uint64_t started = 0;
  for (const Member& member : members_) {
    if (member.starts_ticks) started = member.progress.ticks;
  }
  if (stalled < kStallRestart || restarted_at_ == started || !may_restart_all()) return;
  log({fmt::format(
      "no tick was completed for {} s, though all report; restarting all; ticks done:{}",
      kStallRestart.count(), ticks_done())});
  restarted_at_ = started;
  stalled_since_ = now;
  for (const Member& member : members_) member.child->signal(SIGKILL);
}

bool Supervisor::may_restart_all() const {
  if (launcher_.patient() || layout_.pace == Pace::kRealtime) return false;
  return std::all_of(members_.begin(), members_.end(), [](const Member& member) {
    return member.child && member.link && !member.third_party && !member.busy;
  });
}

std::string Supervisor::ticks_done() const {
  return ticks_text(members_) + (observer_ ? observer_->ticks_text() : "");
}

void Supervisor::abort_start() {
  std::vector<std::string> missing;
  if (observer_) missing = observer_->missing();
  if (recording_ && !recording_->ready()) missing.push_back("the recorder has not reported");
  abort(fmt::format("startup timed out after {} s:{}", plan_.graph.start_timeout_s,
                    missing_text(members_, missing)));
}

Clock::duration Supervisor::stall_timeout() const {
  if (launcher_.patient()) return launcher_.start_timeout();
  const bool busy = std::any_of(members_.begin(), members_.end(),
                                [](const Member& member) { return member.busy; });
  const double tick_s =
      layout_.pace == Pace::kLockstep ? 0.0 : plan_.graph.tick_s / layout_.pace_factor;
  return (busy ? kLongestStep : kStallTimeout) +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(2.0 * tick_s));
}

bool Supervisor::everybody_ready() const {
  return all_ready(members_) && (!observer_ || observer_->ready()) &&
         (!recording_ || recording_->ready());
}

bool Supervisor::everybody_finished() const {
  return all_finished(members_) && (!observer_ || observer_->finished(*last_tick_));
}

void Supervisor::go(Time now) {
  gone_ = true;
  stalled_since_ = now;
  const bool all_wait = keeps_own_pace(members_);
  for (Member& member : members_) {
    const bool waits = all_wait || member.starts_ticks;
    if (waits && member.link) member.link->post(FrameType::kGo, Tick{0});
  }
}

// The stage that starts ticks does not run away from the slowest member, so that histories hold
// what anybody may need, nor from the recorder.
void Supervisor::give_credit() {
  std::uint64_t done = UINT64_MAX;
  for (const Member& member : members_) {
    if (!member.third_party) done = std::min(done, member.progress.ticks);
  }
  if (observer_) done = std::min(done, observer_->ticks());
  std::uint64_t credit = done + kLead;
  if (recording_) credit = std::min(credit, recording_->credit());
  if (credit < credit_ + kLead / 4) return;
  credit_ = credit;
  for (Member& member : members_) {
    if (member.starts_ticks && member.link) member.link->post(FrameType::kCredit, Tick{credit});
  }
}

// ---- end ----

// A run that is cut off has gone further than was told, by what components report in a while.
void Supervisor::take_last_reports() {
  const Time until = Clock::now() + 2 * kFlushPeriod;
  while (Clock::now() < until) {
    for (Member& member : members_) {
      if (!member.link || !member.link->receive()) continue;
      while (auto frame = member.link->next()) handle(member, *std::move(frame), Clock::now());
    }
    ::poll(nullptr, 0, 1);
  }
}

void Supervisor::end_members() {
  if (gone_ && !all_finished_) take_last_reports();
  if (observer_) observe(Clock::now());
  end_processes(members_, all_finished_);
  if (recording_) recording_->end(report_.aborted);
}

RunStatistics Supervisor::statistics() const {
  RunStatistics total = total_statistics(members_);
  if (observer_) total.merge(observer_->statistics());
  return total;
}

RunReport Supervisor::finish(Time now) {
  if (recording_) {
    report_.recording = recording_->finish();
    report_.restarts += recording_->restarts();
  }
  report_.statistics = statistics();
  report_.ticks_per_s = rate_.per_s();
  report_.wall_s = std::chrono::duration<double>(now - started_at_).count();
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

}  // namespace clew::bridge
