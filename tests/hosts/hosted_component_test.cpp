// SPDX-License-Identifier: Apache-2.0
#include "hosts/hosted_component.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <vector>

#include "connected_ends.hpp"
#include "run/limits.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

/// A program in the place of the clew command, in a folder of its own.
class Program {
 public:
  explicit Program(const std::string& text)
      : folder_(testing::TempDir() + "clew-hosted-" + std::to_string(::getpid())) {
    std::filesystem::create_directory(folder_);
    std::ofstream(path()) << "#!/bin/bash\nline=$7\nfolder=${0%/*}\n"
                          << "wait_for() { while [ ! -e $folder/$1 ]; do sleep 0.01; done; }\n"
                          << text;
    std::filesystem::permissions(path(), std::filesystem::perms::owner_all);
  }
  ~Program() { std::filesystem::remove_all(folder_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::string path() const { return folder_ + "/clew"; }
  void tell(const std::string& what) const { std::ofstream(folder_ + '/' + what) << what; }
  bool has_told(const std::string& what) const {
    return std::filesystem::exists(folder_ + '/' + what);
  }

 private:
  std::string folder_;
};

/// A host's end with a component, and the relay that ordered it, on one computer.
class Hosted : public testing::Test {
 protected:
  void order(const std::string& program, const std::string& version = "1") {
    program_.reset();  // the next one has the same folder
    program_ = std::make_unique<Program>(program);
    host_.program = program_->path();
    host_.version = "1";
    host_.clear_place = [this](const HostedComponent&) { return ++places_cleared_ > 0; };
    host_.input_files = [](const auto&, const auto&) {
      return std::map<std::string, std::string>();
    };
    const Sockets sockets;
    relay_ = std::make_unique<TlsLine>(sockets.relay, *desk_, HostRole::kRunner, "robot", now());
    component_ = std::make_unique<HostedComponent>(sockets.host, *robot_, host_, now());
    relay_->post(frame_type(HostFrame::kStart),
                 StartComponent{version, std::string(idl_fingerprint()), "run", "sense", kDomain});
  }

  static Assignment good_assignment() {
    Assignment assignment;
    assignment.domain = kDomain;
    assignment.hosts = {"127.0.0.1"};
    assignment.security = SecurityFiles{};
    return assignment;
  }
  void assign(Assignment assignment) {
    relay_->post(frame_type(HostFrame::kAssigned), AssignedElsewhere{std::move(assignment), {}});
  }

  HostedComponent::Time now() const { return Clock::now() + later_; }
  /// Until a line has something to take or to give. A program that has ended or left a file behind
  /// shows on no line: for that it looks again after a moment.
  void wait_for_news() const {
    std::vector<pollfd> lines;
    component_->add_descriptors(lines);
    if (!relay_->is_closed()) lines.push_back({relay_->socket(), relay_->poll_events(), 0});
    ::poll(lines.data(), lines.size(), kLookAgain_ms);
  }
  void turn() {
    component_->turn(now());
    wait_for_news();
    relay_->turn(now());
    while (auto frame = relay_->next()) {
      if (frame->type != frame_type(HostFrame::kBeat)) last_ = std::move(frame);
    }
  }
  bool turn_until(const std::function<bool()>& done) {
    const auto deadline = Clock::now() + std::chrono::seconds(20);
    for (; !done(); turn()) {
      if (Clock::now() > deadline) return false;
    }
    return true;
  }
  bool is_told(HostFrame what) const { return last_ && last_->type == frame_type(what); }
  bool begins() {
    return turn_until([&] { return is_told(HostFrame::kStarted); });
  }

  static constexpr int kDomain = 7;
  static constexpr int kLookAgain_ms = 5;
  TemporaryKeys keys_;
  TlsContextPtr robot_ = context_of(keys_, "robot", HostRole::kHost);
  TlsContextPtr desk_ = context_of(keys_, "desk", HostRole::kRunner);
  std::unique_ptr<Program> program_;
  HostSurroundings host_;
  int places_cleared_ = 0;
  std::chrono::milliseconds later_{};
  std::unique_ptr<TlsLine> relay_;
  std::unique_ptr<HostedComponent> component_;
  std::optional<Frame> last_;  ///< that the relay was sent, but beats
};

TEST_F(Hosted, HowItEndsIsTold) {
  order("wait_for go; exit 3\n");
  ASSERT_TRUE(begins());
  assign(good_assignment());
  program_->tell("go");

  ASSERT_TRUE(turn_until([&] { return is_told(HostFrame::kEnded); }));

  EXPECT_EQ(last_->as<ComponentEnd>()->status, 3);
  EXPECT_EQ(last_->as<ComponentEnd>()->signal, 0);
}

TEST_F(Hosted, AnAssignmentThatWasNotOrderedEndsIt) {
  Assignment elsewhere = good_assignment();
  elsewhere.domain = kDomain + 1;
  Assignment on_loopback = good_assignment();
  on_loopback.hosts.clear();
  Assignment open = good_assignment();
  open.security.reset();
  for (const Assignment& other : {elsewhere, on_loopback, open}) {
    order("wait_for nothing\n");
    ASSERT_TRUE(begins());
    testing::internal::CaptureStderr();

    assign(other);

    EXPECT_TRUE(turn_until([&] { return component_->over() && relay_->is_closed(); }));
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_NE(told.find("is let go: sends an assignment that is not what it ordered"),
              std::string::npos)
        << told;
    component_.reset();
    last_.reset();
  }
}

TEST_F(Hosted, AnAssignmentThatComesAfterItLeftItsLineChangesNothing) {
  order("exec {line}>&-; : > $folder/left; wait_for go; exit 3\n");
  ASSERT_TRUE(begins());
  ASSERT_TRUE(turn_until([&] { return program_->has_told("left"); }));
  for (int i = 0; i < 20; ++i) turn();  // the host sees it

  assign(good_assignment());
  ASSERT_TRUE(turn_until([&] { return relay_->unsent_bytes() == 0; }));
  for (int i = 0; i < 20; ++i) turn();
  EXPECT_FALSE(relay_->is_closed());
  program_->tell("go");

  EXPECT_TRUE(turn_until([&] { return is_told(HostFrame::kEnded); }));
}

TEST_F(Hosted, WhoSaysNothingIsLetGoAndNamed) {
  const Sockets sockets;
  const TlsLine relay(sockets.relay, *desk_, HostRole::kRunner, "robot", now());
  HostedComponent silent(sockets.host, *robot_, host_, now());
  testing::internal::CaptureStderr();

  silent.turn(now() + kHelloTimeout + std::chrono::seconds(1));

  EXPECT_TRUE(silent.over());
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find(" is let go: said nothing"), std::string::npos) << told;
}

TEST_F(Hosted, ARefusedOrderClearsNobodysPlace) {
  order("exit 0\n", "2");

  ASSERT_TRUE(turn_until([&] { return is_told(HostFrame::kRefused); }));
  for (int i = 0; i < 20; ++i) turn();

  EXPECT_EQ(places_cleared_, 0);
}

// While the component takes nothing, the host reads nothing, so it hears nothing.
TEST_F(Hosted, ARelayIsNotLostWhileTheHostDoesNotRead) {
  order("wait_for go; exec cat <&$line > /dev/null\n");
  ASSERT_TRUE(begins());
  assign(good_assignment());
  const std::string large(std::size_t{1} << 20, 'x');
  for (int i = 0; i < 16; ++i) relay_->post_bytes(FrameType::kSamples, large);
  for (int i = 0; i < 100; ++i) turn();
  ASSERT_GT(relay_->unsent_bytes(), 0u) << "all was read";

  later_ = 2 * kHostLostAfter;
  for (int i = 0; i < 20; ++i) turn();
  program_->tell("go");

  EXPECT_TRUE(turn_until([&] { return relay_->unsent_bytes() == 0 || relay_->is_closed(); }));
  EXPECT_FALSE(relay_->is_closed());
}

}  // namespace
}  // namespace clew::bridge
