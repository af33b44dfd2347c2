// SPDX-License-Identifier: Apache-2.0
#include "replay/live_comparison.hpp"

#include <utility>

#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using domain::Topic;

}  // namespace

/// The reader of one output. Samples are brought into the form in which they are recorded, since
/// the padding of a third-party component may hold anything.
template <typename Message>
class LiveComparison::Output : public SampleListener {
 public:
  Output(LiveComparison& owner, const StartBarrier& barrier) : owner_(owner), barrier_(barrier) {}

  void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
    if (!barrier_.accepts(writer)) return;
    constexpr Topic kTopic = domain::topic_of<Message>();
    if (const auto decoded = codec_.decode(cdr, message_); !decoded.ok()) {
      owner_.refuse(kTopic, decoded.error());
    } else {
      owner_.arrive(
          {kTopic, message_.stamp.tick, message_.stamp.sequence, codec_.encode(message_)});
    }
  }

 private:
  LiveComparison& owner_;
  const StartBarrier& barrier_;
  Codec<Message> codec_;
  Message message_;
};

LiveComparison::LiveComparison(std::string component, const runtime::NodePorts& ports,
                               std::uint64_t first_compared, std::function<void()> on_arrival)
    : ports_(ports), first_compared_(first_compared), on_arrival_(std::move(on_arrival)) {
  report_.component = std::move(component);
}

LiveComparison::~LiveComparison() { readers_.clear(); }

Result<void> LiveComparison::open(Participant& participant, const StartBarrier& barrier,
                                  int history_depth) {
  const std::string user_data = UserData{std::string(idl_fingerprint()), kReplayName}.to_text();
  for (Topic topic : ports_.output_order) {
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      listeners_.push_back(std::make_unique<Output<Message>>(*this, barrier));
    });
    auto reader =
        participant.create_reader({std::string(domain::topic_name(topic)),
                                   std::string(domain::type_name(topic)), user_data, history_depth},
                                  *listeners_.back());
    if (!reader.ok()) return reader.error();
    readers_.push_back(std::move(reader).value());
  }
  return {};
}

void LiveComparison::arrive(const SampleView& sample) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    arrivals_.emplace_back(sample);
  }
  on_arrival_();
}

void LiveComparison::refuse(Topic topic, const core::Error& error) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    refused_ = report_.component + " wrote a bad sample of '" +
               std::string(domain::topic_name(topic)) + "': " + error.message;
  }
  on_arrival_();
}

void LiveComparison::expect(const RecordedTick& recorded) {
  expected_.push_back({recorded, {}, {}});
  end_tick_ = recorded.tick() + 1;
}

std::uint64_t LiveComparison::next_tick() const {
  return expected_.empty() ? end_tick_ : expected_.front().recorded.tick();
}

Result<void> LiveComparison::compare() {
  std::vector<Sample> arrivals;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!refused_.empty()) return core::Error{refused_};
    arrivals.swap(arrivals_);
  }
  for (Sample& arrival : arrivals) {
    const std::uint64_t first = next_tick();
    if (arrival.tick < first) continue;
    if (arrival.tick - first >= expected_.size()) {
      return core::Error{report_.component + " wrote '" +
                         std::string(domain::topic_name(arrival.topic)) + "' of tick " +
                         std::to_string(arrival.tick) + " before it had its inputs"};
    }
    ExpectedTick& expected = expected_[arrival.tick - first];
    expected.arrived.set(index_of(arrival.topic));
    expected.cdr[index_of(arrival.topic)] = std::move(arrival.cdr);
  }
  while (!expected_.empty() && expected_.front().arrived == ports_.outputs) {
    if (expected_.front().recorded.tick() >= first_compared_) compare_tick(expected_.front());
    for (Topic topic : domain::kAllTopics) {
      if (!ports_.delayed_inputs[index_of(topic)]) continue;
      cdr_before_[index_of(topic)] = expected_.front().recorded.cdr(topic);
    }
    expected_.pop_front();
  }
  return {};
}

void LiveComparison::compare_tick(const ExpectedTick& expected) {
  bool different = false;
  for (Topic topic : domain::kAllTopics) {
    if (!ports_.outputs[index_of(topic)]) continue;
    auto fields = expected.recorded.has(topic)
                      ? comparison_.compare(topic, expected.recorded.cdr(topic),
                                            expected.cdr[index_of(topic)])
                      : missing_sample(true);
    if (fields.empty()) continue;
    different = true;
    if (report_.first) continue;
    report_.first = {topic, expected.recorded.tick(), std::move(fields)};
    list_inputs(expected.recorded);
  }
  ++report_.ticks;
  if (different) ++report_.different_ticks;
}

void LiveComparison::list_inputs(const RecordedTick& recorded) {
  for (Topic topic : domain::kAllTopics) {
    if (!ports_.all_inputs()[index_of(topic)]) continue;
    const bool delayed = ports_.delayed_inputs[index_of(topic)];
    if (delayed && recorded.tick() == 0) continue;
    const std::string_view cdr = delayed ? cdr_before_[index_of(topic)] : recorded.cdr(topic);
    domain::visit_topic(topic, [&](auto constant) {
      auto& message = std::get<constant.kIndex>(messages_);
      // The component has taken it, so it is one.
      if (!std::get<constant.kIndex>(codecs_).decode(cdr, message).ok()) return;
      report_.inputs.push_back({topic, fields_of(message)});
    });
  }
}

}  // namespace clew::bridge
