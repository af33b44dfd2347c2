// SPDX-License-Identifier: Apache-2.0
#include "supervisor/supervisor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <utility>

#include "recorder/recorder_process.hpp"
#include "recording/run_hash.hpp"
#include "run/limits.hpp"
#include "supervisor/shutdown.hpp"

namespace clew::bridge {

using Clock = std::chrono::steady_clock;

namespace {

/// An incident that is told to who looks on, and not recorded.
constexpr char kRestart[] = "restart";

/// At a pace of its own a run need not be far ahead, and what somebody changes shall not wait long.
/// In real time a supervisor that is stopped, as by Ctrl-Z, holds the run up when it would call a
/// component frozen: a robot is not left to itself for longer.
std::uint64_t lead_of(const runtime::RunPlan& plan, const ProcessLayout& layout) {
  if (layout.pace == Pace::kLockstep) return kLead;
  const double lead_s = layout.pace == Pace::kRealtime
                            ? std::chrono::duration<double>(kRealtimeFrozenAfter).count()
                            : kPacedLead_s * layout.pace_factor;
  const double ticks = lead_s / plan.graph.tick_s;
  return static_cast<std::uint64_t>(std::clamp(std::ceil(ticks), 4.0, double{kLead}));
}

}  // namespace

Supervisor::Supervisor(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain,
                       const std::optional<RecordingOrder>& recording, const ProcessStart& start,
                       Outside outside, Time now)
    : plan_(plan),
      layout_(layout),
      outside_(std::move(outside)),
      members_(list_members(plan, layout)),
      launcher_(plan, layout, domain,
                spooling_for(recording, page() != nullptr && page()->is_open()), outside_.start,
                outside_.security),
      restart_policy_(members_, plan.graph),
      live_control_(outside_.control, members_, layout.pace == Pace::kRealtime),
      late_watch_(plan, layout.pace == Pace::kRealtime, outside_.activity),
      arrival_watch_(outside_.activity),
      started_at_(now),
      lead_(lead_of(plan, layout)),
      credit_(start.next_tick + lead_),
      watched_at_(now) {
  for (Member& member : members_) {
    member.begin(start);
    if (outside_.control != nullptr) member.keep_inputs();
  }
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

void Supervisor::log(const std::vector<std::string>& lines, logs::Level level) const {
  for (const std::string& line : lines) outside_.log(level, line);
}

// ---- start ----

void Supervisor::start() {
  if (recording_) {
    const auto started = recording_->start(started_at_);
    if (!started.ok()) return abort(started.error().text());
  }
  for (Member& member : members_) {
    if (member.external) {
      log({launcher_.how_to_start(member)}, logs::Level::kInfo);
    } else {
      start_child(member);
    }
  }
  Assignment assignment = launcher_.assignment_for_observer();
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
void Supervisor::refuse(Link& link, const std::string& why) {
  link.post(FrameType::kNotice, Text{why});
  note_refused(why);
}

// In the log, and in the recording.
void Supervisor::tell(domain::Incident incident) {
  if (auto told = incidents_.note(std::move(incident))) record(*std::move(told));
}

void Supervisor::record(domain::Incident incident) {
  incident.tick = started_ticks(members_);
  // A reader for whom nothing waits does no harm.
  log({incident.text},
      incident.kind == domain::kForeignReader ? logs::Level::kInfo : logs::Level::kWarning);
  if (page() != nullptr) page()->add(spooled(incident));
  if (recording_) recording_->add(spooled(incident), incident.tick + 1);
}

void Supervisor::welcome(std::unique_ptr<Link> link, const Hello& hello, Time now) {
  if (hello.stage == kCommander) return live_control_.welcome(std::move(link), now);
  if (recording_ && hello.stage == kRecorderName) return recording_->welcome(std::move(link), now);
  const auto admitted = launcher_.admit(hello, members_);
  if (!admitted.ok()) {
    refuse(*link, admitted.error().text());
    Member* const place = find_member(members_, hello.stage);
    // Another one of our own program would be no better; a person may come with a newer one.
    if (place != nullptr && place->child) return abort(admitted.error().text());
    return;
  }
  Member* member = *admitted;
  if (member == nullptr) {
    return refuse(*link, "this run has no place for a component " + hello.stage);
  }
  Assignment assignment = launcher_.assignment_for(*member);
  assignment.resumes = gone_;
  assignment.lead = lead_;
  live_control_.fill(assignment);
  assignment.input_histories = member->input_files();
  link->post(FrameType::kAssignment, std::move(assignment));
  if (shown_) link->post(FrameType::kSpool, Text{});
  if (member->starts_ticks) link->post(FrameType::kCredit, Tick{credit_});
  if (last_tick_) link->post(FrameType::kFinish, Tick{*last_tick_});
  member->joined_at = now;
  member->heard_at = now;
  member->link = std::move(link);
  member->process_id = hello.process_id;
  live_control_.join(*member);
}

// ---- while it runs ----

std::vector<pollfd> Supervisor::descriptors() const {
  std::vector<pollfd> descriptors;
  for (const Member& member : members_) {
    if (member.link) {
      descriptors.push_back({member.link->socket(), member.link->poll_events(), 0});
    }
  }
  for (const pollfd& descriptor : live_control_.descriptors()) descriptors.push_back(descriptor);
  if (recording_) {
    if (const auto descriptor = recording_->descriptor()) descriptors.push_back(*descriptor);
  }
  return descriptors;
}

void Supervisor::turn(Time now) {
  for (Member& member : members_) serve(member, now);
  if (observer_) observe(now);
  serve_commands(now);
  turn_recording(now);
  watch(now);
}

void Supervisor::serve_commands(Time now) {
  const bool ending = last_tick_.has_value() || !ends_at_rest_.empty();
  LiveControl::Situation situation{gone_, ending, credit_, started_ticks(members_)};
  if (layout_.pace == Pace::kRealtime) {
    situation.first_open_tick =
        situation.ticks +
        static_cast<std::uint64_t>(std::ceil(kRealtimeNotice_s / plan_.graph.tick_s));
  }
  live_control_.serve(situation, now);
  for (const domain::Intervention& change : live_control_.take_interventions()) {
    if (page() != nullptr) page()->add_intervention(change);
    if (!change.changes.empty()) changed_at_.insert(change.tick);
    if (recording_) recording_->add(spooled(change), change.tick + 1);
  }
  show_what_is_new();
  if (live_control_.holds()) got_on(now);
  if (!live_control_.stopped().empty()) end_at_rest(live_control_.stopped(), now);
}

void Supervisor::interrupt(int number, Time now) {
  report_.interrupted_by = number;
  end_at_rest("interrupted by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")",
              now);
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
  if (!why_not.empty() && member.starts_ticks && speed_mps() > 0.0) {
    return abort(what + why_not + fmt::format("; it ended in motion at {:.2f} m/s", speed_mps()));
  }
  if (!why_not.empty()) {
    member.down = true;
    return end_at_rest(what + why_not, now);
  }
  what += "; restarting it";
  log({what});
  // No recording holds it: the run is the same as without.
  if (page() != nullptr) {
    page()->add(spooled(domain::Incident{member.progress.ticks, kRestart, member.stage, what}));
  }
  ++report_.restarts;
}

void Supervisor::handle(Member& member, Frame frame, Time now) {
  member.heard_at = now;
  member.note(frame, now);
  live_control_.note(member.stage, frame);
  if (frame.type == FrameType::kProgress) {
    if (const auto progress = frame.as<Progress>()) note_progress(member, *progress, now);
  } else if (frame.type == FrameType::kSamples) {
    // Its progress was reported before: all of this is older.
    hand_on(std::move(frame.payload), std::max(member.progress.ticks, member.progress.most_ticks));
  } else if (frame.type == FrameType::kNotice) {
    if (const auto text = frame.as<Text>()) log({text->text});
  } else if (frame.type == FrameType::kIncident) {
    if (auto incident = frame.as<domain::Incident>()) note_incident(*std::move(incident), now);
  } else if (frame.type == FrameType::kFatal) {
    if (const auto text = frame.as<Text>()) end_at_rest(text->text, now);
  }
}

void Supervisor::note_progress(Member& member, const Progress& progress, Time now) {
  if (progress.ticks > member.progress.ticks) got_on(now);
  member.progress = progress;
  if (progress.ticks >= member.lost_at) member.catching_up = false;
  if (member.starts_ticks) note_truth(progress.statistics, now);
}

void Supervisor::note_truth(const RunStatistics& statistics, Time now) {
  if (!statistics.truth) return;
  if (!report_.start_s) report_.start_s = std::chrono::duration<double>(now - started_at_).count();
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
    if (observer_->ticks() > member.progress.ticks) got_on(now);
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
  for (const std::string& notice : observer_->take_notices()) note_refused(notice);
  for (ScanWatch::News& news : observer_->look_at_sensor(now)) {
    note_incident({0, news.kind, "run", std::move(news.text)}, now);
  }
  if (fatal) abort(*fatal);
  hand_on(observer_->take_spooled(), observer_->ticks());
  note_observed(now);
}

void Supervisor::turn_recording(Time now) {
  if (!recording_) return;
  recording_->serve(now);
  log(recording_->take_lines());
  // Nothing can go on before it has read again what was there.
  if (!recording_->ready()) got_on(now);
  if (!recording_->failure().empty()) abort(recording_->failure());
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
  for (domain::Incident& incident : incidents_.take_left_out()) record(std::move(incident));
  end_processes(members_, all_finished_);
  if (recording_) recording_->end({report_.aborted, hash()});
}

RunStatistics Supervisor::statistics() const {
  RunStatistics total = total_statistics(members_);
  if (observer_) total.merge(observer_->statistics());
  return total;
}

std::optional<core::Hash128> Supervisor::hash() const {
  if (!layout_.hash || !report_.aborted.empty()) return std::nullopt;
  auto chains = all_chains(members_);
  if (observer_) chains.merge(observer_->chains());
  return run_hash(chains);
}

RunReport Supervisor::finish(Time now) {
  if (recording_) {
    report_.recording = recording_->finish();
    report_.restarts += recording_->restarts();
  }
  report_.statistics = statistics();
  report_.goal_changed =
      report_.statistics.truth && live_control_.goal_changed_by(report_.statistics.truth->tick);
  report_.ticks_per_s = rate_.per_s();
  report_.wall_s = std::chrono::duration<double>(now - started_at_).count();
  report_.refused_samples = total_refused_samples(members_);
  if (observer_) {
    // What it refuses its readers do, too, but the run may be over before they have said so.
    report_.refused_samples = std::max(report_.refused_samples, observer_->refused_samples());
  }
  report_.hash = hash();
  return report_;
}

}  // namespace clew::bridge
