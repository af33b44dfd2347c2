// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/foxglove_scene.hpp"
#include "gateway/live_stream.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// The subprotocols of Foxglove viewers, the newer first; what is said is the same.
inline constexpr const char* kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// A Foxglove viewer (WebSocket protocol, version 1), which only reads: the run's own topics as CDR
/// with their IDL, and beside them the channels of foxglove_channels().
class FoxgloveClient : public SocketClient, public StreamFollower {
 public:
  FoxgloveClient(LiveStream& stream, SocketSender& sender);
  ~FoxgloveClient() override { stream_.leave(*this); }

  void receive_text(std::string_view text) override;
  void receive_binary(std::string_view) override { refuse("this server is read only"); }
  void begin() override;
  void pass_on() override;
  void end() override {}
  bool idle() const override {
    return sender_.queued_bytes() == 0 && (channels_.empty() || !stream_.tick_from(next_));
  }
  std::uint64_t progress() const override { return next_; }

 private:
  void subscribe(std::uint32_t subscription, std::uint32_t channel);
  void send_tick(const LiveStream::Tick& tick);
  void send(std::uint32_t channel, std::uint64_t time_ns, std::string_view payload);
  void refuse(const std::string& why);

  LiveStream& stream_;
  SocketSender& sender_;
  std::map<std::uint32_t, std::uint32_t> channels_;  ///< by subscription
  std::optional<FoxgloveScene> scene_;
  std::uint64_t next_ = 0;
  std::uint64_t backlog_end_ = 0;  ///< ticks below this one are sent, all of them
};

}  // namespace clew::bridge
