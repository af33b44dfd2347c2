// SPDX-License-Identifier: Apache-2.0
#include "hosts/tls_line.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>

#include "connected_ends.hpp"
#include "hosts/host_frames.hpp"
#include "line/link.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

/// What such a computer would show if it did not check its own identity first.
TlsContextPtr unchecked_context(const TemporaryKeys& keys, const Validity& validity) {
  const auto issued = issue_host_certificate(keys.authority(), HostRole::kRunner, "desk", validity);
  EXPECT_TRUE(issued.ok());
  auto context = make_tls_context({keys.read(kAuthorityFile), *issued, "desk"}, HostRole::kRunner);
  EXPECT_TRUE(context.ok());
  return std::move(context).value();
}

/// A relay's end and a host's, over TCP on this host.
struct Ends {
  Ends(SSL_CTX& of_relay, SSL_CTX& of_host, const std::string& expected) {
    const Sockets sockets;
    relay = std::make_unique<TlsLine>(sockets.relay, of_relay, HostRole::kRunner, expected,
                                      Clock::now());
    host = std::make_unique<TlsLine>(sockets.host, of_host, HostRole::kHost, "", Clock::now());
  }

  template <typename Done>
  bool turn_until(Done done) {
    const auto deadline = Clock::now() + std::chrono::seconds(20);
    while (!done()) {
      if (Clock::now() > deadline) return false;
      relay->turn(Clock::now());
      host->turn(Clock::now());
    }
    return true;
  }

  std::unique_ptr<TlsLine> relay;
  std::unique_ptr<TlsLine> host;
};

class TlsLineTest : public testing::Test {
 protected:
  TemporaryKeys keys_;
  TlsContextPtr host_ = context_of(keys_, "robot", HostRole::kHost);
  TlsContextPtr desk_ = context_of(keys_, "desk", HostRole::kRunner);
};

TEST_F(TlsLineTest, BringsFramesInOrderToWhoProvedWhoItIs) {
  Ends ends(*desk_, *host_, "robot");
  ends.relay->post(FrameType::kNotice, Text{"first"});  // before anybody is known
  ends.relay->post(FrameType::kCredit, Tick{7});
  std::optional<Frame> first;

  ASSERT_TRUE(ends.turn_until([&] { return (first = ends.host->next()).has_value(); }));

  EXPECT_EQ(ends.host->peer(), "desk");
  EXPECT_EQ(ends.relay->peer(), "robot");
  EXPECT_EQ(first->as<Text>()->text, "first");
  EXPECT_EQ(ends.host->next()->as<Tick>()->tick, 7u);
  EXPECT_FALSE(ends.host->next());
}

TEST_F(TlsLineTest, ALargeFrameArrivesWhole) {
  Ends ends(*desk_, *host_, "robot");
  ends.host->allow_payload(kMostPayloadBytes);
  std::string large(5'000'000, 'x');
  large.back() = 'y';
  ends.relay->post_bytes(FrameType::kSamples, large);
  std::optional<Frame> frame;

  ASSERT_TRUE(ends.turn_until([&] { return (frame = ends.host->next()).has_value(); }));

  EXPECT_TRUE(frame->payload == large);
  EXPECT_EQ(ends.relay->unsent_bytes(), 0u);
}

TEST_F(TlsLineTest, ASocketThatIsNotReadIsNotPolledForReading) {
  Ends ends(*desk_, *host_, "robot");
  EXPECT_TRUE(ends.host->poll_events(false) & POLLIN) << "a handshake is always read";
  ASSERT_TRUE(ends.turn_until([&] { return ends.host->is_open() && ends.relay->is_open(); }));

  EXPECT_EQ(ends.host->poll_events(true), POLLIN);
  EXPECT_EQ(ends.host->poll_events(false), 0);
}

TEST_F(TlsLineTest, ALinkWhoseFramesFindNoRoomIsNotPolledForReading) {
  Ends ends(*desk_, *host_, "robot");
  int sockets[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
  const Link link(sockets[0]);
  EXPECT_EQ(events_passed_to(*ends.relay, link), POLLIN);

  ends.relay->post_bytes(FrameType::kSamples, std::string(kMostRelayedBytes, 'x'));

  EXPECT_EQ(events_passed_to(*ends.relay, link), 0);
  ::close(sockets[1]);
}

TEST_F(TlsLineTest, AFrameLargerThanAllowedClosesTheConnection) {
  Ends ends(*desk_, *host_, "robot");
  ends.relay->post_bytes(FrameType::kSamples, std::string(kMostHelloBytes + 1, 'x'));

  ASSERT_TRUE(ends.turn_until([&] { return !ends.host->next() && ends.host->is_closed(); }));

  EXPECT_EQ(ends.host->why(), "the other end sends a frame of 4097 bytes; allowed: 4096");
}

TEST_F(TlsLineTest, WhoLeavesIsNoticedAfterWhatItSaidLast) {
  Ends ends(*desk_, *host_, "robot");
  ASSERT_TRUE(ends.turn_until([&] { return ends.host->is_open() && ends.relay->is_open(); }));
  ends.host->post(FrameType::kNotice, Text{"last"});
  ends.host->close("goes");

  ASSERT_TRUE(ends.turn_until([&] { return ends.relay->is_closed(); }));

  EXPECT_EQ(ends.relay->next()->as<Text>()->text, "last");
  EXPECT_EQ(ends.relay->why(), "the other end has closed the connection");
  EXPECT_FALSE(ends.relay->was_refused());
}

TEST_F(TlsLineTest, AnotherHostThanExpectedIsRefused) {
  Ends ends(*desk_, *host_, "arm");

  ASSERT_TRUE(ends.turn_until([&] { return ends.relay->is_closed(); }));

  EXPECT_TRUE(ends.relay->was_refused());
  EXPECT_EQ(ends.relay->why(), "the other end is host 'robot'; expected 'arm'");
}

TEST_F(TlsLineTest, ARunOfAnotherAuthorityIsRefusedByBoth) {
  const TemporaryKeys others;
  const TlsContextPtr stranger = context_of(others, "desk", HostRole::kRunner);
  Ends ends(*stranger, *host_, "robot");

  ASSERT_TRUE(ends.turn_until([&] { return ends.relay->is_closed() && ends.host->is_closed(); }));

  EXPECT_TRUE(ends.relay->was_refused());
  EXPECT_EQ(ends.relay->why().rfind("the other end's certificate is refused: ", 0), 0u)
      << ends.relay->why();
  EXPECT_TRUE(ends.host->was_refused());
}

TEST_F(TlsLineTest, AnExpiredCertificateIsRefused) {
  const TlsContextPtr expired = unchecked_context(keys_, days_around_now(5, -1));
  Ends ends(*expired, *host_, "robot");

  ASSERT_TRUE(ends.turn_until([&] { return ends.host->is_closed() && ends.relay->is_closed(); }));

  EXPECT_EQ(ends.host->why(), "the other end's certificate is refused: certificate has expired");
  EXPECT_TRUE(ends.relay->was_refused());
  EXPECT_NE(ends.relay->why().find("certificate expired"), std::string::npos) << ends.relay->why();
}

TEST_F(TlsLineTest, AHostIsNoRunAndAComponentIsNeither) {
  for (const std::string folder : {"robot.host", "sense.cyclonedds"}) {
    const HostIdentity shown{
        keys_.read(kAuthorityFile),
        {keys_.read(folder + '/' + kCertificateFile), keys_.read(folder + '/' + kPrivateKeyFile)},
        ""};
    const auto context = make_tls_context(shown, HostRole::kRunner);
    ASSERT_TRUE(context.ok());
    Ends ends(**context, *host_, "robot");

    ASSERT_TRUE(ends.turn_until([&] { return ends.host->is_closed(); })) << folder;

    EXPECT_TRUE(ends.host->was_refused()) << folder;
    EXPECT_FALSE(ends.host->next()) << folder;
  }
}

TEST_F(TlsLineTest, GarbageClosesTheConnectionAndNothingElse) {
  int sockets[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, sockets), 0);
  TlsLine host(sockets[0], *host_, HostRole::kHost, "", Clock::now());
  const std::string garbage(4096, '\x16');
  ASSERT_EQ(::send(sockets[1], garbage.data(), garbage.size(), MSG_NOSIGNAL), 4096);

  for (int i = 0; i < 10 && !host.is_closed(); ++i) host.turn(Clock::now());

  EXPECT_TRUE(host.is_closed());
  EXPECT_EQ(host.why().rfind("handshake failed: ", 0), 0u) << host.why();
  EXPECT_FALSE(host.next());
  ::close(sockets[1]);
}

}  // namespace
}  // namespace clew::bridge
