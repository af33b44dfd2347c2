// SPDX-License-Identifier: Apache-2.0
/// What the supervisor does by the clock: start, stall, and the end of a run in real time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>

#include "component/scan_watch.hpp"
#include "run/limits.hpp"
#include "supervisor/supervisor.hpp"

namespace clew::bridge {

using Clock = std::chrono::steady_clock;

void Supervisor::watch(Time now) {
  forgive_own_absence(now);
  watch_late(now);
  // In real time a kill is the end of the run.
  if (!launcher_.patient() && layout_.pace != Pace::kRealtime) {
    log(arrival_watch_.watch(members_, now));
  }
  if (gone_) {
    watch_stall(now);
  } else {
    watch_start(now);
  }
  if (!launcher_.patient()) {
    const bool realtime = layout_.pace == Pace::kRealtime;
    log(restart_policy_.kill_frozen(now, realtime ? kRealtimeFrozenAfter : kFrozenAfter));
    if (!realtime) log(restart_policy_.kill_lonely(now, launcher_.patience().lonely_after));
  } else {
    tell_silent(now);
  }
  watch_rest(now);
  if (ends_at_rest_.empty()) {
    for (Member* member : restart_policy_.due(now)) start_child(*member);
  }
  give_credit();
  if (last_tick_ && everybody_finished()) all_finished_ = true;
  if (outside_.display && gone_ && now - displayed_at_ >= kDisplayPeriod) {
    displayed_at_ = now;
    outside_.display(statistics(), rate_.per_s());
  }
}

// In lockstep a recording says nothing of how long a step took: it is told in the log.
void Supervisor::watch_late(Time now) {
  if (!gone_ || last_tick_ || live_control_.holds()) return late_watch_.forget();
  const auto written = [this](const Member& member) {
    runtime::TopicSet topics;
    for (const std::string& stage : member.stages) topics |= plan_.graph.find(stage)->ports.outputs;
    return observer_->ticks_of(topics);
  };
  for (domain::Incident& late : late_watch_.watch(members_, written, now)) {
    if (layout_.pace != Pace::kRealtime) {
      log({late.text});
    } else {
      tell(std::move(late));
    }
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
  tell_long_steps(now);
  const auto stalled = this->stalled(now);
  if (stalled > stall_timeout()) {
    return abort(fmt::format(
        "no tick was completed for {} s; ticks done:{}",
        std::chrono::duration_cast<std::chrono::seconds>(stall_timeout()).count(), ticks_done()));
  }
  const std::uint64_t started = started_ticks(members_);
  // A slow pace makes long ticks.
  const auto restart_after =
      stall_timeout() - launcher_.patience().stall_timeout + launcher_.patience().stall_restart;
  if (stalled < restart_after || restarted_at_ == started || !may_restart_all()) return;
  log({fmt::format(
      "no tick was completed for {} s, though all report; restarting all; ticks done:{}",
      std::chrono::duration_cast<std::chrono::seconds>(restart_after).count(), ticks_done())});
  restarted_at_ = started;
  got_on(now);
  for (const Member& member : members_) member.child->signal(SIGKILL);
}

void Supervisor::got_on(Time now) {
  stalled_since_ = now;
  for (Member& member : members_) member.beats = 0;
}

// How long nothing has gone on. A step goes on while it gets processor time, be that little, and so
// does the start of a process that comes back. A machine on which heartbeats come late is late with
// all else: its time is that of the member that was heard least, half as often as on a quiet
// machine being often enough. Where nobody is killed for being silent, silence must not stop the
// clock.
Clock::duration Supervisor::stalled(Time now) const {
  Time since = stalled_since_;
  auto by_heartbeats = Clock::duration::max();
  for (const Member& member : members_) {
    since = std::max(since, member.worked_at);
    if (!member.link || launcher_.patient()) continue;
    by_heartbeats = std::min<Clock::duration>(by_heartbeats, 2 * kHeartbeatPeriod * member.beats);
  }
  return std::min(now - since, by_heartbeats);
}

void Supervisor::tell_long_steps(Time now) {
  if (now - std::max(stalled_since_, long_step_told_at_) < kLongestStep) return;
  for (const Member& member : members_) {
    if (!member.busy) continue;
    long_step_told_at_ = now;
    log({fmt::format("{} has been busy with one tick for {} s; ticks done:{}", member.stage,
                     std::chrono::duration_cast<std::chrono::seconds>(now - stalled_since_).count(),
                     ticks_done())});
  }
}

// A person should know for whom the run waits.
void Supervisor::tell_silent(Time now) {
  for (Member& member : members_) {
    const bool silent = member.link && now - member.heard_at >= kStallTimeout;
    if (silent && !member.silence_told) {
      log({fmt::format(
          "{} (process {}) has not reported for {} s; the run waits for it, {} s at most",
          member.stage, member.process_id,
          std::chrono::duration_cast<std::chrono::seconds>(kStallTimeout).count(),
          std::chrono::duration_cast<std::chrono::seconds>(stall_timeout()).count())});
    }
    member.silence_told = silent;
  }
}

// Who was away cannot say that the others were silent: of any time between two looks, no more
// counts than a member may need to be heard.
void Supervisor::forgive_own_absence(Time now) {
  const auto absent = now - watched_at_ - 2 * kHeartbeatPeriod;
  watched_at_ = now;
  if (absent <= Clock::duration::zero()) return;
  for (Member& member : members_) member.heard_at = std::min(now, member.heard_at + absent);
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
  abort(fmt::format("startup timed out after {} s:{}",
                    std::chrono::duration<double>(launcher_.start_timeout()).count(),
                    missing_text(members_, missing)));
}

Clock::duration Supervisor::stall_timeout() const {
  if (launcher_.patient()) return launcher_.start_timeout();
  const bool busy = std::any_of(members_.begin(), members_.end(),
                                [](const Member& member) { return member.busy; });
  const double own_factor = layout_.pace == Pace::kLockstep ? 0.0 : layout_.pace_factor;
  const double factor = live_control_.pace_factor().value_or(own_factor);
  const double tick_s = factor == 0.0 ? 0.0 : plan_.graph.tick_s / factor;
  return (busy ? kLongestStep : launcher_.patience().stall_timeout) +
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
  got_on(now);
  const bool all_wait = keeps_own_pace(members_);
  for (Member& member : members_) {
    const bool waits = all_wait || member.starts_ticks;
    if (waits && member.link) member.link->post(FrameType::kGo, Tick{0});
  }
}

// The stage that starts ticks does not run away from the slowest member, so that histories hold
// what anybody may need, nor from the recorder.
void Supervisor::give_credit() {
  std::uint64_t done = least_ticks(members_);
  if (observer_) done = std::min(done, observer_->ticks());
  std::uint64_t credit = done + lead_;
  if (recording_) credit = std::min(credit, recording_->credit());
  credit = std::min(credit, live_control_.credit());
  if (credit < credit_ + std::max<std::uint64_t>(lead_ / 4, 1)) return;
  credit_ = credit;
  for (Member& member : members_) {
    if (member.starts_ticks && member.link) member.link->post(FrameType::kCredit, Tick{credit});
  }
}

// What ends a run in real time must not leave the robot in motion: drive is told to take no command
// any more, and writes its ticks until it rests. One that rested when it was last heard may have
// had a command since.
void Supervisor::end_at_rest(const std::string& why, Time now) {
  if (layout_.pace != Pace::kRealtime || !gone_) return abort(why);
  if (!ends_at_rest_.empty()) return;
  ends_at_rest_ = why;
  ends_by_ = now + kRestTimeout;
  log({why + "; bringing the robot to rest"});
  for (Member& member : members_) {
    if (member.starts_ticks && member.link) member.link->post(FrameType::kRest, Tick{0});
  }
}

// In lockstep the run is what its samples say: it is told, and goes on. A drive of somebody else's
// can only be told by commands that do not come.
void Supervisor::note_incident(domain::Incident incident, Time now) {
  const bool acts =
      gone_ && !last_tick_ && layout_.pace == Pace::kRealtime && !keeps_own_pace(members_);
  if (acts && incident.kind == ScanWatch::kStale) {
    live_control_.slow(true);
    incident.text += "; the robot goes half as fast";
  } else if (acts && incident.kind == ScanWatch::kFresh) {
    live_control_.slow(false);
  } else if (acts && (incident.kind == ScanWatch::kFrozen || incident.kind == ScanWatch::kGone)) {
    return stop_for_sensor(std::move(incident), now);
  }
  tell(std::move(incident));
}

// A sensor that is gone may be only half of what happens: a process that is stopped or stuck is
// named before it is given up.
void Supervisor::stop_for_sensor(domain::Incident incident, Time now) {
  live_control_.disarm();
  const std::string why = incident.text;
  incident.text += layout_.name.empty()
                       ? "; the robot rests, and the run ends"
                       : "; the robot rests until 'clew resume " + layout_.name + "'";
  const bool gone = incident.kind == ScanWatch::kGone;
  tell(std::move(incident));
  if (!layout_.name.empty()) return;
  if (!gone) return end_at_rest(why, now);
  if (!ends_without_sensor_) ends_without_sensor_ = {why, now + kRealtimeFrozenAfter};
}

void Supervisor::watch_rest(Time now) {
  if (ends_without_sensor_ && now >= ends_without_sensor_->by && !last_tick_) {
    end_at_rest(ends_without_sensor_->why + "; a run without a name cannot be told to go on", now);
  }
  if (ends_at_rest_.empty()) return;
  if (speed_mps() == 0.0) {
    // What drive wrote follows its report.
    if (!rests_at_) rests_at_ = now;
    if (now - *rests_at_ >= 3 * kFlushPeriod) abort(ends_at_rest_);
    return;
  }
  rests_at_.reset();
  if (now < ends_by_) return;
  abort(ends_at_rest_ + fmt::format("; it ended in motion at {:.2f} m/s", speed_mps()));
}

double Supervisor::speed_mps() const {
  for (const Member& member : members_) {
    const auto& truth = member.progress.statistics.truth;
    if (member.starts_ticks && truth && !truth->at_rest()) {
      return std::max(std::fabs(truth->speed_mps), std::numeric_limits<double>::min());
    }
  }
  return 0.0;
}

}  // namespace clew::bridge
