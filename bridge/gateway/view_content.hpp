// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/live_stream.hpp"
#include "gateway/served_file.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// What `clew view` serves: its page, the bytes of the recordings that were named, and what the
/// command offers besides. Nothing else can be asked for.
class ViewContent : public WebContent {
 public:
  /// Carries out what the page asks for in the body of a POST.
  using Handler = std::function<void(const std::string& body, Answer answer)>;

  /// `page` is HTML that carries its own policy, and must outlive this.
  ViewContent(std::string_view page, std::vector<ServedRecording> recordings);

  /// Serves one more; its number.
  std::size_t add_recording(ServedRecording recording);
  std::size_t recordings() const { return recordings_.size(); }
  /// Serves a text of JSON at `path`.
  void offer(const std::string& path, std::string json) { texts_[path] = std::move(json); }
  /// Serves a run under way, which outlives this.
  void show_live(LiveStream& stream) {
    live_ = &stream;
    is_live_ = true;
  }
  /// Lets Foxglove viewers have what `fill` puts into the stream when the first of them comes.
  void offer_to_foxglove(LiveStream& stream, std::function<void()> fill) {
    live_ = &stream;
    fill_ = std::move(fill);
  }
  void on_post(const std::string& path, Handler handler) { handlers_[path] = std::move(handler); }

  void answer(const WebRequest& request, Answer answer) override;
  std::string protocol_for(const SocketRequest& request) override;
  std::unique_ptr<SocketClient> connect(const SocketRequest& request, const std::string& protocol,
                                        SocketSender& sender) override;

 private:
  WebResponse page() const;
  WebResponse session() const;
  /// `3`: a recording, or its first file if it is split; `3/1`: the file behind that one.
  WebResponse recording(std::string_view place, const std::string& range) const;

  std::string_view page_;
  std::string policy_;
  std::vector<ServedRecording> recordings_;
  LiveStream* live_ = nullptr;
  bool is_live_ = false;
  std::function<void()> fill_;  ///< of a stream that is not live
  std::map<std::string, std::string> texts_;
  std::map<std::string, Handler> handlers_;
};

/// The policy that a page carries in its own head; empty if it has none.
std::string policy_of(std::string_view page);

}  // namespace clew::bridge
