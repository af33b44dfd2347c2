// SPDX-License-Identifier: Apache-2.0
#include "component/group_participant.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>

namespace clew::bridge {

class GroupParticipant::Writer : public SampleWriter {
 public:
  Writer(GroupParticipant& group, Channel& channel, std::unique_ptr<SampleWriter> wire)
      : group_(group), channel_(channel), wire_(std::move(wire)) {}

  WriteStatus write(std::string_view cdr) override {
    if (wire_) {
      const WriteStatus status = wire_->write(cdr);
      if (status != WriteStatus::kTaken) return status;
    }
    group_.push(channel_, cdr);
    return WriteStatus::kTaken;
  }
  bool acknowledged() const override { return !wire_ || wire_->acknowledged(); }
  std::string guid() const override { return wire_ ? wire_->guid() : channel_.writer.guid; }

 private:
  GroupParticipant& group_;
  Channel& channel_;
  std::unique_ptr<SampleWriter> wire_;  ///< null: nobody outside reads
};

class GroupParticipant::Reader : public SampleReader {
 public:
  Reader(GroupParticipant& group, Channel& channel, SampleListener& listener, std::string guid)
      : group_(group), channel_(channel), listener_(listener), guid_(std::move(guid)) {}
  ~Reader() override { group_.remove(channel_, listener_); }
  std::string guid() const override { return guid_; }

 private:
  GroupParticipant& group_;
  Channel& channel_;
  SampleListener& listener_;
  const std::string guid_;
};

GroupParticipant::GroupParticipant(std::unique_ptr<Participant> wire,
                                   const std::vector<std::string>& stages,
                                   const std::vector<ExpectedEndpoint>& expected,
                                   DiscoveryListener& discovery)
    : wire_(std::move(wire)), discovery_(discovery) {
  for (const ExpectedEndpoint& endpoint : expected) {
    const bool inside = std::count(stages.begin(), stages.end(), endpoint.stage) > 0;
    if (inside) channels_[endpoint.topic];
    if (!inside && !endpoint.is_writer) to_wire_.insert(endpoint.topic);
  }
}

GroupParticipant::~GroupParticipant() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void GroupParticipant::start() {
  if (channels_.empty()) return;
  thread_ = std::thread([this] { deliver(); });
}

core::Result<std::unique_ptr<SampleWriter>> GroupParticipant::create_writer(
    const EndpointSpec& spec) {
  const auto channel = channels_.find(spec.topic);
  if (channel == channels_.end()) return wire_->create_writer(spec);
  std::unique_ptr<SampleWriter> on_wire;
  if (to_wire_.count(spec.topic) > 0) {
    auto created = wire_->create_writer(spec);
    if (!created.ok()) return created.error();
    on_wire = std::move(created).value();
  }
  RemoteEndpoint& writer = channel->second.writer;
  writer = {true, spec.topic, spec.type, spec.user_data, inner_guid("writer", spec), ::getpid()};
  discovery_.on_matched(writer);
  return std::unique_ptr<SampleWriter>(
      std::make_unique<Writer>(*this, channel->second, std::move(on_wire)));
}

core::Result<std::unique_ptr<SampleReader>> GroupParticipant::create_reader(
    const EndpointSpec& spec, SampleListener& listener) {
  const auto channel = channels_.find(spec.topic);
  if (channel == channels_.end()) return wire_->create_reader(spec, listener);
  {
    const std::lock_guard lock(mutex_);
    Listeners more = *channel->second.listeners;
    more.push_back(&listener);
    channel->second.listeners = std::make_shared<const Listeners>(std::move(more));
  }
  const std::string guid = inner_guid("reader", spec);
  discovery_.on_matched({false, spec.topic, spec.type, spec.user_data, guid, ::getpid()});
  return std::unique_ptr<SampleReader>(
      std::make_unique<Reader>(*this, channel->second, listener, guid));
}

// It begins as that of an endpoint on the wire would, since the seal is of that part.
std::string GroupParticipant::inner_guid(const char* what, const EndpointSpec& spec) const {
  return wire_->guid().substr(0, 24) + ' ' + what + " of " + spec.topic + ' ' + spec.user_data;
}

void GroupParticipant::push(Channel& channel, std::string_view cdr) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({&channel, std::string(cdr)});
  }
  news_.notify_one();
}

void GroupParticipant::deliver() {
  std::unique_lock lock(mutex_);
  while (true) {
    news_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
    if (ended_) return;
    const Sample sample = std::move(waiting_.front());
    waiting_.pop_front();
    const std::shared_ptr<const Listeners> listeners = sample.channel->listeners;
    ++begun_deliveries_;
    lock.unlock();
    for (SampleListener* listener : *listeners) {
      listener->on_sample(sample.cdr, &sample.channel->writer);
    }
    lock.lock();
    ++ended_deliveries_;
    delivered_.notify_all();
  }
}

void GroupParticipant::remove(Channel& channel, const SampleListener& listener) {
  std::unique_lock lock(mutex_);
  Listeners left = *channel.listeners;
  left.erase(std::remove(left.begin(), left.end(), &listener), left.end());
  channel.listeners = std::make_shared<const Listeners>(std::move(left));
  // Only of the delivery under way: the next one begins without this listener, and a lock that it
  // took again and again would keep whoever wants to remove one waiting.
  const std::uint64_t under_way = begun_deliveries_;
  delivered_.wait(lock, [&] { return ended_deliveries_ >= under_way; });
}

}  // namespace clew::bridge
