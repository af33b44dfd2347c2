// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/live_stream.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// The subprotocol of the page's web socket. First a text that describes the run, as JSON; then
/// binary messages, each of whole ticks as a spool has them (SampleAccount); at the end a text
/// `{"ended": "outcome or reason"}`. The client may send `{"all": true, "from": TICK}`.
inline constexpr char kLiveProtocol[] = "clew.view.v1";

/// The page, as it follows a run.
class PageClient : public SocketClient, public StreamFollower {
 public:
  PageClient(LiveStream& stream, SocketSender& sender);
  ~PageClient() override { stream_.leave(*this); }

  void receive_text(std::string_view text) override;
  void receive_binary(std::string_view) override {}
  void begin() override;
  void pass_on() override;
  void end() override;
  bool idle() const override { return sender_.queued_bytes() == 0 && !stream_.tick_from(next_); }

 private:
  void send_all();

  LiveStream& stream_;
  SocketSender& sender_;
  std::uint64_t next_ = 0;
  std::uint64_t missed_ = 0;
  bool all_ = false;
};

}  // namespace clew::bridge
