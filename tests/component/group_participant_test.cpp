// SPDX-License-Identifier: Apache-2.0
#include "component/group_participant.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "component/sealed_participant.hpp"
#include "component/start_barrier.hpp"
#include "fake_participant.hpp"
#include "line/user_data.hpp"
#include "run/allocations.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Texts = std::vector<std::string>;

std::string data_of(const std::string& stage) {
  return UserData{std::string(idl_fingerprint()), stage}.to_text();
}

EndpointSpec spec(const std::string& topic, const std::string& stage) {
  return {topic, "clew::msg::Type", data_of(stage), 8};
}

/// Keeps the first samples that come, and who wrote the last; hands all on if told to.
class Inbox : public SampleListener {
 public:
  void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
    if (next_ != nullptr) next_->write(cdr);
    const std::lock_guard lock(mutex_);
    ++count_;
    if (samples_.size() < kMostSamples) samples_.emplace_back(cdr);
    writer_ = *writer;
    changed_.notify_all();
  }
  void hand_on_to(SampleWriter& next) { next_ = &next; }

  Texts wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(20), [&] { return samples_.size() >= count; });
    return samples_;
  }
  /// How many have come.
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return count_;
  }
  RemoteEndpoint writer() {
    const std::lock_guard lock(mutex_);
    return writer_;
  }

 private:
  static constexpr std::size_t kMostSamples = 1000;  // of a loop that goes on and on

  SampleWriter* next_ = nullptr;
  std::mutex mutex_;
  std::condition_variable changed_;
  Texts samples_;
  std::size_t count_ = 0;
  RemoteEndpoint writer_;
};

/// A process with sense and control: sense writes `scan` for control and, elsewhere, recover.
class Group : public testing::Test {
 protected:
  Group()
      : expected_{{"scan", false, "control", false},
                  {"scan", false, "recover", false},
                  {"scan", true, "sense", false},
                  {"command", false, "drive", false}},
        barrier_(
            "group", expected_,
            {[] {}, [this](std::string text) { refused_ = text; }, [](const std::string&) {}}) {
    auto wire = std::make_unique<FakeParticipant>();
    wire_ = wire.get();
    group_ = std::make_unique<GroupParticipant>(std::move(wire), Texts{"sense", "control"},
                                                expected_, barrier_);
  }
  std::unique_ptr<SampleWriter> writer(const EndpointSpec& spec) {
    return std::move(group_->create_writer(spec)).value();
  }
  std::unique_ptr<SampleReader> reader(const EndpointSpec& spec, SampleListener& listener) {
    return std::move(group_->create_reader(spec, listener)).value();
  }

  std::vector<ExpectedEndpoint> expected_;
  std::string refused_;
  StartBarrier barrier_;
  FakeParticipant* wire_ = nullptr;
  Inbox inbox_;
  std::unique_ptr<GroupParticipant> group_;
};

TEST_F(Group, DeliversWithinTheProcessInOrderAndWritesForTheOthers) {
  const auto scan = writer(spec("scan", "sense"));
  const auto reads = reader(spec("scan", "control"), inbox_);

  EXPECT_EQ(scan->write("one"), WriteStatus::kTaken);  // waits for the start
  group_->start();
  EXPECT_EQ(scan->write("two"), WriteStatus::kTaken);

  EXPECT_EQ(inbox_.wait_for(2), (Texts{"one", "two"}));
  EXPECT_EQ(wire_->written("scan"), (Texts{"one", "two"}));
  EXPECT_EQ(wire_->writers().size(), 1u);
  const RemoteEndpoint seen = inbox_.writer();
  EXPECT_TRUE(barrier_.accepts(&seen));
}

/// Counts what its thread allocates between the first sample and the last.
class Meter : public SampleListener {
 public:
  explicit Meter(std::size_t last) : last_(last) {}
  void on_sample(std::string_view, const RemoteEndpoint*) override {
    if (++count_ == 1) first_count_ = allocation_count();
    if (count_ == last_) allocations_.set_value(allocation_count() - first_count_);
  }
  std::uint64_t allocations() { return allocations_.get_future().get(); }

 private:
  const std::size_t last_;
  std::size_t count_ = 0;
  std::uint64_t first_count_ = 0;
  std::promise<std::uint64_t> allocations_;
};

TEST_F(Group, DeliversWithoutACopyOfItsListeners) {
  constexpr std::size_t kSamples = 1000;
  Meter meter(kSamples);
  const auto scan = writer(spec("scan", "sense"));
  const auto reads = reader(spec("scan", "control"), meter);
  for (std::size_t i = 0; i < kSamples; ++i) scan->write("one");

  group_->start();

  EXPECT_EQ(meter.allocations(), 0U);
}

TEST_F(Group, HasItsSealWithinTheProcessToo) {
  const RunKey key = RunKey::make();
  barrier_.demand_seals(key);
  GroupParticipant& group = *group_;
  SealedParticipant sealed(std::move(group_), key);
  const auto scan = std::move(sealed.create_writer(spec("scan", "sense"))).value();
  const auto reads = std::move(sealed.create_reader(spec("scan", "control"), inbox_)).value();

  group.start();
  scan->write("one");

  EXPECT_EQ(inbox_.wait_for(1), Texts{"one"});
  const RemoteEndpoint seen = inbox_.writer();
  EXPECT_TRUE(barrier_.accepts(&seen));
  EXPECT_EQ(refused_, "");
  EXPECT_TRUE(key.fits(UserData::parse(wire_->writers()[0].user_data), wire_->guid()));
}

TEST_F(Group, MatchesItsOwnEndpointsAndWaitsForThoseOfOthers) {
  const auto scan = writer(spec("scan", "sense"));
  const auto reads = reader(spec("scan", "control"), inbox_);

  EXPECT_EQ(barrier_.missing(), (Texts{"group has not found the reader of 'scan' in recover",
                                       "group has not found the reader of 'command' in drive"}));
  EXPECT_EQ(refused_, "");
}

TEST_F(Group, LeavesOnTheWireWhatNobodyInsideReads) {
  const auto command = writer(spec("command", "control"));
  group_->start();

  EXPECT_EQ(command->write("stop"), WriteStatus::kTaken);

  EXPECT_EQ(wire_->written("command"), Texts{"stop"});
}

TEST_F(Group, DeliversNothingThatTheWireHasNotTaken) {
  const auto scan = writer(spec("scan", "sense"));
  const auto reads = reader(spec("scan", "control"), inbox_);
  group_->start();

  wire_->answer(WriteStatus::kWouldBlock);
  EXPECT_EQ(scan->write("one"), WriteStatus::kWouldBlock);
  wire_->answer(WriteStatus::kTaken);
  EXPECT_EQ(scan->write("one"), WriteStatus::kTaken);
  EXPECT_EQ(scan->write("two"), WriteStatus::kTaken);

  EXPECT_EQ(inbox_.wait_for(2), (Texts{"one", "two"}));
}

/// A process in which what sense writes comes back to it, again and again.
class GroupLoop : public testing::Test {
 protected:
  GroupLoop() {
    control_.hand_on_to(*command_);
    sense_.hand_on_to(*scan_);
    group_.start();
    scan_->write("round");
  }
  std::unique_ptr<SampleWriter> writer(const std::string& topic, const std::string& stage) {
    return std::move(group_.create_writer(spec(topic, stage))).value();
  }
  std::unique_ptr<SampleReader> reader(const std::string& topic, const std::string& stage,
                                       SampleListener& listener) {
    return std::move(group_.create_reader(spec(topic, stage), listener)).value();
  }

  const std::vector<ExpectedEndpoint> expected_ = {{"scan", true, "sense", false},
                                                   {"command", true, "control", false}};
  StartBarrier barrier_{"group", expected_, {[] {}, [](const auto&) {}, [](const auto&) {}}};
  GroupParticipant group_{
      std::make_unique<FakeParticipant>(), {"sense", "control"}, expected_, barrier_};
  Inbox control_;
  Inbox sense_;
  std::unique_ptr<SampleWriter> scan_ = writer("scan", "sense");
  std::unique_ptr<SampleWriter> command_ = writer("command", "control");
  std::unique_ptr<SampleReader> reads_scan_ = reader("scan", "control", control_);
  std::unique_ptr<SampleReader> reads_command_ = reader("command", "sense", sense_);
};

TEST_F(GroupLoop, GoesAroundWithoutWaitingForItself) {
  EXPECT_EQ(control_.wait_for(100).at(99), "round");
  EXPECT_GE(sense_.wait_for(99).size(), 99u);
}

// There is always a sample to deliver: who removes a reader must not have to wait for a pause.
TEST_F(GroupLoop, LetsReadersComeAndGoWhileItGoesAround) {
  for (int i = 0; i < 200; ++i) {
    Inbox passing;
    const auto reads = reader("scan", "control", passing);
    ASSERT_FALSE(passing.wait_for(1).empty()) << i;
  }
  reads_command_.reset();
  const std::size_t samples = sense_.count();

  command_->write("one more");
  reads_scan_.reset();

  EXPECT_EQ(sense_.count(), samples);
}

TEST_F(Group, DeliversNothingToAReaderThatIsGone) {
  const auto scan = writer(spec("scan", "sense"));
  auto reads = reader(spec("scan", "control"), inbox_);
  group_->start();
  scan->write("one");
  inbox_.wait_for(1);

  reads.reset();
  scan->write("two");
  group_.reset();

  EXPECT_EQ(inbox_.wait_for(1), Texts{"one"});
}

}  // namespace
}  // namespace clew::bridge
