// SPDX-License-Identifier: Apache-2.0
/// What other processes of this machine send to a run's sockets: the line of its supervisor, and
/// the web server of its page. The worst that happens is that the connection is closed.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <memory>
#include <thread>

#include "gateway/web_server.hpp"
#include "line/acceptor.hpp"
#include "line/link.hpp"
#include "run/sample_account.hpp"
#include "target.hpp"

namespace clew::fuzz {
namespace {

using namespace bridge;

/// Reads a payload as a message, whatever its type says; what is one is the same once more.
template <typename Message>
void read_as(const Frame& frame) {
  auto message = frame.as<Message>();
  if (!message) return;
  core::StateWriter writer;
  writer(*message);
  Frame again{frame.type, std::string(writer.bytes())};
  CLEW_CHECK(again.as<Message>().has_value(), "our own bytes are refused");
}

void read_as_all(const Frame& frame) {
  read_as<Hello>(frame);
  read_as<Assignment>(frame);
  read_as<Checkpoint>(frame);
  read_as<RunCommand>(frame);
  read_as<CommandAnswer>(frame);
  read_as<TookOver>(frame);
  read_as<Waiting>(frame);
  read_as<Alive>(frame);
  read_as<Progress>(frame);
  read_as<Finished>(frame);
  read_as<Text>(frame);
  read_as<Tick>(frame);
  read_as<PaceChange>(frame);
  read_as<Slow>(frame);
  read_as<Kept>(frame);
  read_as<domain::Incident>(frame);
  read_as<domain::Intervention>(frame);
}

void read_line(std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{64} * 1024;
  int sockets[2] = {-1, -1};
  CLEW_CHECK(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) == 0, "no sockets");
  bytes = bytes.substr(0, kMost);
  const auto sent = ::send(sockets[1], bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  CLEW_CHECK(sent == static_cast<ssize_t>(bytes.size()), "the socket takes too little");
  ::close(sockets[1]);
  Link link(sockets[0], kMost);
  for (bool open = true; open;) {
    open = link.receive();
    while (const auto frame = link.next()) read_as_all(*frame);
  }
}

/// The bytes of frames, as a link writes them.
template <typename... Message>
std::string frames(FrameType type, Message... message) {
  int sockets[2] = {-1, -1};
  CLEW_CHECK(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) == 0, "no sockets");
  {
    Link link(sockets[0]);
    (link.post(type, std::move(message)), ...);
  }
  std::string bytes;
  char part[4096];
  for (ssize_t count = 0; (count = ::read(sockets[1], part, sizeof part)) > 0;) {
    bytes.append(part, static_cast<std::size_t>(count));
  }
  ::close(sockets[1]);
  return bytes;
}

Seeds lines() {
  Assignment assignment;
  assignment.stages = {"sense"};
  assignment.middleware = "cyclonedds";
  assignment.expected = {{"state", true, "drive", false}};
  assignment.checkpoint = Checkpoint{64, "node", "account", {{"scan", "cdr"}}, {{70, "s"}}};
  assignment.interventions = {{7, 0, {"control=other"}, "", {{"a", "b"}}}};
  return {frames(FrameType::kHello, Hello{"sense", 4711, "00112233445566778899aabbccddeeff"}),
          frames(FrameType::kAssignment, assignment),
          frames(FrameType::kAlive, Alive{true, 12345}, Alive{false, 12346}),
          frames(FrameType::kProgress, Progress{}),
          frames(FrameType::kFinished, Finished{}),
          frames(FrameType::kCommand, RunCommand{}),
          frames(FrameType::kIncident, domain::Incident{7, "refused", "run", "who"}),
          frames(FrameType::kCredit, Tick{1}, Tick{2}, Tick{3})};
}

/// Answers what it is told with its size.
class Sizes : public WebContent {
 public:
  void answer(const WebRequest& request, Answer answer) override {
    answer({200, "text/plain", std::to_string(request.body.size()), {}});
  }
  std::string protocol_for(const SocketRequest&) override { return "sizes"; }
  std::unique_ptr<SocketClient> connect(const SocketRequest&, const std::string&,
                                        SocketSender& sender) override {
    return std::make_unique<Client>(sender);
  }

 private:
  class Client : public SocketClient {
   public:
    explicit Client(SocketSender& sender) : sender_(sender) {}
    void receive_text(std::string_view text) override {
      sender_.send_text(std::to_string(text.size()));
    }
    void receive_binary(std::string_view bytes) override {
      sender_.send_binary(std::make_shared<const std::string>(std::to_string(bytes.size())));
    }

   private:
    SocketSender& sender_;
  };
};

/// A server in a thread of its own, for all inputs.
class Served {
 public:
  Served() : server_(std::move(WebServer::listen(0, content_)).value()) {
    thread_ = std::thread([this] { server_->run(); });
  }
  ~Served() {
    server_->stop();
    thread_.join();
  }
  const Access& access() const { return server_->access(); }

 private:
  Sizes content_;
  std::unique_ptr<WebServer> server_;
  std::thread thread_;
};

const Access& served() {
  static const Served server;
  return server.access();
}

int connected_socket(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  CLEW_CHECK(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0,
             "the server does not listen any more");
  const timeval patience{20, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  return socket;
}

/// Sends, says that nothing more comes, and waits until the server closes.
void talk(const std::string& handshake, std::string_view bytes) {
  const int socket = connected_socket(served().port());
  static_cast<void>(::send(socket, handshake.data(), handshake.size(), MSG_NOSIGNAL));
  char part[4096];
  // What came before the handshake's answer is no frame, so the answer is waited for.
  if (!handshake.empty()) {
    const ssize_t count = ::recv(socket, part, sizeof part, 0);
    CLEW_CHECK(count > 12 && std::string_view(part, 12) == "HTTP/1.1 101", "no web socket");
  }
  static_cast<void>(::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  ::shutdown(socket, SHUT_WR);
  ssize_t count = 0;
  while ((count = ::recv(socket, part, sizeof part, 0)) > 0) {
  }
  CLEW_CHECK(count == 0 || errno == ECONNRESET, "the server does not close a connection");
  ::close(socket);
}

std::string upgrade() {
  return "GET /live?token=" + served().token() +
         " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served().port()) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Protocol: sizes\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

void read_web_socket(std::string_view bytes) { talk(upgrade(), bytes); }

void read_http(std::string_view bytes) { talk("", bytes); }

/// A frame of a client, masked with zeros.
std::string frame(int first, const std::string& payload) {
  std::string bytes{static_cast<char>(first), static_cast<char>(0x80 | payload.size())};
  return bytes + std::string(4, '\0') + payload;
}

Seeds web_sockets() {
  return {frame(0x81, "hello") + frame(0x82, "bytes") + frame(0x88, "\x03\xe8"),
          frame(0x01, "in ") + frame(0x00, "three ") + frame(0x80, "parts"),
          frame(0x89, "ping") + frame(0x8a, "pong"),
          std::string("\x81\xfe\x00\x80\x00\x00\x00\x00", 8) + std::string(128, 'x'),
          std::string("\x82\xff\x00\x00\x00\x00\x00\x00\x00\x04\x01\x02\x03\x04", 14) + "abcd"};
}

Seeds requests() {
  const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
  return {upgrade(), "GET /?token=0" + host + "Range: bytes=0-5\r\n\r\n",
          "POST /runs" + host + "Content-Length: 2\r\nOrigin: http://127.0.0.1\r\n\r\n{}",
          "HEAD /" + host + "Cookie: clew_view_1=a; b=c\r\nConnection: close\r\n\r\n",
          "POST /" + host + "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n"};
}

}  // namespace

std::vector<Target> line_targets() {
  return {{"line", read_line, lines},
          {"web_socket", read_web_socket, web_sockets},
          {"http", read_http, requests}};
}

}  // namespace clew::fuzz
