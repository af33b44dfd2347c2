// SPDX-License-Identifier: Apache-2.0
/// What is said on the line between a run's supervisor and its component processes: who is there,
/// who waits for whom, how far each is, what it wrote (for the recording), and how it ended.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/archive.hpp"
#include "core/hash128.hpp"
#include "dds/security_files.hpp"
#include "domain/incident.hpp"
#include "domain/intervention.hpp"
#include "run/limits.hpp"
#include "run/pace.hpp"
#include "run/run_statistics.hpp"
#include "run/step_times.hpp"
#include "runtime/config_source.hpp"

namespace clew::bridge {

enum class FrameType : std::uint8_t {
  // from a component
  kHello,
  kPreparing,  ///< busy preparing; the text says with what
  kAlive,      ///< every tenth of a second, whatever it does
  kWaiting,    ///< which endpoints are not there yet; none: ready
  kProgress,
  kSamples,  ///< what was written, for the recording
  kCheckpoint,
  kFinished,
  kNotice,    ///< a line for the log
  kFatal,     ///< the component cannot go on
  kHeld,      ///< the tick before which it holds
  kNoted,     ///< of an intervention, by its tick: it is known, and will hold
  kTookOver,  ///< a successor has taken over
  kIncident,  ///< what it notices of others, for the recording, too
  // from the recorder
  kKept,      ///< how far the recorder is
  kRecorded,  ///< the recording has ended, and how it went
  // from the supervisor
  kAssignment,
  kGo,
  kCredit,
  kFinish,
  kIntervention,  ///< what changes at a later tick
  kHold,          ///< start no tick from this one on
  kRelease,       ///< start ticks again
  kPace,          ///< start them at another pace
  kSpool,         ///< hand over what it writes from now on: somebody looks on
  kRest,          ///< in real time: take no command any more, so that the robot comes to rest
  kSlow,          ///< in real time: take every second command only, or all of them again
  // to the recorder, besides kSamples
  kRecord,        ///< what to record
  kRecordingEnd,  ///< all samples were sent; why the run was aborted, if it was
  // of somebody who commands the run, and to him
  kCommand,
  kAnswer
};

struct Hello {
  std::string stage;  ///< or the group of stages that the process is
  std::int64_t process_id = 0;
  std::string idl_fingerprint;
};

/// What a process calls itself in its hello that only looks on: it is told all that the run is made
/// of, and nothing waits for it.
inline constexpr const char* kWatcherName = "watcher";

/// An endpoint of another process that must be matched before tick 0.
struct ExpectedEndpoint {
  std::string topic;
  bool is_writer = false;
  std::string stage;         ///< empty: of anybody
  bool third_party = false;  ///< of a component that is not clew's, and so does not tell its stage
};

/// A component's state before it steps `tick`: with the inputs from that tick on it goes on as if
/// it had never stopped.
struct Checkpoint {
  std::uint64_t tick = 0;
  std::string node;     ///< runtime::Node::save
  std::string account;  ///< the account of what it wrote
  /// What it wrote last, by topic: of the tick before, which a delayed input of another component
  /// that goes back to the same tick still needs.
  std::map<std::string, std::string> last_outputs;
  /// Of behaviours that are being fed: runtime::NodeSuccession::save_successors.
  std::map<std::uint64_t, std::string> successors = {};
};

/// All that a component process needs to take its place in a run.
struct Assignment {
  std::string run_id;
  std::string run_key;              ///< the secret of RunKey
  std::vector<std::string> stages;  ///< that this process is
  runtime::Bundle bundle;
  std::string middleware;
  std::optional<SecurityFiles> security;  ///< of its participant; none: the run is open
  std::int32_t domain = 0;
  double lease_s = kLease_s;
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;  ///< with kScaled and kRealtime: simulated over wall-clock time
  std::int32_t realtime_priority = 0;  ///< of all threads, first in, first out; 0: none
  bool hash = true;
  Spooling spooling = Spooling::kNothing;
  std::uint32_t history_depth = kHistoryDepth;
  std::uint64_t lead = 1;  ///< ticks that may be started before the first credit
  std::vector<ExpectedEndpoint> expected;
  bool waits_for_go = false;  ///< with its first step, as the stage that starts ticks always does
  /// Whether no component gets further ahead of another than histories hold. Then a writer does not
  /// wait for its readers: what they lack is in its history, and a stranger's hold nothing up.
  bool has_lead = false;
  /// The names of the participants of ours among them, which meet before they create endpoints.
  std::vector<std::string> peers;
  bool resumes = false;  ///< the run is under way: go on from `checkpoint`, or else from tick 0
  std::optional<Checkpoint> checkpoint;
  std::vector<domain::Intervention> interventions;  ///< that took effect, and that will
  /// The file in which each stage keeps its inputs of late, and finds those of the process before
  /// this one; none: they are not kept.
  std::map<std::string, std::string> input_histories;
  /// The addresses of a run over several hosts, of which its host has one; none: all are here.
  std::vector<std::string> hosts = {};
};

/// What somebody wants of a run while it goes on.
struct RunCommand {
  enum class Kind : std::uint8_t { kChange, kPause, kStep, kResume, kStop, kPace, kStatus, kView };
  Kind kind = Kind::kChange;
  std::vector<std::string> changes = {};           ///< domain::Intervention::changes
  std::optional<std::uint64_t> at = std::nullopt;  ///< the tick; none: as soon as can be
  std::uint64_t ticks = 1;                         ///< with kStep
  double pace_factor = 0.0;  ///< with kPace: simulated over wall-clock time; 0: no limit
};

/// How a component of a run is, to somebody who asks.
struct ComponentStatus {
  std::string stage;
  std::string process;          ///< itself, or the group of stages whose process it is in
  std::int64_t process_id = 0;  ///< 0: it is not there
  std::uint64_t ticks = 0;      ///< that it has done
  StepTimes steps;
  std::uint64_t restarts = 0;
  std::uint64_t refused_samples = 0;  ///< of its process
  double silent_s = 0.0;              ///< since its process was last heard of
};

struct CommandAnswer {
  bool done = false;
  std::string text;        ///< why not, if it was not
  std::uint64_t tick = 0;  ///< from which on it holds; with kStatus, that the run has come to
  bool held = false;       ///< with kStatus: the run is paused
  std::string page = {};   ///< with kView: where the run's page is
  std::vector<ComponentStatus> components = {};  ///< with kStatus

  static CommandAnswer refused(std::string why) {
    return {false, std::move(why), 0, false, {}, {}};
  }
  static CommandAnswer from(std::uint64_t tick) { return {true, {}, tick, false, {}, {}}; }
};

/// A successor has taken over, `late` if it was not ready at its tick.
struct TookOver {
  std::string stage;
  std::uint64_t planned = 0;
  std::uint64_t tick = 0;
};

struct Waiting {
  std::vector<std::string> missing;  ///< one sentence each
};

struct Alive {
  bool busy = false;                            ///< with a step
  std::uint64_t processor_ns = 0;               ///< of the threads that are busy, so far
  std::map<std::string, StepTimes> steps = {};  ///< by stage
};

struct Progress {
  std::uint64_t ticks = 0;  ///< stepped so far
  RunStatistics statistics;
  std::uint64_t refused_samples = 0;
  std::uint64_t most_ticks = 0;  ///< of several stages: what the one has stepped that is ahead
};

struct Finished {
  std::map<std::string, core::Hash128> chains;  ///< by topic written
  RunStatistics statistics;
  std::uint64_t refused_samples = 0;
};

struct Text {
  std::string text;
};

struct Tick {
  std::uint64_t tick = 0;
};

/// Simulated over wall-clock time; 0: no limit.
struct PaceChange {
  double factor = 0.0;
};

/// Whether only every second command is taken.
struct Slow {
  bool slowly = false;
};

/// To a recorder: all samples were sent.
struct RecordingEnd {
  std::string aborted;                    ///< why the run has no outcome; empty if it has one
  std::optional<core::Hash128> run_hash;  ///< of all its topics, where it was hashed
};

template <typename V>
void visit_fields(V& v, RecordingEnd& e) {
  v(e.aborted, e.run_hash);
}

/// How far a recorder is.
struct Kept {
  std::uint64_t ticks = 0;          ///< below this one nobody needs to wait for it
  std::uint64_t durable_ticks = 0;  ///< ticks below this one it will not need again if it dies
};

template <typename V>
void visit_fields(V& v, Hello& m) {
  v(m.stage, m.process_id, m.idl_fingerprint);
}
template <typename V>
void visit_fields(V& v, ExpectedEndpoint& m) {
  v(m.topic, m.is_writer, m.stage, m.third_party);
}
template <typename V>
void visit_fields(V& v, Checkpoint& m) {
  v(m.tick, m.node, m.account, m.last_outputs, m.successors);
}
template <typename V>
void visit_fields(V& v, SecurityFiles& m) {
  v(m.authority, m.certificate, m.private_key, m.governance, m.permissions);
}
template <typename V>
void visit_fields(V& v, Assignment& m) {
  v(m.run_id, m.run_key, m.stages, m.bundle, m.middleware, m.security, m.domain, m.lease_s, m.pace,
    m.pace_factor, m.realtime_priority, m.hash, m.spooling, m.history_depth, m.lead, m.expected,
    m.waits_for_go, m.has_lead, m.peers, m.resumes, m.checkpoint, m.interventions,
    m.input_histories, m.hosts);
}
template <typename V>
void visit_fields(V& v, RunCommand& m) {
  v(m.kind, m.changes, m.at, m.ticks, m.pace_factor);
}
template <typename V>
void visit_fields(V& v, ComponentStatus& m) {
  v(m.stage, m.process, m.process_id, m.ticks, m.steps, m.restarts, m.refused_samples, m.silent_s);
}
template <typename V>
void visit_fields(V& v, CommandAnswer& m) {
  v(m.done, m.text, m.tick, m.held, m.page, m.components);
}
template <typename V>
void visit_fields(V& v, TookOver& m) {
  v(m.stage, m.planned, m.tick);
}
template <typename V>
void visit_fields(V& v, Waiting& m) {
  v(m.missing);
}
template <typename V>
void visit_fields(V& v, Alive& m) {
  v(m.busy, m.processor_ns, m.steps);
}
template <typename V>
void visit_fields(V& v, Progress& m) {
  v(m.ticks, m.statistics, m.refused_samples, m.most_ticks);
}
template <typename V>
void visit_fields(V& v, Finished& m) {
  v(m.chains, m.statistics, m.refused_samples);
}
template <typename V>
void visit_fields(V& v, Text& m) {
  v(m.text);
}
template <typename V>
void visit_fields(V& v, Tick& m) {
  v(m.tick);
}
template <typename V>
void visit_fields(V& v, Slow& m) {
  v(m.slowly);
}
template <typename V>
void visit_fields(V& v, PaceChange& m) {
  v(m.factor);
}
template <typename V>
void visit_fields(V& v, Kept& m) {
  v(m.ticks, m.durable_ticks);
}

/// A frame as received.
struct Frame {
  FrameType type = FrameType::kNotice;
  std::string payload;

  /// The message inside, or none if the payload is not one.
  template <typename Message>
  std::optional<Message> as() const {
    Message message;
    core::StateReader reader(payload);
    reader(message);
    if (!reader.complete()) return std::nullopt;
    return message;
  }
};

}  // namespace clew::bridge
