// SPDX-License-Identifier: Apache-2.0
// The only file that includes Boost.Beast, which takes ten seconds to compile.
#include "gateway/web_server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <csignal>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>

#include "gateway/web_limits.hpp"

namespace clew::bridge {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

std::string_view view_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

std::string_view header(const Request& request, http::field name) {
  const auto found = request.find(name);
  return found == request.end() ? std::string_view() : view_of(found->value());
}

struct Target {
  std::string_view path;
  std::string_view query;
};

Target target_of(const Request& request) {
  const std::string_view whole = view_of(request.target());
  const std::size_t mark = whole.find('?');
  if (mark == std::string_view::npos) return {whole, {}};
  return {whole.substr(0, mark), whole.substr(mark + 1)};
}

Credentials credentials_of(const Request& request) {
  return {header(request, http::field::host), header(request, http::field::origin),
          target_of(request).query, header(request, http::field::cookie)};
}

/// Of files that this process or this machine may open, or of memory.
bool lacks_room(error_code error) {
  return error == boost::system::errc::too_many_files_open ||
         error == boost::system::errc::too_many_files_open_in_system ||
         error == boost::system::errc::no_buffer_space ||
         error == boost::system::errc::not_enough_memory;
}

/// What all sessions share.
struct Shared {
  WebContent& content;
  Access access;
  std::size_t connections = 0;
};

/// One connected web socket.
class SocketSession : public SocketSender, public std::enable_shared_from_this<SocketSession> {
 public:
  SocketSession(tcp::socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {
    ++shared_.connections;
  }
  ~SocketSession() override { --shared_.connections; }

  void accept(const Request& request, const SocketRequest& asked, const std::string& protocol) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.set_option(
        websocket::stream_base::decorator([protocol](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, protocol);
        }));
    stream_.read_message_max(kMostFrameBytes);
    stream_.async_accept(request, [self = shared_from_this(), asked, protocol](error_code error) {
      if (error) return;
      self->client_ = self->shared_.content.connect(asked, protocol, *self);
      self->read();
    });
  }

  void send_text(std::string text) override {
    send({std::make_shared<const std::string>(std::move(text)), false});
  }
  void send_binary(std::shared_ptr<const std::string> bytes) override {
    send({std::move(bytes), true});
  }
  std::size_t queued_bytes() const override { return queued_bytes_; }

 private:
  struct Outgoing {
    std::shared_ptr<const std::string> bytes;
    bool is_binary = false;
  };

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->end();
      const auto bytes = self->buffer_.cdata();
      const std::string_view text(static_cast<const char*>(bytes.data()), bytes.size());
      if (self->stream_.got_text()) {
        self->client_->receive_text(text);
      } else {
        self->client_->receive_binary(text);
      }
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void send(Outgoing frame) {
    if (ended_ || overflowed_) return;
    queued_bytes_ += frame.bytes->size();
    queue_.push_back(std::move(frame));
    if (queued_bytes_ > kMostQueuedBytes) return overflow();
    if (queue_.size() == 1) write();
  }

  // The client that sends must not end within its own call: reading will fail, and end it.
  void overflow() {
    overflowed_ = true;
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  void write() {
    stream_.binary(queue_.front().is_binary);
    stream_.async_write(asio::buffer(*queue_.front().bytes),
                        [self = shared_from_this()](error_code error, std::size_t) {
                          if (error || self->ended_) return self->end();
                          self->queued_bytes_ -= self->queue_.front().bytes->size();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  // The client goes first: it sends through this session. What is being written keeps its bytes.
  void end() {
    if (std::exchange(ended_, true)) return;
    client_.reset();
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::unique_ptr<SocketClient> client_;
  std::deque<Outgoing> queue_;
  std::size_t queued_bytes_ = 0;
  bool ended_ = false;
  bool overflowed_ = false;
};

/// One connection that speaks HTTP, until it becomes a web socket.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(tcp::socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {
    ++shared_.connections;
  }
  ~HttpSession() { --shared_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(kIdleTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (error == http::error::body_limit || error == http::error::header_limit) {
                         return self->refuse(413, "too large");
                       }
                       if (error) return self->close();
                       self->take(self->parser_->release());
                     });
  }

  void refuse_busy() { refuse(503, "too many connections"); }

 private:
  void take(Request request) {
    keeps_alive_ = request.keep_alive();
    is_head_ = request.method() == http::verb::head;
    const Credentials credentials = credentials_of(request);
    if (!shared_.access.is_own_host(credentials)) {
      return refuse(403, "this host is not served here");
    }
    if (websocket::is_upgrade(request)) return upgrade(std::move(request));
    const bool posts = request.method() == http::verb::post;
    if (!posts && !is_head_ && request.method() != http::verb::get) {
      return refuse(405, "allowed: GET, HEAD, POST");
    }
    if (!shared_.access.may_read(credentials)) {
      return refuse(403, "open the address that clew has printed: it carries the token");
    }
    if (posts && !shared_.access.may_control(credentials)) {
      return refuse(403, "only the page itself may ask for this");
    }
    gives_cookie_ = shared_.access.has_token(credentials);
    const std::string_view range = header(request, http::field::range);
    WebRequest asked{posts, std::string(target_of(request).path), std::string(range),
                     std::move(request.body())};
    stream_.expires_never();
    shared_.content.answer(asked, [self = shared_from_this()](WebResponse response) {
      self->answer(std::move(response));
    });
  }

  // A stranger's page may connect with the token, but only to read.
  void upgrade(Request request) {
    const Credentials credentials = credentials_of(request);
    const bool own = shared_.access.may_control(credentials);
    if (!own && !shared_.access.has_token(credentials)) return refuse(403, "the token is missing");
    SocketRequest asked{std::string(target_of(request).path), {}, own};
    for (const auto& token : http::token_list(request[http::field::sec_websocket_protocol])) {
      asked.protocols.emplace_back(token.data(), token.size());
    }
    const std::string protocol = shared_.content.protocol_for(asked);
    if (protocol.empty()) return refuse(400, "no protocol that is spoken here was offered");
    stream_.expires_never();
    std::make_shared<SocketSession>(stream_.release_socket(), shared_)
        ->accept(request, asked, protocol);
  }

  void refuse(unsigned status, std::string why) {
    keeps_alive_ = false;
    gives_cookie_ = false;
    answer({status, "text/plain; charset=utf-8", std::move(why) + '\n', {}});
  }

  void answer(WebResponse response) {
    response_.emplace(static_cast<http::status>(response.status), 11);
    response_->set(http::field::content_type, response.type);
    response_->set(http::field::cache_control, "no-store");
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Referrer-Policy", "no-referrer");
    response_->set("Cross-Origin-Resource-Policy", "same-origin");
    if (gives_cookie_) response_->set(http::field::set_cookie, shared_.access.cookie_header());
    for (const auto& [name, value] : response.headers) response_->set(name, value);
    response_->keep_alive(keeps_alive_);
    const std::size_t size = response.body.size();
    if (!is_head_) response_->body() = std::move(response.body);
    response_->content_length(size);
    stream_.expires_after(kIdleTimeout);
    http::async_write(stream_, *response_,
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error || !self->keeps_alive_) return self->close();
                        self->read();
                      });
  }

  void close() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Response> response_;
  bool keeps_alive_ = false;
  bool is_head_ = false;
  bool gives_cookie_ = false;
};

}  // namespace

class WebServer::Implementation {
 public:
  explicit Implementation(WebContent& content)
      : acceptor_(context_),
        accept_again_(context_),
        signals_(context_, SIGINT, SIGTERM),
        shared_{content, Access::with_random_token()} {}

  core::Result<void> listen(int port) {
    error_code error;
    const tcp::endpoint place(asio::ip::address_v4::loopback(),
                              static_cast<std::uint_least16_t>(port));
    acceptor_.open(place.protocol(), error);
    acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    acceptor_.bind(place, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      return core::Error{
          fmt::format("port {} of 127.0.0.1 cannot be taken: {}", port, error.message()), "--port"};
    }
    shared_.access.set_port(acceptor_.local_endpoint().port());
    accept();
    return {};
  }

  const Access& access() const { return shared_.access; }

  void watch(int descriptor, std::function<bool()> ready) {
    auto watched = std::make_shared<asio::posix::stream_descriptor>(context_, descriptor);
    wait(std::move(watched), std::move(ready));
  }

  void repeat(std::chrono::milliseconds period, std::function<bool()> work) {
    auto timer = std::make_shared<asio::steady_timer>(context_, period);
    timer->async_wait([this, timer, period, work = std::move(work)](error_code error) {
      if (!error && work()) repeat(period, work);
    });
  }

  int run() {
    int number = 0;
    signals_.async_wait([&](error_code error, int signal) {
      if (error) return;
      number = signal;
      context_.stop();
    });
    context_.run();
    return number;
  }
  void stop() { context_.stop(); }

 private:
  using Watched = std::shared_ptr<asio::posix::stream_descriptor>;

  void wait(Watched watched, std::function<bool()> ready) {
    auto& descriptor = *watched;
    descriptor.async_wait(asio::posix::stream_descriptor::wait_read,
                          [this, watched, ready = std::move(ready)](error_code error) {
                            if (!error && ready()) return wait(watched, ready);
                            watched->release();  // it belongs to somebody else
                          });
  }

  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (!error) {
        const bool busy = shared_.connections >= kMostConnections;
        auto session = std::make_shared<HttpSession>(std::move(socket), shared_);
        if (busy) {
          session->refuse_busy();
        } else {
          session->read();
        }
      }
      if (error == asio::error::operation_aborted) return;
      if (lacks_room(error)) return accept_later();
      accept();
    });
  }

  /// The connection stays in the kernel's queue: a try at once would fail again, and so on.
  void accept_later() {
    accept_again_.expires_after(kAcceptAgainAfter);
    accept_again_.async_wait([this](error_code error) {
      if (!error) accept();
    });
  }

  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer accept_again_;
  asio::signal_set signals_;
  Shared shared_;
};

WebServer::WebServer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
WebServer::~WebServer() = default;

core::Result<std::unique_ptr<WebServer>> WebServer::listen(int port, WebContent& content) {
  auto implementation = std::make_unique<Implementation>(content);
  CLEW_RETURN_IF_ERROR(implementation->listen(port));
  return std::unique_ptr<WebServer>(new WebServer(std::move(implementation)));
}

const Access& WebServer::access() const { return implementation_->access(); }
void WebServer::watch(int descriptor, std::function<bool()> ready) {
  implementation_->watch(descriptor, std::move(ready));
}
void WebServer::repeat(std::chrono::milliseconds period, std::function<bool()> work) {
  implementation_->repeat(period, std::move(work));
}
int WebServer::run() { return implementation_->run(); }
void WebServer::stop() { implementation_->stop(); }

}  // namespace clew::bridge
