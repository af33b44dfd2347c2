// SPDX-License-Identifier: Apache-2.0
#include "component/node_host.hpp"

#include <algorithm>
#include <utility>

#include "component/topic_input.hpp"
#include "line/user_data.hpp"
#include "run/limits.hpp"
#include "run/shown_states.hpp"

namespace clew::bridge {

using runtime::Topic;

namespace {

EndpointSpec spec_of(Topic topic, const std::string& user_data, int history_depth) {
  return {std::string(domain::topic_name(topic)), std::string(domain::type_name(topic)), user_data,
          history_depth};
}

}  // namespace

NodeHost::NodeHost(runtime::NodeSuccession node, const Assignment& assignment,
                   const runtime::RunPlan& plan, Handlers handlers)
    : node_(std::move(node)),
      name_(node_.name()),
      scan_layout_(plan.setup.behaviour.scan),
      user_data_(UserData{std::string(idl_fingerprint()), name_}.to_text()),
      history_depth_(static_cast<int>(assignment.history_depth)),
      lockstep_(assignment.pace != Pace::kRealtime),
      tick_s_(plan.graph.tick_s),
      spools_states_(assignment.spooling == Spooling::kSamplesAndStates),
      waits_for_go_(assignment.waits_for_go),
      has_lead_(assignment.has_lead),
      handlers_(std::move(handlers)),
      buffer_(node_.ports(), assignment.history_depth),
      account_(assignment.hash, assignment.spooling != Spooling::kNothing),
      clock_(assignment.pace, assignment.pace_factor, plan.graph.tick_s),
      allowed_until_(assignment.lead) {
  const bool steers = node_.ports().outputs[index_of(Topic::kCommand)];
  if (steers && node_.ports().inputs[index_of(Topic::kScan)]) scan_watch_.emplace(plan);
}

NodeHost::~NodeHost() { readers_.clear(); }

core::Result<void> NodeHost::open(Participant& participant, const StartBarrier& barrier) {
  for (Topic topic : node_.ports().output_order) {
    EndpointSpec spec = spec_of(topic, user_data_, history_depth_);
    spec.qos.keep_last = has_lead_;
    auto writer = participant.create_writer(spec);
    if (!writer.ok()) return writer.error();
    outputs_[index_of(topic)].writer = std::move(writer).value();
  }
  const runtime::TopicSet inputs = node_.ports().all_inputs();
  for (Topic topic : domain::kAllTopics) {
    if (!inputs[index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      listeners_.push_back(listener<Message>(barrier));
    });
    auto reader =
        participant.create_reader(spec_of(topic, user_data_, history_depth_), *listeners_.back());
    if (!reader.ok()) return reader.error();
    readers_.push_back(std::move(reader).value());
  }
  return {};
}

template <typename Message>
std::unique_ptr<SampleListener> NodeHost::listener(const StartBarrier& barrier) {
  return std::make_unique<TopicInput<Message>>(
      barrier, scan_layout_,
      typename TopicInput<Message>::Handlers{[this] {
                                               const std::lock_guard<std::mutex> lock(mutex_);
                                               ++refused_samples_;
                                             },
                                             [this](const core::Error& error) {
                                               const std::lock_guard<std::mutex> lock(mutex_);
                                               refuse(domain::topic_of<Message>(), error);
                                             },
                                             [this](Message& message) {
                                               const std::lock_guard<std::mutex> lock(mutex_);
                                               deliver(message);
                                             }});
}

core::Result<void> NodeHost::restore(const Checkpoint& checkpoint) {
  const std::lock_guard<std::mutex> lock(mutex_);
  node_.skip_to(checkpoint.tick);
  CLEW_RETURN_IF_ERROR(node_.load(checkpoint.node));
  CLEW_RETURN_IF_ERROR(node_.load_successors(checkpoint.successors));
  CLEW_RETURN_IF_ERROR(feed_past(checkpoint));
  core::StateReader reader(checkpoint.account);
  reader(account_);
  if (!reader.complete()) return core::Error{"the checkpoint's account is not one"};
  buffer_.restart_at(checkpoint.tick);
  allowed_until_ = std::max(allowed_until_, checkpoint.tick + 1);
  return {};
}

std::uint64_t NodeHost::hold(std::uint64_t tick) {
  const std::lock_guard<std::mutex> lock(mutex_);
  held_at_ = std::max(tick, buffer_.next_tick());
  if (!clock_.is_free()) clock_.start(std::chrono::steady_clock::now(), buffer_.next_tick());
  run_ready(std::chrono::steady_clock::now());
  return *held_at_;
}

void NodeHost::rest() {
  const std::lock_guard<std::mutex> lock(mutex_);
  gate_.shut();
}

void NodeHost::slow(bool slowly) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gate_.halve(slowly);
}

bool NodeHost::has_come_to_rest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto& truth = account_.statistics().truth;
  return gate_.is_shut() && truth && truth->at_rest();
}

void NodeHost::release(Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  held_at_.reset();
  gate_.open();
  clock_.start(now, buffer_.next_tick());
  run_ready(now);
}

void NodeHost::set_pace(double factor, Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (clock_.is_realtime()) return;
  clock_ = TickClock::at_pace(factor, tick_s_);
  clock_.start(now, buffer_.next_tick());
  run_ready(now);
}

void NodeHost::go(Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_ = true;
  clock_.start(now, buffer_.next_tick());
  run_ready(now);
}

void NodeHost::allow_until(std::uint64_t tick) {
  const std::lock_guard<std::mutex> lock(mutex_);
  allowed_until_ = std::max(allowed_until_, tick);
  run_ready(std::chrono::steady_clock::now());
}

void NodeHost::poll(Time now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (scan_watch_ && !lockstep_ && !stopped_) tell_sensor(scan_watch_->look(now));
  for (Topic topic : node_.ports().output_order) {
    Output& output = outputs_[index_of(topic)];
    while (!output.waiting.empty() &&
           output.writer->write(output.waiting.front()) == WriteStatus::kTaken) {
      output.waiting.pop_front();
    }
  }
  run_ready(now);
}

std::optional<NodeHost::Time> NodeHost::next_due() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!started_ || !starts_ticks() || clock_.is_free() || held_at_) return std::nullopt;
  if (!clock_.is_realtime() && !buffer_.ready()) return std::nullopt;
  return clock_.due(buffer_.next_tick());
}

template <typename Message>
void NodeHost::deliver(Message& message) {
  const std::uint64_t tick = message.stamp.tick;
  if constexpr (domain::topic_of<Message>() == Topic::kScan) {
    if (scan_watch_ && !lockstep_) {
      tell_sensor(scan_watch_->scan_arrives(tick, Time::clock::now()));
    }
  }
  if constexpr (domain::topic_of<Message>() == Topic::kOdometry) {
    if (scan_watch_ && !lockstep_) scan_watch_->odometry_arrives(tick, Time::clock::now());
  }
  const auto offer = buffer_.offer(message);
  if (offer == runtime::InputBuffer::Offer::kAhead) {
    const std::string topic(domain::topic_name(domain::topic_of<Message>()));
    const std::string what = node_.name() + " is at tick " + std::to_string(buffer_.next_tick()) +
                             " and lost '" + topic + "' of tick " + std::to_string(tick);
    handlers_.on_fatal(what);
    return;
  }
  run_ready(clock_.is_free() ? Time{} : std::chrono::steady_clock::now());
}

void NodeHost::refuse(Topic topic, const core::Error& error) {
  ++refused_samples_;
  const std::string what = node_.name() + " refuses a sample of '" +
                           std::string(domain::topic_name(topic)) + "': " + error.text();
  if (!lockstep_) return tell(domain::kRefused, what);
  // Without it the tick can never be complete.
  report();
  handlers_.on_fatal(what);
}

void NodeHost::tell(const char* kind, std::string text) const {
  if (!handlers_.on_incident) return;
  handlers_.on_incident({buffer_.next_tick(), kind, name_, std::move(text)});
}

// In lockstep nobody goes slowly, so it is told only what is certain.
void NodeHost::tell_sensor(std::optional<ScanWatch::News> news) const {
  if (!news || (lockstep_ && news->kind != ScanWatch::kFrozen)) return;
  tell(news->kind, std::move(news->text));
}

bool NodeHost::may_step(Time now) const {
  if (stopped_) return false;
  if (lockstep_ && !expected_.empty() && *expected_.begin() <= buffer_.next_tick()) return false;
  if (held_at_ && buffer_.next_tick() >= *held_at_) return false;
  if (!starts_ticks()) return (started_ || !waits_for_go_) && buffer_.ready();
  if (!started_ || buffer_.next_tick() >= allowed_until_) return false;
  if (clock_.is_free()) return buffer_.ready();
  if (now < clock_.due(buffer_.next_tick())) return false;
  return clock_.is_realtime() || buffer_.ready();
}

void NodeHost::run_ready(Time now) {
  while (may_step(now)) step();
}

void NodeHost::step() {
  const std::uint64_t tick = buffer_.next_tick();
  runtime::TopicSet present = buffer_.take(messages_);
  const runtime::TopicSet& delayed = node_.ports().delayed_inputs;
  if ((present & delayed).any() && !gate_.lets_pass()) present &= ~delayed;
  note_successions(tick);
  stepping_.begin();
  const Time began = Time::clock::now();
  node_.step(tick, present, messages_);
  steps_.add(Time::clock::now() - began);
  stepping_.end();
  publish();
  if (scan_watch_) tell_sensor(scan_watch_->see(tick, present, messages_));
  keep_tick(tick, present);
  const auto& truth = account_.statistics().truth;
  const bool ended = truth && truth->outcome != domain::Outcome::kRunning;
  if (ended) stopped_ = true;
  if (ended || tick % kTicksPerReport == 0 || account_.spooled_bytes() >= kSpoolBytes) report();
  if (buffer_.next_tick() % kTicksPerCheckpoint == 0) save_checkpoint();
}

// What was written before is on its way to the recording first: a component that goes on from here
// will not write it again.
void NodeHost::save_checkpoint() {
  const std::string state = node_.save();
  const bool is_shown = shown_from_ && shows_states(buffer_.next_tick(), *shown_from_);
  if (spools_states_ || is_shown) {
    account_.spool_state({node_.name(), buffer_.next_tick(), state});
  }
  report();
  core::StateWriter account;
  account(account_);
  std::map<std::string, std::string> last_outputs;
  for (Topic topic : node_.ports().output_order) {
    domain::visit_topic(topic, [&](auto constant) {
      last_outputs[std::string(domain::topic_name(topic))] =
          std::get<constant.kIndex>(codecs_).encode(std::get<constant.kIndex>(messages_));
    });
  }
  handlers_.on_checkpoint({buffer_.next_tick(), state, account.take(), std::move(last_outputs),
                           node_.save_successors()});
}

void NodeHost::repeat_last_outputs(const Checkpoint& checkpoint) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Topic topic : node_.ports().output_order) {
    const auto bytes = checkpoint.last_outputs.find(std::string(domain::topic_name(topic)));
    if (bytes != checkpoint.last_outputs.end()) {
      write(outputs_[index_of(topic)], topic, bytes->second);
    }
  }
}

// The next component waits for the samples and nobody for the account of them.
void NodeHost::publish() {
  const auto& outputs = node_.ports().output_order;
  std::array<std::string_view, domain::kTopicCount> encoded;
  for (Topic topic : outputs) {
    domain::visit_topic(topic, [&](auto constant) {
      encoded[constant.kIndex] =
          std::get<constant.kIndex>(codecs_).encode(std::get<constant.kIndex>(messages_));
    });
    write(outputs_[index_of(topic)], topic, encoded[index_of(topic)]);
  }
  for (Topic topic : outputs) {
    domain::visit_topic(topic, [&](auto constant) {
      account_.add(std::get<constant.kIndex>(messages_), encoded[constant.kIndex]);
    });
  }
}

void NodeHost::write(Output& output, Topic topic, std::string_view cdr) {
  WriteStatus status = WriteStatus::kWouldBlock;
  if (output.waiting.empty()) status = output.writer->write(cdr);
  if (status == WriteStatus::kWouldBlock) output.waiting.emplace_back(cdr);
  if (status == WriteStatus::kFailed) {
    stopped_ = true;
    handlers_.on_fatal(node_.name() + " cannot write '" + std::string(domain::topic_name(topic)) +
                       "'");
  }
}

void NodeHost::report() {
  handlers_.on_progress({buffer_.next_tick(), account_.statistics(), refused_samples_});
  if (account_.spooled_bytes() > 0) handlers_.on_spooled(account_.take_spooled());
}

void NodeHost::flush() {
  const std::lock_guard<std::mutex> lock(mutex_);
  report();
}

void NodeHost::spool() {
  const std::lock_guard<std::mutex> lock(mutex_);
  account_.spool();
  shown_from_ = buffer_.next_tick();
}

std::optional<Finished> NodeHost::finished(std::uint64_t last_tick) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (buffer_.next_tick() <= last_tick) return std::nullopt;
  for (const Output& output : outputs_) {
    if (!output.waiting.empty()) return std::nullopt;
  }
  return Finished{account_.chains(), account_.statistics(), refused_samples_};
}

}  // namespace clew::bridge
