// SPDX-License-Identifier: Apache-2.0
#include "gateway/web_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <string>
#include <thread>

#include "tests/few_open_files.hpp"

namespace clew::bridge {
namespace {

class Greeting : public WebContent {
 public:
  void answer(const WebRequest&, Answer answer) override {
    answer({200, "text/plain", "hello", {}});
  }
  std::string protocol_for(const SocketRequest&) override { return {}; }
  std::unique_ptr<SocketClient> connect(const SocketRequest&, const std::string&,
                                        SocketSender&) override {
    return nullptr;
  }
};

/// `http://127.0.0.1:PORT/?token=...`, in two.
struct Address {
  explicit Address(const std::string& text)
      : port(std::stoi(text.substr(text.find(':', 5) + 1))),
        target(text.substr(text.find('/', 7))) {}

  int port;
  std::string target;
};

/// A client whose socket is there before the server's files run short.
class Client {
 public:
  Client() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval most{60, 0};
    EXPECT_EQ(::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most), 0);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void ask(const Address& address) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(address.port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    const std::string request = "GET " + address.target +
                                " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(address.port) +
                                "\r\nConnection: close\r\n\r\n";
    ASSERT_EQ(::send(socket_, request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
  }

  std::string answer() {
    std::string text(4096, '\0');
    std::size_t got = 0;
    while (got < text.size()) {
      const ssize_t more = ::recv(socket_, text.data() + got, text.size() - got, 0);
      if (more <= 0) break;
      got += static_cast<std::size_t>(more);
    }
    text.resize(got);
    return text;
  }

 private:
  int socket_;
};

std::chrono::nanoseconds time_of(std::thread& thread) {
  clockid_t clock{};
  timespec time{};
  EXPECT_EQ(::pthread_getcpuclockid(thread.native_handle(), &clock), 0);
  EXPECT_EQ(::clock_gettime(clock, &time), 0);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

TEST(WebServer, WaitsUntilItMayOpenAFileForAConnection) {
  Greeting content;
  auto server = WebServer::listen(0, content);
  ASSERT_TRUE(server.ok()) << server.error().text();
  const Address address((*server)->access().address());
  Client client;
  std::chrono::nanoseconds spent{};
  std::thread thread;
  {
    const FewOpenFiles none(0);
    thread = std::thread([&] { (*server)->run(); });
    client.ask(address);
    const auto before = time_of(thread);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    spent = time_of(thread) - before;
  }
  const std::string answer = client.answer();
  (*server)->stop();
  thread.join();

  EXPECT_LT(spent,
            std::chrono::milliseconds(100));  // it tries five times; else it would all the time
  EXPECT_EQ(answer.find("HTTP/1.1 200 OK"), 0U) << answer;
  EXPECT_NE(answer.find("\r\n\r\nhello"), std::string::npos) << answer;
}

}  // namespace
}  // namespace clew::bridge
