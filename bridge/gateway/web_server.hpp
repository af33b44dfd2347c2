// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "gateway/access.hpp"

namespace clew::bridge {

/// A request whose sender may read; POST only from a sender who may control.
struct WebRequest {
  bool posts = false;  ///< POST; else GET or HEAD
  std::string path;    ///< without the query
  std::string range;   ///< the header of that name
  std::string body;
};

struct WebResponse {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// Sends to one client of a web socket. Never waits: what the client does not take is queued here.
class SocketSender {
 public:
  virtual ~SocketSender() = default;
  virtual void send_text(std::string text) = 0;
  virtual void send_binary(std::shared_ptr<const std::string> bytes) = 0;
  virtual std::size_t queued_bytes() const = 0;
};

/// What is done for one client of a web socket, while it is connected.
class SocketClient {
 public:
  virtual ~SocketClient() = default;
  virtual void receive_text(std::string_view text) = 0;
  virtual void receive_binary(std::string_view bytes) = 0;
};

/// Who asks for a web socket.
struct SocketRequest {
  std::string path;
  std::vector<std::string> protocols;  ///< offered, the best first
  bool from_own_page = false;          ///< else a stranger with the token, who may only read
};

/// What a server serves. All calls come from the server's own thread.
class WebContent {
 public:
  using Answer = std::function<void(WebResponse)>;

  virtual ~WebContent() = default;
  /// Answers now or later, once.
  virtual void answer(const WebRequest& request, Answer answer) = 0;
  /// The protocol to speak; none: the request is refused.
  virtual std::string protocol_for(const SocketRequest& request) = 0;
  /// `sender` outlives the client that is made.
  virtual std::unique_ptr<SocketClient> connect(const SocketRequest& request,
                                                const std::string& protocol,
                                                SocketSender& sender) = 0;
};

/// An HTTP and WebSocket server on 127.0.0.1, in one thread. Strangers' bytes are bounded in size,
/// time and number; whatever they hold, the answer is an error or a closed connection.
class WebServer {
 public:
  /// Port 0: any free one. Refused: a port that is taken.
  static core::Result<std::unique_ptr<WebServer>> listen(int port, WebContent& content);
  ~WebServer();

  const Access& access() const;
  /// Calls `ready` whenever the descriptor has something to read, until it returns false.
  void watch(int descriptor, std::function<bool()> ready);
  /// Calls `work` again and again, until it returns false.
  void repeat(std::chrono::milliseconds period, std::function<bool()> work);
  /// Serves until stop(), SIGINT or SIGTERM; the signal's number, or 0.
  int run();
  void stop();

 private:
  class Implementation;
  explicit WebServer(std::unique_ptr<Implementation> implementation);

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace clew::bridge
