// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "component/sealed_participant.hpp"
#include "replay/live_checks.hpp"
#include "replay/live_replay_loop.hpp"
#include "run/limits.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;
using domain::Topic;

namespace {

/// What a key skips, of simulated time.
constexpr double kSkip_s = 10.0;

}  // namespace

LiveReplay::LiveReplay(const RunRecording& recording, const runtime::RunPlan& recorded,
                       const runtime::RunPlan& plan, const LiveReplayOptions& options,
                       PlaybackConsole& console, DomainLock hold, Now now)
    : recording_(recording),
      recorded_(recorded),
      plan_(plan),
      options_(options),
      console_(console),
      now_(std::move(now)),
      domain_lock_(std::move(hold)),
      acceptor_(domain_lock_),
      settings_{fmt::format("{}-{}", ::getpid(), domain_lock_.domain()),
                options.program,
                options.middleware,
                domain_lock_.domain(),
                options.starts_component && options.prefix.empty() ? kLease_s : kPatientLease_s,
                kHistoryDepth,
                {},
                RunKey::make()},
      playback_(recorded.graph.tick_s, options.range.rate, options.paused) {
  report_.domain = domain_lock_.domain();
}

Result<void> LiveReplay::open() {
  const auto vendor = vendor_from_name(options_.middleware);
  if (!vendor) return Error{"unknown middleware " + options_.middleware};
  audience_.barrier().demand_seals(settings_.run_key);
  auto participant = create_participant(
      *vendor, {domain_lock_.domain(), kReplayName, settings_.lease_s}, audience_.barrier());
  if (!participant.ok()) return participant.error();
  participant_ =
      std::make_unique<SealedParticipant>(std::move(participant).value(), settings_.run_key);
  console_.log(fmt::format("publishes on domain {}", domain_lock_.domain()));
  runtime::TopicSet topics = options_.topics;
  if (!options_.component.empty()) {
    const runtime::GraphStage& stage = *plan_.graph.find(options_.component);
    CLEW_RETURN_IF_ERROR(adopt(stage));
    topics |= stage.ports.all_inputs();
  }
  audience_.expect_readers(options_.topics, options_.names);
  auto publisher =
      TopicPublisher::create(*participant_, recorded_.graph, topics, kHistoryDepth, options_.names);
  if (!publisher.ok()) return publisher.error();
  publisher_.emplace(std::move(publisher).value());
  if (component_) {
    CLEW_RETURN_IF_ERROR(component_->start(options_.starts_component, options_.prefix));
  }
  return audience_.start_readers(options_.readers, settings_);
}

LiveReplayReport LiveReplay::run() {
  asked_at_ = now_();
  while (phase_ != Phase::kOver) {
    wait_for_something();
    take_signals();
    take_requests();
    for (auto& [link, hello] : acceptor_.arrivals(now_())) welcome(std::move(link), hello);
    look_after_others();
    advance();
    show(false);
  }
  end();
  return std::move(report_);
}

void LiveReplay::stop(const std::string& why) {
  if (phase_ != Phase::kOver) report_.stopped = why;
  phase_ = Phase::kOver;
}

// ---- who is there ----

Result<void> LiveReplay::adopt(const runtime::GraphStage& stage) {
  WireSettings settings = settings_;
  settings.interventions = recording_.interventions();
  component_ = std::make_unique<FedComponent>(
      plan_, stage, std::move(settings), options_.range.first_tick,
      [this] { audience_.wake().ring(); }, [this](const std::string& line) { console_.log(line); });
  return component_->open(*participant_, audience_.barrier());
}

// A component that was not asked for takes its place if all that it needs is published.
void LiveReplay::welcome(std::unique_ptr<Link> link, const Hello& hello) {
  const auto stage = find_stage(plan_, hello.stage);
  Result<void> admitted = stage.ok() ? Result<void>() : stage.error();
  if (admitted.ok() && !component_) {
    admitted = options_.loops ? Error{"the replay loops"}
               : phase_ == Phase::kWaiting
                   ? check_fed(recording_, **stage, publisher_->topics(), options_.range.last_tick)
                   : Error{"the replay has begun"};
    if (admitted.ok()) admitted = adopt(**stage);
  }
  if (admitted.ok()) admitted = component_->welcome(link, hello);
  if (admitted.ok()) return;
  link->post(FrameType::kNotice, Text{admitted.error().message});
  console_.log(hello.stage + " is turned away: " + admitted.error().message);
}

void LiveReplay::look_after_others() {
  for (const std::string& line : audience_.take_notices()) console_.log(line);
  if (const auto fatal = audience_.fatal()) return stop(*fatal);
  if (component_) {
    const auto served = component_->serve(now_());
    if (!served.ok()) return stop(served.error().text());
  }
  // The component's line tells more of its end.
  if (phase_ != Phase::kFeeding || !audience_.news()) return;
  const auto missing = audience_.barrier().missing();
  if (missing.empty() || (component_ && component_->socket() >= 0)) return;
  stop(fmt::format("a participant left after tick {}: {}", published(), fmt::join(missing, "; ")));
}

// ---- what goes on ----

void LiveReplay::wait_for_something() {
  std::vector<int> descriptors = acceptor_.sockets();
  descriptors.push_back(signals_.descriptor());
  descriptors.push_back(console_.descriptor());
  if (component_) descriptors.push_back(component_->socket());
  audience_.wake().wait_beside(descriptors, patience());
}

Clock::duration LiveReplay::patience() const {
  if (held_up_ || phase_ == Phase::kDraining) return kRetryPeriod;
  if (phase_ != Phase::kFeeding || too_far_ahead()) return kDisplayPeriod;
  if (next_ != nullptr && next_->tick() < options_.range.first_tick) return {};
  const auto due = playback_.due();
  return due ? std::min<Clock::duration>(*due - now_(), kDisplayPeriod) : kDisplayPeriod;
}

void LiveReplay::take_signals() {
  if (const int number = signals_.take()) {
    report_.interrupted_by = number;
    stop(fmt::format("interrupted by signal {} ({})", number, ::strsignal(number)));
  }
}

void LiveReplay::take_requests() {
  for (const PlaybackRequest& request : console_.take()) {
    playback_.apply(request, now_());
    take_seek(request);
    if (request.kind == PlaybackRequest::Kind::kEnd && phase_ == Phase::kWaiting) {
      phase_ = Phase::kOver;
    } else if (request.kind == PlaybackRequest::Kind::kEnd) {
      drain();
    }
    show(true);
  }
}

void LiveReplay::take_seek(const PlaybackRequest& request) {
  using Kind = PlaybackRequest::Kind;
  const std::uint64_t here = next_tick();
  if (request.kind == Kind::kSeek) seek(request.ticks);
  if (request.kind == Kind::kSkipOn) seek(here + skip_ticks());
  if (request.kind == Kind::kSkipBack) seek(here - std::min(here, skip_ticks()));
}

std::uint64_t LiveReplay::skip_ticks() const {
  return static_cast<std::uint64_t>(std::max(1.0, kSkip_s / recorded_.graph.tick_s));
}

// Ticks that a component has had are its state: only other readers can be shown them again.
void LiveReplay::seek(std::uint64_t tick) {
  if (component_) return console_.log(component_->stage() + " is fed tick by tick: no seeking");
  if (phase_ == Phase::kWaiting)
    return console_.log("not yet: nothing is published before readers are there");
  if (phase_ == Phase::kOver) return;
  const std::uint64_t first = std::clamp(tick, options_.range.first_tick, options_.range.last_tick);
  publisher_->leave_tick();
  reader_.emplace(recording_, publisher_->topics(), options_.range.last_tick, first);
  next_ = nullptr;
  begun_ = held_up_ = false;
  last_tick_ = first > 0 ? std::optional<std::uint64_t>(first - 1) : std::nullopt;
  moved_at_ = now_();
  playback_.start(moved_at_);
  phase_ = Phase::kFeeding;
}

void LiveReplay::advance() {
  if (phase_ == Phase::kWaiting) {
    if (everybody_ready()) {
      begin();
    } else if (now_() - asked_at_ > std::chrono::duration<double>(wait_s())) {
      stop(fmt::format("startup timed out after {} s:{}", wait_s(), missing_text()));
    }
  }
  for (int i = 0; i < kTicksPerRound && phase_ == Phase::kFeeding; ++i) {
    if (!publish_next()) break;
  }
  if (phase_ == Phase::kDraining) try_to_finish();
  if (phase_ != Phase::kOver) notice_hold_up();
}

double LiveReplay::wait_s() const {
  const bool by_hand = !options_.component.empty() && !options_.starts_component;
  return options_.wait_s.value_or(by_hand ? kReplayPatience_s : recorded_.graph.start_timeout_s);
}

bool LiveReplay::everybody_ready() const {
  return (!component_ || component_->ready()) && audience_.barrier().missing().empty();
}

std::string LiveReplay::missing_text() const {
  std::vector<std::string> missing = audience_.barrier().missing();
  if (component_) {
    for (const std::string& line : component_->missing()) missing.push_back(line);
  }
  std::string text;
  for (const std::string& line : missing) text += "\n  " + line;
  return text;
}

void LiveReplay::begin() {
  phase_ = Phase::kFeeding;
  began_at_ = moved_at_ = now_();
  runtime::TopicSet topics = publisher_->topics();
  if (component_) topics |= component_->ports().outputs;
  // A component's state is built from tick 0; other readers get what was asked for.
  reader_.emplace(recording_, topics, options_.range.last_tick,
                  component_ ? 0 : options_.range.first_tick);
  playback_.start(began_at_);
  if (component_) component_->go();
}

bool LiveReplay::too_far_ahead() const { return component_ && component_->outstanding() >= kLead; }

// False: something must happen first.
bool LiveReplay::publish_next() { return (begun_ || begin_next()) && write_next(); }

bool LiveReplay::begin_next() {
  if (next_ == nullptr && !take_next()) return false;
  if (too_far_ahead()) return false;
  const auto now = now_();
  if (next_->tick() >= options_.range.first_tick) {
    if (!playback_.may_begin(now)) return false;
    playback_.begin(now);
  }
  if (component_) {
    const auto fed = component_->feed(*next_);
    if (!fed.ok()) {
      stop(Error{fed.error().message, recording_.path()}.text());
      return false;
    }
  }
  begun_ = true;
  return true;
}

bool LiveReplay::write_next() {
  const auto written = publisher_->write(*next_);
  if (!written.ok()) {
    stop(written.error().text());
    return false;
  }
  held_up_ = !*written;
  if (held_up_) return false;
  last_tick_ = next_->tick();
  next_ = nullptr;
  begun_ = false;
  ++report_.ticks;
  moved_at_ = now_();
  return true;
}

bool LiveReplay::take_next() {
  const auto next = reader_->next();
  if (!next.ok()) {
    stop(next.error().text());
  } else if (*next != nullptr) {
    next_ = *next;
  } else if (report_.ticks == 0) {
    stop(no_tick_from(recording_, options_.range.first_tick).text());
  } else if (options_.loops) {
    seek(options_.range.first_tick);
  } else {
    drain();
  }
  return next_ != nullptr;
}

std::string LiveReplay::published() const {
  return last_tick_ ? std::to_string(*last_tick_) : std::string("none");
}

void LiveReplay::notice_hold_up() {
  const bool waits = held_up_ || too_far_ahead() || phase_ == Phase::kDraining;
  const auto now = now_();
  if (!waits) moved_at_ = now;
  if (phase_ == Phase::kWaiting || now - moved_at_ < kHeldUpPeriod) return;
  moved_at_ = now;
  console_.log(component_ && component_->outstanding() > 0
                   ? fmt::format("{} has not answered tick {} for 10 s; still waiting",
                                 component_->stage(), component_->next_compared())
                   : std::string("a reader has acknowledged nothing for 10 s; still waiting"));
}

// ---- the end ----

void LiveReplay::drain() {
  phase_ = Phase::kDraining;
  moved_at_ = now_();
}

void LiveReplay::try_to_finish() {
  if (begun_ && !write_next()) return;
  if (component_ && component_->outstanding() > 0) return;
  if (!publisher_->acknowledged()) return;
  if (!done_at_) {
    done_at_ = now_();
    if (component_) component_->finish();
  }
  if (component_ && !component_->finished()) return;
  phase_ = Phase::kOver;
}

void LiveReplay::end() {
  report_.samples = publisher_->samples();
  const std::chrono::duration<double> took = done_at_.value_or(now_()) - began_at_;
  if (report_.ticks > 0) report_.ticks_per_s = static_cast<double>(report_.ticks) / took.count();
  const bool orderly = report_.stopped.empty();
  if (component_) report_.component = component_->report();
  publisher_.reset();
  if (component_) component_->end(orderly);
  audience_.end_readers(orderly);
  component_.reset();
  participant_.reset();
}

std::uint64_t LiveReplay::next_tick() const {
  return last_tick_ ? *last_tick_ + 1 : component_ ? 0 : options_.range.first_tick;
}

bool LiveReplay::halted() const {
  return phase_ == Phase::kFeeding && playback_.halted() && !begun_ &&
         next_tick() >= options_.range.first_tick &&
         (!component_ || component_->outstanding() == 0);
}

void LiveReplay::show(bool at_once) {
  const auto now = now_();
  if (!at_once && now - shown_at_ < kDisplayPeriod) return;
  shown_at_ = now;
  console_.show({next_tick(), recorded_.graph.tick_s, phase_ == Phase::kWaiting, playback_.paused(),
                 halted(), playback_.rate(), component_ ? &component_->report() : nullptr});
}

Result<LiveReplayReport> replay_live(const RunRecording& recording,
                                     const runtime::RunPlan& recorded, const runtime::RunPlan& plan,
                                     const LiveReplayOptions& options, PlaybackConsole& console) {
  CLEW_RETURN_IF_ERROR(check_live(recording, plan, options));
  auto hold = DomainLock::take(options.domain);
  if (!hold.ok()) return hold.error();
  LiveReplay replay(recording, recorded, plan, options, console, std::move(hold).value());
  CLEW_RETURN_IF_ERROR(replay.open());
  return replay.run();
}

}  // namespace clew::bridge
