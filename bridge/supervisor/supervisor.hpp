// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "log/log.hpp"
#include "recorder/recording_sink.hpp"
#include "run/run_report.hpp"
#include "run/tick_rate.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/arrival_watch.hpp"
#include "supervisor/incident_log.hpp"
#include "supervisor/late_watch.hpp"
#include "supervisor/launcher.hpp"
#include "supervisor/live_control.hpp"
#include "supervisor/member.hpp"
#include "supervisor/process_layout.hpp"
#include "supervisor/restart_policy.hpp"
#include "supervisor/run_recording_control.hpp"
#include "supervisor/third_party_observer.hpp"

namespace clew::bridge {

/// Decides what becomes of a run that is spread over processes: who is there, how far each is, who
/// is brought back, when the run is over. It takes what has arrived on the lines of its members,
/// and never waits; the time is told to it. Plan and layout must outlive it.
class Supervisor {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Log = std::function<void(logs::Level, const std::string&)>;

  struct Outside {
    Log log;                                   ///< a line for people
    ProgressDisplay display;                   ///< may be null
    StartProcess start = ChildProcess::start;  ///< starts a program
    LateWatch::Activity activity = activity_of;
    RunControl* control = nullptr;  ///< what is changed while the run goes on; null: nothing may be
    RunSecurity::Shared security = nullptr;  ///< null: the run is open
  };

  Supervisor(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain,
             const std::optional<RecordingOrder>& recording, const ProcessStart& start,
             Outside outside, Time now);

  /// Starts the processes, or says how to start those that a person starts.
  void start();
  /// A process has said who it is on a new line.
  void welcome(std::unique_ptr<Link> link, const Hello& hello, Time now);
  /// Somebody was turned away where processes connect.
  void note_refused(const std::string& who) { tell({0, domain::kRefused, "run", who}); }
  /// What to poll beside the places where processes connect.
  std::vector<pollfd> descriptors() const;
  /// Takes what has arrived, and does what is due.
  void turn(Time now);
  /// A signal asks for an end.
  void interrupt(int number, Time now);
  /// Whether the run has an outcome that everybody has confirmed, or was aborted.
  bool over() const { return !report_.aborted.empty() || all_finished_; }

  /// Ends all processes but the recorder, and tells that one to finish. The only call that waits:
  /// twice kEndGrace and kFlushPeriod at most.
  void end_members();
  /// As turn(), of the recorder alone.
  void turn_recording(Time now);
  bool recording_ended() const { return !recording_ || recording_->ended(); }
  /// How the run went; once it is over.
  RunReport finish(Time now);

  const std::vector<Member>& members() const { return members_; }
  /// What a process is told that only looks on.
  Assignment description() const { return launcher_.assignment_for_watcher(); }

 private:
  void abort(const std::string& why);
  void end_at_rest(const std::string& why, Time now);
  void watch_rest(Time now);
  double speed_mps() const;
  void log(const std::vector<std::string>& lines, logs::Level level = logs::Level::kWarning) const;
  void start_child(Member& member);
  void refuse(Link& link, const std::string& why);
  void note_incident(domain::Incident incident, Time now);
  void stop_for_sensor(domain::Incident incident, Time now);
  void tell(domain::Incident incident);
  void record(domain::Incident incident);
  void serve(Member& member, Time now);
  static bool has_ended(Member& member, Time now);
  void lose(Member& member, Time now);
  void handle(Member& member, Frame frame, Time now);
  void note_progress(Member& member, const Progress& progress, Time now);
  void note_truth(const RunStatistics& statistics, Time now);
  void note_observed(Time now);
  void observe(Time now);
  void take_last_reports();
  void serve_commands(Time now);
  RunPage* page() const { return outside_.control == nullptr ? nullptr : outside_.control->page(); }
  void show_what_is_new();
  void show();
  void hand_on(std::string spool, std::uint64_t end_tick);
  void watch(Time now);
  void watch_late(Time now);
  void watch_start(Time now);
  void watch_stall(Time now);
  void got_on(Time now);
  std::chrono::steady_clock::duration stalled(Time now) const;
  void tell_long_steps(Time now);
  void tell_silent(Time now);
  void forgive_own_absence(Time now);
  bool may_restart_all() const;
  std::string ticks_done() const;
  void abort_start();
  std::chrono::steady_clock::duration stall_timeout() const;
  bool everybody_ready() const;
  bool everybody_finished() const;
  void go(Time now);
  void give_credit();
  RunStatistics statistics() const;
  /// Of all topics; nothing of a run that was aborted.
  std::optional<core::Hash128> hash() const;

  const runtime::RunPlan& plan_;
  const ProcessLayout& layout_;
  const Outside outside_;
  std::vector<Member> members_;
  Launcher launcher_;
  RestartPolicy restart_policy_;
  LiveControl live_control_;
  std::optional<RunRecordingControl> recording_;
  std::optional<Checkpoint> observed_before_;
  std::unique_ptr<ThirdPartyObserver> observer_;
  IncidentLog incidents_;
  LateWatch late_watch_;
  ArrivalWatch arrival_watch_;
  RunReport report_;
  const Time started_at_;
  TickRate rate_;
  bool gone_ = false;
  bool all_finished_ = false;
  bool shown_ = false;                  ///< everybody hands over what he writes, for a page
  std::set<std::uint64_t> changed_at_;  ///< other behaviours that are not shown anew yet
  const std::uint64_t lead_;  ///< ticks that may be started before the slowest member has done them
  std::uint64_t credit_;
  std::optional<std::uint64_t> last_tick_;
  /// In real time: why the run ends as soon as the robot rests, and when it ends anyway.
  std::string ends_at_rest_;
  Time ends_by_{};
  std::optional<Time> rests_at_;  ///< since when it does
  /// In real time, of a run without a name whose sensor was gone: why it ends, and when.
  struct EndWithoutSensor {
    std::string why;
    Time by;
  };
  std::optional<EndWithoutSensor> ends_without_sensor_;
  Time stalled_since_{};
  Time long_step_told_at_{};
  Time watched_at_;
  std::optional<std::uint64_t> restarted_at_;  ///< tick at which a stall was last answered
  Time displayed_at_{};
};

}  // namespace clew::bridge
