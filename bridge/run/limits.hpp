// SPDX-License-Identifier: Apache-2.0
/// Every time-out, period and depth of a run, its line, its hosts and its lookers-on, each with its
/// reason. Those of DDS itself are in dds/participant.hpp and dds/rtps_ports.hpp, of a connection
/// of the web in gateway/web_limits.hpp. Bridges (ros2, robot, domains) are programs of their own
/// and have theirs.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace clew::bridge {

// ---- how far one may be ahead of another ----

/// Samples of each topic that its writer and readers hold: all that a restarted component needs
/// again, which is two checkpoint periods and the lead.
inline constexpr std::uint32_t kHistoryDepth = 512;
/// Ticks that the stage that starts them may be ahead of the slowest member: a quarter, so that a
/// late reader still finds what it needs.
inline constexpr std::uint32_t kLead = kHistoryDepth / 4;
/// The same of a run that is held back to a pace, in seconds of the wall clock: what somebody
/// changes takes effect after so long.
inline constexpr double kPacedLead_s = 0.5;
/// In real time a change is announced so long before: a behaviour is made and fed meanwhile.
inline constexpr double kRealtimeNotice_s = 1.0;
/// Ticks that a run may be ahead of what the recorder has in closed chunks: half a history.
inline constexpr std::uint64_t kRecorderLead = kHistoryDepth / 2;
/// Two are enough for members that go in step; one that nobody waits for may lag behind by the lead
/// of the stage that starts ticks, which is two periods more.
inline constexpr std::size_t kCheckpointsKept = 4;

// ---- who is believed alive, and for how long ----

/// How long a participant that is silent is believed alive by the others. They keep what they write
/// for it until then.
inline constexpr double kLease_s = 1.5;
/// The same of a run over several hosts, whose network may lose a fifth of all packets, or all of
/// them for seconds: what was heard of one by some and not by others must not be taken for its
/// death.
inline constexpr double kLeaseOverHosts_s = 10.0;
/// A component that is in a debugger is not dead.
inline constexpr double kPatientLease_s = 3600.0;
/// How often a component that has nothing else to do reports, and tries waiting writes again.
inline constexpr auto kFlushPeriod = std::chrono::milliseconds(20);
/// How often a process says that it lives while it reads a large world or a long recording.
inline constexpr auto kHeartbeatPeriod = std::chrono::milliseconds(100);
/// A component that has not reported for so long is killed: ten heartbeats. It must be before its
/// lease ends for anybody, counted from its last announcement, up to 0.4 s before it froze: a
/// participant that comes back after that may be known to some and forgotten by others for good.
inline constexpr auto kFrozenAfter = std::chrono::seconds(1);
/// A report from another host may be lost on its way, several times in a row. Whether the host
/// itself is lost, the relay here knows.
inline constexpr auto kLostReports = std::chrono::seconds(3);
/// A process that was killed so and then does not get further is given twice as long each time, up
/// to half a minute: on a busy machine it was not frozen.
inline constexpr std::uint32_t kMostDoublings = 5;
/// In real time nothing is restarted, so a kill is the end of the run: while control is frozen, the
/// robot rests.
inline constexpr auto kRealtimeFrozenAfter = std::chrono::seconds(2);
/// A recorder may wait for its disk; no lease is at stake.
inline constexpr auto kRecorderFrozenAfter = std::chrono::seconds(2);
/// After so long without a tick all components are started anew, once: each is alive, so what is
/// lost is between them.
inline constexpr auto kStallRestart = std::chrono::seconds(5);
/// Discovery takes a second at the most; on a machine under full load three were seen.
inline constexpr auto kLonelyAfter = std::chrono::seconds(4);
/// No tick for so long means that a component is stuck.
inline constexpr auto kStallTimeout = std::chrono::seconds(10);
/// How long a run waits for its processes to find each other, and for ticks. `start` times
/// `start_timeout_s` is what they may take to start.
struct Patience {
  double lease_s;
  int start;
  std::chrono::seconds lonely_after, stall_restart, stall_timeout;
};
inline constexpr Patience kPatienceHere{kLease_s, 1, kLonelyAfter, kStallRestart, kStallTimeout};
/// Over a cable that loses packets: a secured start takes a handshake of TLS and one of each two
/// participants, and each message that is lost is sent again after a second.
inline constexpr Patience kPatienceOverHosts{kLeaseOverHosts_s, 3, std::chrono::seconds(15),
                                             std::chrono::seconds(15), std::chrono::seconds(30)};
/// A third-party program that is asked for a line and does not answer is stuck, too.
inline constexpr auto kLongestAnswer = std::chrono::seconds(10);
/// Unless one of them says that it is busy with a step. A step may take as long as it uses
/// processor time; one that has used none for so long waits for what does not come. As often is it
/// told of a step that goes on.
inline constexpr auto kLongestStep = std::chrono::seconds(60);

// ---- what a line may carry ----

/// Before a process has said who it is: more than any hello.
inline constexpr std::size_t kMostHelloBytes = std::size_t{4} * 1024;
/// Afterwards: more than any world, checkpoint or batch, less than what a size field can claim.
inline constexpr std::size_t kMostPayloadBytes = std::size_t{512} << 20;
/// Connections that have not said hello: more than a run has processes.
inline constexpr std::size_t kMostNewcomers = 64;
/// People and programs who command a run at a time.
inline constexpr std::size_t kMostCommanders = 16;
/// A process says hello as soon as it is connected.
inline constexpr auto kHelloTimeout = std::chrono::seconds(5);

// ---- start and end ----

/// A component whose run is not there says so after this.
inline constexpr auto kSilence = std::chrono::seconds(1);
/// How often a process looks whether its run is there.
inline constexpr auto kConnectPeriod = std::chrono::milliseconds(50);
/// A supervisor that starts a large world answers late; one that is gone closes the line.
inline constexpr auto kAssignmentTimeout = std::chrono::seconds(30);
/// How long a component waits for the participants of the others before it creates its endpoints
/// nevertheless: those that come later are found a second later at the most.
inline constexpr auto kMeetTimeout = std::chrono::seconds(2);
/// A recorder reports that it lives from its first moment.
inline constexpr auto kRecorderStartTimeout = std::chrono::seconds(10);
/// With a debugger, or a component that a person starts: as long as a person may take.
inline constexpr auto kPatienceOfPerson = std::chrono::hours(1);
/// The same in a replay, where nothing but the replay waits.
inline constexpr double kReplayPatience_s = 60.0;
/// In real time a run whose end has come goes on until the robot rests, but not for longer.
inline constexpr auto kRestTimeout = std::chrono::seconds(2);
/// How long a process may take to end once it should. In a coverage build it first writes what it
/// ran.
#ifdef CLEW_COVERAGE
inline constexpr auto kEndGrace = std::chrono::milliseconds(20000);
#else
inline constexpr auto kEndGrace = std::chrono::milliseconds(500);
#endif
/// A component that is on the wire itself comes back when everybody has given up its predecessor:
/// until then nobody could tell the two apart.
inline constexpr auto kThirdPartyBackoff = std::chrono::seconds(2);
/// A process that dies so often without coming any further will do so again.
inline constexpr std::uint32_t kDeathsInPlace = 2;
/// Of the recorder; those of a component are in its graph.
inline constexpr std::uint32_t kRecorderRestarts = 100;

// ---- how often something is looked at or told ----

/// The supervisor's look at the clock while nothing arrives.
inline constexpr auto kPollPeriod = std::chrono::milliseconds(20);
inline constexpr auto kDisplayPeriod = std::chrono::milliseconds(100);
/// A composed run looks this often whether a signal asks for an end: a look costs a system call.
inline constexpr auto kSignalPeriod = std::chrono::milliseconds(10);
/// A component reports its progress once in so many ticks: an eighth of the lead and more.
inline constexpr std::uint64_t kTicksPerReport = 32;
/// It sends what it wrote in batches of this size at the latest.
inline constexpr std::size_t kSpoolBytes = std::size_t{64} * 1024;
/// How often a recorder says how far it is.
inline constexpr auto kRecorderReportPeriod = std::chrono::milliseconds(100);
/// And after how many ticks at once: the run waits for it, but not for every tick.
inline constexpr std::uint64_t kRecorderReportTicks = 4;
/// What is in the open chunk is left in the file as often as this.
inline constexpr auto kWriteAheadPeriod = std::chrono::milliseconds(500);
/// Waking the recorder costs more than what it then does: it gets many samples at once.
inline constexpr std::size_t kRecorderBatchBytes = std::size_t{64} * 1024;
inline constexpr auto kRecorderBatchDelay = std::chrono::milliseconds(20);
/// In real time, what is kept for the recorder: minutes of the fastest run.
inline constexpr std::size_t kMaxKeptBytes = std::size_t{64} << 20;

// ---- replay on the wire ----

/// Ticks published before something else is looked after.
inline constexpr int kTicksPerRound = 64;
/// How soon a write that was refused is tried again: nobody tells when there is room.
inline constexpr auto kRetryPeriod = std::chrono::milliseconds(1);
/// A reader that acknowledges nothing for so long is worth a line.
inline constexpr auto kHeldUpPeriod = std::chrono::seconds(10);

// ---- who is late, and what its process does meanwhile ----

/// In real time, the larger of both: a step that is over by then disturbs nobody.
inline constexpr double kLateAfter_s = 0.3;
inline constexpr double kLateAfterTicks = 2.0;
/// In lockstep a large search takes its time.
inline constexpr double kLateInLockstepAfter_s = 10.0;
/// Most steps are over by then: before it there is nothing to look at.
inline constexpr auto kLateLookAfter = std::chrono::milliseconds(50);
inline constexpr auto kLateLookInLockstepAfter = std::chrono::milliseconds(1000);
/// Often enough to see most of what a process does in a third of a second.
inline constexpr auto kLateLookPeriod = std::chrono::milliseconds(20);
/// Two heartbeats missed: it may be stopped.
inline constexpr auto kSilentAfter = std::chrono::milliseconds(250);
/// Who looks after the scans less often than this was asleep himself.
inline constexpr auto kScanWatchAwake = std::chrono::milliseconds(100);

// ---- other hosts ----

/// How often each end of a connection says that it is there.
inline constexpr auto kHostBeatPeriod = std::chrono::milliseconds(250);
/// An end that was not heard for so long is lost: its components are killed, or started again.
inline constexpr auto kHostLostAfter = std::chrono::seconds(2);
/// How long a host that does not answer is tried before a component is started here instead. Longer
/// than what a host that is cut off needs to notice it, so that no component is there twice.
inline constexpr auto kFallBackAfter = std::chrono::seconds(3);
/// And how long without that: a run over hosts that stands still for 30 s ends.
inline constexpr auto kHostPatience = std::chrono::seconds(28);
/// A cable that is back is noticed soon, and a host that is gone is not flooded.
inline constexpr auto kReconnectPeriod = std::chrono::milliseconds(200);
/// A component that has closed its line is about to end.
inline constexpr auto kLastMoment = std::chrono::seconds(1);
/// A run whose components have all left a host may start one there again.
inline constexpr auto kRunForgottenAfter = std::chrono::seconds(60);

// ---- who looks on ----

/// A gateway that has not started by then is told of; a run does not wait longer.
inline constexpr auto kGatewayStartPatience = std::chrono::seconds(10);
/// How long a run that ends waits for what its gateway has not taken yet.
inline constexpr auto kGatewayEndPatience = std::chrono::seconds(3);
/// And how long a gateway at most that says again and again that it is still at it.
inline constexpr auto kGatewayMostEndPatience = std::chrono::seconds(30);
/// What a person can see: sixty times a second.
inline constexpr auto kPassOnPeriod = std::chrono::milliseconds(16);
/// How soon a page hears what the run answers.
inline constexpr auto kOrderPeriod = std::chrono::milliseconds(5);
/// A program that takes longer to explain a tick is killed.
inline constexpr auto kExplainPatience = std::chrono::minutes(1);
/// In a replay at a pace, a tick later than this is taken for held up, not for late.
inline constexpr auto kPlaybackSlack = std::chrono::milliseconds(100);

}  // namespace clew::bridge
