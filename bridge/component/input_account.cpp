// SPDX-License-Identifier: Apache-2.0
#include "component/input_account.hpp"

#include <utility>

#include "component/topic_input.hpp"
#include "line/user_data.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

runtime::NodePorts inputs_only(const runtime::TopicSet& topics) {
  runtime::NodePorts ports;
  ports.inputs = topics;
  ports.declared_inputs = topics;
  return ports;
}

}  // namespace

InputAccount::InputAccount(std::string name, const runtime::TopicSet& topics,
                           const Assignment& assignment, const domain::ScanLayout& scan)
    : name_(std::move(name)),
      topics_(topics),
      scan_(scan),
      user_data_(UserData{std::string(idl_fingerprint()), name_}.to_text()),
      history_depth_(static_cast<int>(assignment.history_depth)),
      lockstep_(assignment.pace != Pace::kRealtime),
      buffer_(inputs_only(topics), assignment.history_depth),
      account_(assignment.hash, assignment.spooling != Spooling::kNothing) {}

InputAccount::~InputAccount() { readers_.clear(); }

core::Result<void> InputAccount::restore(const Checkpoint& checkpoint) {
  const std::lock_guard<std::mutex> lock(mutex_);
  core::StateReader reader(checkpoint.account);
  reader(account_);
  if (!reader.complete()) return core::Error{"the checkpoint's account is not one"};
  buffer_.restart_at(checkpoint.tick);
  return {};
}

core::Result<void> InputAccount::open(Participant& participant, const StartBarrier& barrier) {
  for (Topic topic : domain::kAllTopics) {
    if (!topics_[domain::index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      listeners_.push_back(listener<Message>(barrier));
    });
    auto reader = participant.create_reader(
        {std::string(domain::topic_name(topic)), std::string(domain::type_name(topic)), user_data_,
         history_depth_},
        *listeners_.back());
    if (!reader.ok()) return reader.error();
    readers_.push_back(std::move(reader).value());
  }
  return {};
}

template <typename Message>
std::unique_ptr<SampleListener> InputAccount::listener(const StartBarrier& barrier) {
  return std::make_unique<TopicInput<Message>>(
      barrier, scan_,
      typename TopicInput<Message>::Handlers{
          [this] {
            const std::lock_guard<std::mutex> lock(mutex_);
            ++refused_samples_;
          },
          [this](const core::Error& error) { refuse(domain::topic_of<Message>(), error); },
          [this](Message& message) { deliver(message); }});
}

template <typename Message>
void InputAccount::deliver(Message& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::uint64_t tick = message.stamp.tick;
  std::uint64_t& end = ends_[domain::index_of(domain::topic_of<Message>())];
  end = std::max(end, tick + 1);
  check_count(message);
  if (buffer_.offer(message) == runtime::InputBuffer::Offer::kAhead) {
    fatal_ = name_ + " is at tick " + std::to_string(buffer_.next_tick()) + " and lost '" +
             std::string(domain::topic_name(domain::topic_of<Message>())) + "' of tick " +
             std::to_string(tick);
    return;
  }
  // In real time it goes on without what was lost; the recording tells.
  while (buffer_.ready() || (!lockstep_ && buffer_.rest_is_lost())) take_tick();
}

// The first sample of a tick holds, whatever comes after it. That one comes again is no fault: its
// writer may have been started anew.
template <typename Message>
void InputAccount::check_count(const Message& message) {
  constexpr auto topic = domain::index_of(domain::topic_of<Message>());
  const domain::TickStamp& stamp = message.stamp;
  const auto sample = [&] {
    return name_ + " has a sample of '" +
           std::string(domain::topic_name(domain::topic_of<Message>())) + "' of tick " +
           std::to_string(stamp.tick);
  };
  if (stamp.sequence != stamp.tick && !miscounts_[topic]) {
    miscounts_[topic] = true;
    notices_.push_back(sample() + " that its writer counts as number " +
                       std::to_string(stamp.sequence) +
                       "; expected: " + std::to_string(stamp.tick));
  }
  const core::Hash128 content = core::hash128(std::get<topic>(codecs_).encode(message));
  auto& seen = seen_[topic];
  const auto [known, is_new] = seen.emplace(stamp.tick, content);
  if (!is_new && known->second != content) {
    notices_.push_back(sample() + " once more, and otherwise; the first one holds");
  }
  if (seen.size() > static_cast<std::size_t>(history_depth_)) seen.erase(seen.begin());
}

void InputAccount::take_tick() {
  const std::uint64_t tick = buffer_.next_tick();
  const runtime::TopicSet present = buffer_.take(messages_);
  if (on_tick_) on_tick_(tick, present, messages_);
  for (Topic topic : domain::kAllTopics) {
    if (!present[domain::index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      const auto& message = std::get<constant.kIndex>(messages_);
      account_.add(message, std::get<constant.kIndex>(codecs_).encode(message));
    });
  }
}

void InputAccount::refuse(Topic topic, const core::Error& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_samples_;
  std::string what = name_ + " refuses a sample of '" + std::string(domain::topic_name(topic)) +
                     "': " + error.text();
  if (lockstep_) {
    fatal_ = std::move(what);  // without it the tick can never be complete
  } else {
    notices_.push_back(std::move(what));
  }
}

Progress InputAccount::progress() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {buffer_.next_tick(), account_.statistics(), refused_samples_};
}

std::uint64_t InputAccount::ticks_of(const runtime::TopicSet& topics) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t least = UINT64_MAX;
  for (const Topic topic : domain::kAllTopics) {
    if (topics[domain::index_of(topic)]) least = std::min(least, ends_[domain::index_of(topic)]);
  }
  return least;
}

std::optional<Finished> InputAccount::finished(std::uint64_t last_tick) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (buffer_.next_tick() <= last_tick) return std::nullopt;
  return Finished{account_.chains(), account_.statistics(), refused_samples_};
}

void InputAccount::spool() {
  const std::lock_guard<std::mutex> lock(mutex_);
  account_.spool();
}

std::string InputAccount::take_spooled() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return account_.take_spooled();
}

std::vector<std::string> InputAccount::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

std::optional<std::string> InputAccount::fatal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fatal_;
}

}  // namespace clew::bridge
