// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dds/participant.hpp"

namespace clew::bridge {

/// A participant without a network: keeps what is written, and delivers what a test says, on the
/// thread of the test.
class FakeParticipant : public Participant {
 public:
  std::string guid() const override { return std::string(32, 'f'); }
  core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) override {
    const std::lock_guard lock(mutex_);
    writers_.push_back(spec);
    return std::unique_ptr<SampleWriter>(std::make_unique<Writer>(*this, spec.topic));
  }
  core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                            SampleListener& listener) override {
    const std::lock_guard lock(mutex_);
    listeners_[spec.topic] = &listener;
    return std::unique_ptr<SampleReader>(std::make_unique<Reader>());
  }

  /// Hands a sample to the reader of its topic.
  void deliver(const std::string& topic, std::string_view cdr, const RemoteEndpoint* writer) {
    SampleListener* listener = nullptr;
    {
      const std::lock_guard lock(mutex_);
      listener = listeners_.at(topic);
    }
    listener->on_sample(cdr, writer);
  }
  /// What every later write is answered with.
  void answer(WriteStatus status) {
    const std::lock_guard lock(mutex_);
    status_ = status;
  }
  /// What was taken of a topic.
  std::vector<std::string> written(const std::string& topic) const {
    const std::lock_guard lock(mutex_);
    const auto found = written_.find(topic);
    return found == written_.end() ? std::vector<std::string>{} : found->second;
  }
  std::vector<EndpointSpec> writers() const {
    const std::lock_guard lock(mutex_);
    return writers_;
  }

 private:
  class Writer : public SampleWriter {
   public:
    Writer(FakeParticipant& participant, std::string topic)
        : participant_(participant), topic_(std::move(topic)) {}
    WriteStatus write(std::string_view cdr) override {
      const std::lock_guard lock(participant_.mutex_);
      if (participant_.status_ == WriteStatus::kTaken) {
        participant_.written_[topic_].emplace_back(cdr);
      }
      return participant_.status_;
    }
    bool acknowledged() const override { return true; }
    std::string guid() const override { return participant_.guid(); }

   private:
    FakeParticipant& participant_;
    const std::string topic_;
  };
  class Reader : public SampleReader {
   public:
    std::string guid() const override { return std::string(32, 'e'); }
  };

  mutable std::mutex mutex_;
  WriteStatus status_ = WriteStatus::kTaken;
  std::vector<EndpointSpec> writers_;
  std::map<std::string, std::vector<std::string>> written_;
  std::map<std::string, SampleListener*> listeners_;
};

/// An endpoint of a component of this run.
inline RemoteEndpoint remote(bool is_writer, const std::string& topic, const std::string& stage,
                             const std::string& user_data, const std::string& guid = "1") {
  return {is_writer, topic, "", user_data, guid + stage + topic, 0};
}

}  // namespace clew::bridge
