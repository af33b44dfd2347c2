// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/live_stream.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// The subprotocol of the page's web socket. First a text that describes the run, as JSON; then
/// binary messages, each of whole ticks as a spool has them (SampleAccount), and between them texts
/// `{"changes": [...], "incidents": [...]}` of what was changed and what befell the run; at the end
/// a text `{"ended": "outcome or reason"}`. The client may send `{"all": true, "from": TICK}`, and
/// says `{"has_all": true}` when the run has ended and it wants no more.
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
  /// At the end only the client knows: what has left here may still be on its way, and it may ask
  /// for more.
  bool idle() const override { return stream_.ended().empty() || has_all_; }
  std::uint64_t progress() const override { return next_; }

 private:
  void send_all();
  void pass_on_ticks();
  /// How the run ended, behind all that the client is to get.
  void tell_end();
  /// What was changed in the run and what befell it since the last call.
  void send_changes();

  LiveStream& stream_;
  SocketSender& sender_;
  std::uint64_t next_ = 0;
  std::uint64_t missed_ = 0;
  std::size_t changes_ = 0;  ///< that were told
  std::size_t incidents_ = 0;
  bool all_ = false;
  bool is_end_due_ = false;
  bool has_told_missed_ = false;
  bool has_all_ = false;
};

}  // namespace clew::bridge
