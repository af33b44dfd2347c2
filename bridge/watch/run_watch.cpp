// SPDX-License-Identifier: Apache-2.0
#include "watch/run_watch.hpp"

#include <unistd.h>

#include <utility>

#include "core/check.hpp"
#include "line/command_desk.hpp"
#include "line/user_data.hpp"
#include "run/limits.hpp"
#include "vendors/network_addresses.hpp"
#include "vendors/participant_factory.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

/// Who takes none shall not fill memory with them.
constexpr std::size_t kMostNotices = 1000;

}  // namespace

core::Result<Assignment> ask_what_runs(Link& line, std::chrono::steady_clock::time_point deadline) {
  line.post(FrameType::kHello, Hello{kWatcherName, ::getpid(), std::string(idl_fingerprint())});
  const auto frame = line.wait_for_frame(deadline);
  if (!frame.ok()) return frame.error();
  if (auto assignment = frame->as<Assignment>();
      frame->type == FrameType::kAssignment && assignment) {
    return *std::move(assignment);
  }
  const auto why = frame->as<Text>();
  return core::Error{why && !why->text.empty() ? why->text : "the run lets nobody look on"};
}

core::Result<std::unique_ptr<RunWatch>> RunWatch::join(const std::string& run, Time deadline) {
  const auto socket = is_domain_number(run) ? Link::connect(std::stoi(run), deadline)
                                            : Link::connect(run, deadline);
  if (!socket.ok()) return socket.error();
  std::unique_ptr<RunWatch> self(new RunWatch(*socket));
  auto told = ask_what_runs(self->line_, deadline);
  if (!told.ok()) return told.error();
  self->run_ = std::move(told).value();
  CLEW_RETURN_IF_ERROR(self->listen());
  return self;
}

RunWatch::~RunWatch() = default;

core::Result<void> RunWatch::listen() {
  const auto vendor = vendor_from_name(run_.middleware);
  CLEW_CHECK(vendor.has_value(), run_.middleware);
  const auto hosts = network_of(run_.hosts);
  if (!hosts.ok()) return hosts.error();
  auto participant = create_participant(
      *vendor, {run_.domain, kWatcherName, kLease_s, {}, false, run_.security, *hosts}, *this);
  if (!participant.ok()) return participant.error();
  participant_ = std::move(participant).value();
  const std::string user_data = UserData{std::string(idl_fingerprint()), {}}.to_text();
  for (const domain::Topic topic : domain::kAllTopics) {
    TopicListener& listener = listeners_[index_of(topic)];
    listener.watch_ = this;
    listener.topic_ = topic;
    const bool certain = topic == domain::Topic::kEvent;
    auto reader = participant_->create_reader({std::string(topic_name(topic)),
                                               std::string(type_name(topic)),
                                               user_data,
                                               static_cast<int>(run_.history_depth),
                                               {certain, certain, false}},
                                              listener);
    if (!reader.ok()) return reader.error();
    readers_[index_of(topic)] = std::move(reader).value();
  }
  return {};
}

void RunWatch::keep(domain::Topic topic, std::string_view cdr, const RemoteEndpoint& writer) {
  if (UserData::parse(writer.user_data).idl_fingerprint != idl_fingerprint()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes_ + cdr.size() > kMaxKeptBytes) {
      ++dropped_;
      return;
    }
    bytes_ += cdr.size();
    samples_.push_back(Sample(SampleView{topic, 0, 0, cdr}));
  }
  arrived_.ring();
}

bool RunWatch::goes_on() {
  const bool open = line_.receive();
  while (const auto frame = line_.next()) {
    const auto text = frame->type == FrameType::kNotice ? frame->as<Text>() : std::nullopt;
    if (text && notices_.size() < kMostNotices) notices_.push_back(text->text);
  }
  return open;
}

void RunWatch::wait(std::vector<int> descriptors, std::chrono::nanoseconds most) const {
  descriptors.push_back(line_.socket());
  arrived_.wait_beside(descriptors, most);
}

std::vector<Sample> RunWatch::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  bytes_ = 0;
  return std::exchange(samples_, {});
}

std::uint64_t RunWatch::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

}  // namespace clew::bridge
